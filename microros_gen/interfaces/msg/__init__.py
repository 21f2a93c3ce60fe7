# SPDX-License-Identifier: Apache-2.0
"""The .msg, .srv and .action formats of ROS 2: parser and printer."""
