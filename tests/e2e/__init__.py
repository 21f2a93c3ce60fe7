# SPDX-License-Identifier: Apache-2.0
"""From the command line to a ROS 2 subscriber: built images, real sockets, a real agent."""
