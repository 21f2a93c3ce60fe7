# SPDX-License-Identifier: Apache-2.0
"""rclc sources, colcon.meta or a profile → a new application folder."""
