# SPDX-License-Identifier: Apache-2.0
"""The ROS 2 side: `bridge` is what the agent needs of it, `rclpy_bridge` gives it, `names` translates."""
