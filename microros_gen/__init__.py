# SPDX-License-Identifier: Apache-2.0
"""ROS 2 interface files and YAML profile selections to static, allocation-free C99."""

__version__ = "0.1.0"
