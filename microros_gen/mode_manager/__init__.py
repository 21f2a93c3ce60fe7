# SPDX-License-Identifier: Apache-2.0
"""The mode manager: a ROS node that brings the nodes of a system into the states and modes of a model file."""
