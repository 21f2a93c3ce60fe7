# SPDX-License-Identifier: Apache-2.0
"""The agent: connects DDS-XRCE clients to ROS 2.

`transport/` moves datagrams, `core` dispatches them, `session` and `streams_*` keep the order of a client's
messages, `objects` its entities (described by `representation/`), `ros/` is the only place that knows
rclpy, and `wire/` is bytes without state.
"""
