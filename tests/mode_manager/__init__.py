# SPDX-License-Identifier: Apache-2.0
"""The mode manager: its orchestration with a made clock, and as a node with nodes of rclpy."""
