# SPDX-License-Identifier: Apache-2.0
"""OMG IDL 4.2, as far as ROS 2 uses it: parser and printer."""
