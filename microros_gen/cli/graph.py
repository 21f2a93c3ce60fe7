# SPDX-License-Identifier: Apache-2.0
"""`microros-gen graph`: draws a ROS graph."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from microros_gen.cli.options import file_option, write_result
from microros_gen.cli.ros_tools import graph_options, on_graph


@click.command()
@click.option(
    "-a", "--all", "usual", is_flag=True, help="Also /rosout, /parameter_events and services of parameters."
)
@file_option
@graph_options
def command(usual: bool, output: Path | None, **graph: Any) -> None:
    """Draw the nodes of a graph and what they exchange over topics, services and actions, as SVG.

    Arrows go the way of messages and requests. Needs ROS 2 Jazzy, like the agent.

    \b
    microros-gen graph -o graph.svg
    """
    from microros_gen.ros_tools.graph_data import graph_view, node_view
    from microros_gen.ros_tools.picture import draw

    with on_graph(**graph) as (_, discovery):
        views = [node_view(discovery.graph, node) for node in discovery.nodes()]
    write_result(draw(graph_view(views, usual)), output)
