# SPDX-License-Identifier: Apache-2.0
"""Any type over ROS 2 from interface files alone: `codec` (CDR, without ROS), `peer` (a node), `raw_types` (bytes)."""
