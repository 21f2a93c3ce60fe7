# SPDX-License-Identifier: Apache-2.0
"""Services and actions among the selected interfaces: their types are generated, and nothing publishes them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.command_line import Runner

ARGUMENTS = ("generate", "--profile", "pure_sender", "--output", "out", "--interface")


def generated_types(folder: Path) -> set[str]:
    manifest = json.loads((folder / "out/manifest.json").read_text(encoding="utf-8"))
    return set(manifest["types"])


def test_services_next_to_a_message(run: Runner, folder: Path) -> None:
    outcome = run(*ARGUMENTS, "std_srvs", "--interface", "std_msgs/Bool")
    assert (outcome.status, outcome.err) == (0, "")
    assert "publishes  up to 1 of std_msgs/msg/Bool" in outcome.out
    types = generated_types(folder)
    assert {f"std_srvs/srv/SetBool_{part}" for part in ("Request", "Response", "Event")} <= types
    assert "service_msgs/msg/ServiceEventInfo" in types
    header = (folder / "out/include/std_srvs/srv/set_bool.h").read_text(encoding="utf-8")
    assert '#include "std_srvs/srv/detail/set_bool__struct.h"' in header
    assert (folder / "out/src/std_srvs/srv__set_bool__functions.c").is_file()


@pytest.mark.parametrize("name", ["std_srvs", "example_interfaces/Fibonacci"])
def test_without_a_message_the_default_one_is_published(run: Runner, folder: Path, name: str) -> None:
    outcome = run(*ARGUMENTS, name)
    assert outcome.status == 0
    assert "no message to publish among the interfaces: std_msgs/msg/Int32 is added" in outcome.err
    assert f"--interface {name}" in outcome.err
    assert "publishes  up to 1 of std_msgs/msg/Int32" in outcome.out


def test_limits_of_a_response_are_named_and_taken(run: Runner, folder: Path) -> None:
    base = "profiles: [pure_sender]\ninterfaces: [std_srvs/SetBool, std_msgs/Int32]\n"
    (folder / "microros.yaml").write_text(base, encoding="utf-8")
    outcome = run("generate", "--output", "out")
    assert outcome.status == 2
    assert "std_srvs/srv/SetBool_Response has no limit for message" in outcome.err
    assert "\n  std_srvs/srv/SetBool_Response: {message: 32}\n" in outcome.err
    limits = "limits: {std_srvs/srv/SetBool_Response: {message: 20}}\n"
    (folder / "microros.yaml").write_text(base + limits, encoding="utf-8")
    assert run("generate", "--output", "out").status == 0
    storage = (folder / "out/include/std_srvs/srv/detail/set_bool__storage.h").read_text(encoding="utf-8")
    assert storage.count("[21]") == 1


def test_a_publisher_needs_a_message(run: Runner, folder: Path) -> None:
    text = """\
profiles: [pure_sender]
nodes:
  - name: talker
    publishers:
      - {topic: state, type: std_srvs/msg/SetBool}
"""
    (folder / "microros.yaml").write_text(text, encoding="utf-8")
    outcome = run("generate", "--output", "out")
    assert outcome.status == 2
    assert "microros.yaml:5:30: error: package 'std_srvs'" in outcome.err
    assert "has no type 'SetBool'. It has std_srvs/srv/SetBool" in outcome.err


def test_changes_of_a_service_file_are_seen(run: Runner, folder: Path) -> None:
    """The fast path of `generate` knows the files of services too."""
    (folder / "mine/srv").mkdir(parents=True)
    file = folder / "mine/srv/Do.srv"
    for member in ("one", "two"):
        file.write_text(f"int8 {member}\n---\n", encoding="utf-8")
        assert run(*ARGUMENTS, "mine/Do", "--interface-path", str(folder / "mine")).status == 0
        struct = (folder / "out/include/mine/srv/detail/do__struct.h").read_text(encoding="utf-8")
        assert f"int8_t {member};" in struct


@pytest.mark.parametrize(
    ("rest", "hint"),
    [
        ("interfaces: [std_msgs/msg/Int32]", "Add a service in `interfaces:`"),
        ("nodes: [{name: a, publishers: [{topic: x, type: std_msgs/msg/Int32}]}]", "Add a service of a node"),
    ],
)
def test_services_without_a_service_are_refused(run: Runner, folder: Path, rest: str, hint: str) -> None:
    text = f"profiles: [pure_sender]\ncomponents: [+services]\n{rest}\n"
    (folder / "microros.yaml").write_text(text, encoding="utf-8")
    outcome = run("generate", "--output", "out")
    assert outcome.status == 2
    assert "'services' is selected, but no service is declared" in outcome.err
    assert hint in outcome.err
