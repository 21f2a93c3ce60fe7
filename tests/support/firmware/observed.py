# SPDX-License-Identifier: Apache-2.0
"""A board that observes its endpoints and publishes transforms: the application file of c/observed.c."""

from __future__ import annotations

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+graph_events, +tf_broadcaster, +clock_stamp, +time_sync]
errors: code
memory: {arena: 4096}
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    namespace: /arm
    publishers: [{topic: count, type: std_msgs/msg/Int32, qos: {reliability: best_effort}}]
"""
