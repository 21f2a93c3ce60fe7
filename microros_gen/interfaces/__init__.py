# SPDX-License-Identifier: Apache-2.0
"""ROS 2 interfaces: where they are, their model, their closure, type descriptions and hashes."""
