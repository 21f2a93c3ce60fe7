# SPDX-License-Identifier: Apache-2.0
"""`microros-gen topic`: the group of the commands on topics."""

from __future__ import annotations

import click

from microros_gen.cli.groups import CommandGroup
from microros_gen.cli.topic.echo import echo_command
from microros_gen.cli.topic.lists import find_command, info_command, list_command, type_command
from microros_gen.cli.topic.measure import bw_command, delay_command, hz_command
from microros_gen.cli.topic.pub import pub_command
from microros_gen.cli.topic.record import record_command


@click.group(cls=CommandGroup)
def command() -> None:
    """List, print, publish, measure and record topics, as `ros2 topic` does.

    Types come from interface files, installed or in --interface-path, without a build. Needs ROS 2 Jazzy, like the
    agent. Endless commands end with status 0 at Ctrl-C.

    \b
    microros-gen topic list -t
    microros-gen topic echo /chatter
    microros-gen topic pub --once /numbers std_msgs/msg/Int32 'data: 7'
    microros-gen topic record -o drive.mcap /odom /scan
    """


for _function, _name in (
    (list_command, "list"),
    (info_command, "info"),
    (type_command, "type"),
    (find_command, "find"),
    (echo_command, "echo"),
    (pub_command, "pub"),
    (hz_command, "hz"),
    (bw_command, "bw"),
    (delay_command, "delay"),
    (record_command, "record"),
):
    command.add_command(_function, _name)
