# SPDX-License-Identifier: Apache-2.0
"""The profile pure_action_server alone, with each setting of `entities`, and limits of the actions of a node."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from microros_gen.interfaces.types import TypeName
from microros_gen.toolchain.toolchain import WARNINGS
from tests.support.components.rendered import planned
from tests.support.patience import seconds
from tests.support.profile_with_diagnostics import ENTITIES
from tests.support.slices import only

FIBONACCI = "example_interfaces/action/Fibonacci"
NODE = """\
version: 1
components: [+action_server]
nodes: [{name: device, actions: [{name: a, type: TYPE, LIMITS}, {name: b, type: TYPE, limits: {sequence: 7}}]}]
""".replace("TYPE", FIBONACCI)


def received(folder: Path, text: str) -> list[list[int]]:
    """Return the sizes of the places for feedback and results of each client."""
    runtime = planned(folder, text).project.runtime
    sizes = [queue.slot_size for queue in runtime.input.queues if queue.slots]
    return [sizes[:2], sizes[4::3]]  # the responses to a goal and to its cancellation are before each result


@pytest.mark.parametrize("entities", only({"binary", "reference"}, ENTITIES))
def test_the_profile_alone_is_a_fibonacci_server(tmp_path: Path, entities: str) -> None:
    config = tmp_path / "microros.yaml"
    config.write_text(f"version: 1\nprofiles: [pure_action_server]\nentities: {entities}\n", encoding="utf-8")
    generated = compiler.generate(
        compiler.Options(config=config, interface_paths=(shipped_folder(),)), tmp_path / "out"
    )
    example = generated.out / "examples" / "pure_action_server" / "main.c"
    text = example.read_text(encoding="utf-8")
    assert "ROSIDL_GET_ACTION_TYPE_SUPPORT(example_interfaces, Fibonacci)" in text
    assert "static int32_t numbers_0[16];" in text
    command = ["gcc", "-std=c99", *WARNINGS, "-Werror", f"-I{generated.out / 'include'}", "-fsyntax-only"]
    done = subprocess.run(
        [*command, str(example)], capture_output=True, text=True, check=False, timeout=seconds(60)
    )
    assert done.returncode == 0, done.stderr


def sizes(folder: Path, text: str) -> list[int]:
    """Return the largest encoded sizes of a result and of feedback."""
    types = {plan.name: plan for plan in planned(folder, text).project.types}
    names = (f"Fibonacci_{part}" for part in ("GetResult_Response", "FeedbackMessage"))
    return [types[TypeName("example_interfaces", "action", name)].max_encoded_size for name in names]


@pytest.mark.parametrize(
    ("limits", "more", "numbers"),
    [
        ("limits: {sequence: 5}", "", [7, 7]),
        ("limits: {sequence: 9}", "limits: {'*': {sequence: 3}}\n", [9, 9]),
        ("limits: {sequence: 9}", f"limits: {{{FIBONACCI}_Result: {{sequence: 12}}}}\n", [12, 9]),
        ("goals: 2", "", [7, 7]),
    ],
)
def test_limits_of_actions(tmp_path: Path, limits: str, more: str, numbers: list[int]) -> None:
    """Those of the type: the larger ones of two servers; a path below `limits:` overrides them."""
    wanted = [start + 4 * count for start, count in zip((8, 20), numbers, strict=True)]
    assert sizes(tmp_path, NODE.replace("LIMITS", limits) + more) == wanted


def test_limits_of_action_clients(tmp_path: Path) -> None:
    """The type has the larger ones; each client has its own, and the places for its messages."""
    text = NODE.replace("action_server", "action_client").replace("actions:", "action_clients:")
    text = text.replace("LIMITS", "limits: {sequence: 5}")
    assert sizes(tmp_path, text) == [8 + 28, 20 + 28]
    assert received(tmp_path, text) == [[20 + 20, 20 + 28], [12 + 20, 12 + 28]]


def test_a_limit_of_the_application_holds_for_each_action_client(tmp_path: Path) -> None:
    text = NODE.replace("action_server", "action_client").replace("actions:", "action_clients:")
    text = (
        text.replace("LIMITS", "limits: {sequence: 5}")
        + f"limits: {{{FIBONACCI}_Feedback: {{sequence: 12}}}}\n"
    )
    assert received(tmp_path, text)[0] == [20 + 48, 20 + 48]


def test_limits_of_an_action_client_and_of_a_server_of_its_type(tmp_path: Path) -> None:
    """The server sends what the client may receive: the larger limits hold for both."""
    more = ", action_clients: [{name: a, type: TYPE, limits: {sequence: 9}}]}]".replace("TYPE", FIBONACCI)
    text = NODE.replace("LIMITS", "limits: {sequence: 5}").replace("}]\n", more + "\n")
    text = text.replace("[+action_server]", "[+action_server, +action_client]")
    assert sizes(tmp_path, text) == [8 + 36, 20 + 36]
