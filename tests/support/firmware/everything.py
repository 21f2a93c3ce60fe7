# SPDX-License-Identifier: Apache-2.0
"""The application with all that a node has."""

from __future__ import annotations

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader, simulation_node]
components: [+timers, +services, +executor]
on_full: block 1 s
pools: {history: 16}
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}  # a busy test machine
nodes:
  - name: board
    publishers:
      - {topic: ticks, type: std_msgs/msg/Int32}
      - {topic: seen, type: std_msgs/msg/Int32}
    subscriptions: [{topic: set, type: std_msgs/msg/Int32}]
    services: [{name: lengths, type: rcl_interfaces/srv/GetParameterTypes}]
    clients: [{name: /peer/lengths, type: rcl_interfaces/srv/GetParameterTypes}]
    timers: [{name: tick, period: 50 ms}]
limits: {"*": {string: 8, sequence: 3}}
"""
