# SPDX-License-Identifier: Apache-2.0
"""What the commands on a ROS graph do: topics, services, actions, parameters, life cycles and nodes, over `ros`."""
