# SPDX-License-Identifier: Apache-2.0
"""ros2 launch microros_gen_agent agent.launch.py arguments:="udp4 --port 8888"."""

from __future__ import annotations

import shlex

from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Return the agent with its arguments; it is started again if it ends by itself."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "arguments",
                default_value="udp4 --port 8888",
                description="What follows `microros-gen agent` on a command line",
            ),
            DeclareLaunchArgument(
                "respawn_delay",
                default_value="2.0",
                description="Seconds until an agent that ended is started again",
            ),
            OpaqueFunction(function=_agent),
        ]
    )


def _agent(context: LaunchContext) -> list[Node]:
    words = shlex.split(LaunchConfiguration("arguments").perform(context))
    delay_s = float(LaunchConfiguration("respawn_delay").perform(context))
    node = Node(
        package="microros_gen_agent",
        executable="agent",
        arguments=words,
        output="screen",
        respawn=True,
        respawn_delay=delay_s,
    )
    return [node]
