# SPDX-License-Identifier: Apache-2.0
"""How often a node with upper components wakes up in a quiet hour with `liveliness: acknack`. Time is made."""

from __future__ import annotations

from pathlib import Path

from tests.support.components.rendered import UNITS, rendered, run
from tests.support.runtime.harness import Tree, compile_merged, link, quick

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+executor, +parameters{more}]
session: {{key: 7}}
liveliness: acknack
nodes: [{{name: device, parameters: {{at: {at}, declare: [{{name: a, type: integer}}]}}}}]
"""
ALL = ", +logger_services, +graph, +graph_events, +lifecycle"
WRITERS = "logging: [{to: rosout, level: debug}, {to: ring, level: debug}]\n"
HOUR_S, LONGEST_WAIT_S = 3600, 32


def woke(folder: Path, text: str) -> int:
    """Return how often it woke in an hour."""
    out = rendered(folder, text)
    sources = [path for path in sorted((out / "src").rglob("*.c")) if not path.name.startswith("port_posix")]
    compiler, flags = quick()
    flags = (*flags, "-std=gnu99", "-Wno-error")
    units = [UNITS / "port_agent.c", UNITS / "unit_rest.c"]
    program = link(
        compile_merged(Tree(out, ()), sources, units, compiler, flags), compiler, flags, out / "rest"
    )
    word, count = run(program).split()
    assert word == "woke"
    return int(count)


def test_parameters_logs_graph_and_life_cycle_let_it_rest(tmp_path: Path) -> None:
    assert woke(tmp_path, APPLICATION.format(more=ALL, at="device") + WRITERS) <= 2


def test_a_node_without_its_parameter_server_looks_for_one(tmp_path: Path) -> None:
    """As the page about the parameter server has it: notices after 2, 4, 8, 16, then 32 s; each is acknowledged."""
    count = woke(tmp_path, APPLICATION.format(more="", at="agent"))
    notices = HOUR_S // LONGEST_WAIT_S + 4
    assert notices <= count <= 2 * notices
