# SPDX-License-Identifier: Apache-2.0
"""Options that every command of ros2cli 0.32 (Jazzy) has: a command line that was written for it is understood."""

from __future__ import annotations

import click
import pytest

from microros_gen.cli import action, lifecycle, node, param, service, topic

GROUPS: dict[str, click.Group] = {
    "action": action.command,
    "lifecycle": lifecycle.command,
    "node": node.command,
    "param": param.command,
    "service": service.command,
    "topic": topic.command,
}
VERBS = sorted((name, verb) for name, group in GROUPS.items() for verb in group.commands)
ONE_NODE = [("lifecycle", verb) for verb in ("get", "list", "set")] + [
    ("param", verb) for verb in ("delete", "describe", "dump", "get", "load", "set")
]


def names(group: str, verb: str) -> set[str]:
    command = GROUPS[group].commands[verb]
    return {name for option in command.params for name in option.opts}


@pytest.mark.parametrize(("group", "verb"), VERBS)
def test_each_verb_takes_what_says_how_ros2_finds_the_graph(group: str, verb: str) -> None:
    if verb != "record":  # of ros2 bag, which has another discovery
        assert {"--spin-time", "--no-daemon"} <= names(group, verb)


@pytest.mark.parametrize(("group", "verb"), ONE_NODE)
def test_verbs_on_one_node_take_its_options(group: str, verb: str) -> None:
    assert "--include-hidden-nodes" in names(group, verb)
    assert ("--timeout" in names(group, verb)) == (group == "param")


def test_the_timeout_of_ros2_param_is_the_spin_time() -> None:
    get = param.command.commands["get"]
    for option in ("--timeout", "--spin-time"):
        context = get.make_context(
            "get", ["/arm", "gain", option, "7", "--no-daemon", "--include-hidden-nodes"]
        )
        assert context.params["spin_time"] == 7.0
        assert context.params.keys().isdisjoint({"timeout", "no_daemon"})
