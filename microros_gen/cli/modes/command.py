# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes`: the group of the commands on model files."""

from __future__ import annotations

import click

from microros_gen.cli.groups import CommandGroup
from microros_gen.cli.modes.check import check_command
from microros_gen.cli.modes.graph import graph_command
from microros_gen.cli.modes.manage import manage_command
from microros_gen.cli.modes.mine import mine_command
from microros_gen.cli.modes.monitor import monitor_command
from microros_gen.cli.modes.simulate import simulate_command


@click.group(cls=CommandGroup)
def command() -> None:
    """Check, simulate, draw, manage and monitor a system of nodes with modes.

    SYSTEM.yaml is a model file of the package system_modes.

    \b
    microros-gen modes check robot.yaml
    microros-gen modes simulate robot.yaml faults.yaml
    microros-gen modes graph robot.yaml -o robot.svg
    microros-gen modes manage robot.yaml
    microros-gen modes monitor robot.yaml
    microros-gen modes mine /gripper
    """


command.add_command(check_command, "check")
command.add_command(simulate_command, "simulate")
command.add_command(graph_command, "graph")
command.add_command(manage_command, "manage")
command.add_command(monitor_command, "monitor")
command.add_command(mine_command, "mine")
