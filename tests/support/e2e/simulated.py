# SPDX-License-Identifier: Apache-2.0
"""An application of a simulation: its timer follows /clock; tests/e2e/c/simulation.c."""

APPLICATION = """\
version: 1
profiles: [simulation_node, pure_sender]
components: [+timers]
nodes:
  - name: simulated
    publishers: [{topic: ticks, type: std_msgs/msg/Int32}]
    timers: [{name: tick, period: 100 ms}]
"""
END_S = 1000
