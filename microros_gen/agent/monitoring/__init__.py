# SPDX-License-Identifier: Apache-2.0
"""The state of a running agent for people and programs outside of ROS."""
