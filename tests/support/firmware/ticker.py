# SPDX-License-Identifier: Apache-2.0
"""The application with a timer and an executor."""

from __future__ import annotations

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+timers]
errors: code
nodes:
  - name: ticker
    publishers: [{topic: count, type: std_msgs/msg/Int32}]
    timers: [{name: tick, period: 100 ms%s}]
"""
LISTENS = "    subscriptions: [{topic: numbers, type: std_msgs/msg/Int32}]\n"
