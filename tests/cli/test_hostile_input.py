# SPDX-License-Identifier: Apache-2.0
"""Whatever a file holds and whatever it is: a diagnostic, never a traceback, a crash or a wait without end."""

from __future__ import annotations

import os
import random
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from microros_gen.agent.configuration.entities_file import parse_preconfigured
from microros_gen.agent.configuration.parser import parse_agent_file
from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source, Span, UserError
from microros_gen.diagnostics.diagnostic import LONGEST_LINE, Diagnostic
from microros_gen.diagnostics.internal import reads
from microros_gen.interfaces.msg.action import parse_action
from microros_gen.interfaces.msg.parser import parse_msg
from microros_gen.interfaces.msg.srv import parse_srv
from microros_gen.interfaces.omg_idl.parser import parse_idl
from microros_gen.interfaces.types import TypeName
from microros_gen.migrate.c_program import read_program
from microros_gen.migrate.c_tokens import read_c
from microros_gen.migrate.colcon_meta import read_settings
from microros_gen.platform.target_file import parse_target
from microros_gen.selection.component_file import parse_component
from microros_gen.selection.profile_file import parse_profile
from tests.support.command_line import Runner
from tests.support.ids import without_id
from tests.support.paths import ROOT
from tests.support.patience import seconds

pytestmark = pytest.mark.builds

MUTATIONS = int(os.environ.get("MUTATIONS", "60"))  # of each seed; thousands by hand

APPLICATION = """version: 1
profiles: [pure_sender]
transport: {type: udp, agent: "127.0.0.1:8888", mtu: 512}
target: {name: host}
on_full: block 20 ms
nodes:
  - name: imu_node
    publishers: [{topic: imu/data, type: sensor_msgs/msg/Imu, qos: {reliability: best_effort, depth: 1}}]
limits: {"*": {string: 32, sequence: 8}, sensor_msgs/msg/Imu: {header: {frame_id: 16}}}
memory: {ram_budget: 8 KiB, arena: 0}
"""
MESSAGE = """# a
int32 A=1
string<=5[<=3] b ["x", 'y']
float64[3] c [1.0, 2e3, .5]
pkg/Type d
wstring e "\\u00e9"
"""
IDL = """#include "q/msg/B.idl"
module p { module msg {
  module A_Constants { const long X = (1 << 3) | 0x7; const string S = "a\\n"; };
  typedef sequence<double, 3> D; enum E { ONE, TWO };
  @verbatim (language="comment", text="a" "b") struct A { @default (value=1) long a; D d[3]; q::msg::B b; };
}; };
"""
META = '{"names": {"rmw_microxrcedds": {"cmake-args": ["-DRMW_UXRCE_MAX_NODES=1", "-DRMW_UXRCE_TRANSPORT=udp"]}}}'
C_SOURCE = (ROOT / "examples/publisher/main.c").read_text(encoding="utf-8")
SEEDS: dict[str, tuple[str, Callable[[Source, Diagnostics], object]]] = {
    "application": (APPLICATION, parse_application),
    "profile": ((ROOT / "profiles/pure_sender.yaml").read_text(encoding="utf-8"), parse_profile),
    "target": ((ROOT / "microros_gen/targets/cortex-m4.yaml").read_text(encoding="utf-8"), parse_target),
    "component": (
        (ROOT / "microros_gen/components/publish/component.yaml").read_text(encoding="utf-8"),
        parse_component,
    ),
    "agent": ("version: 1\ntransports: [{type: udp4, port: 8888}]\n", parse_agent_file),
    "preconfigured": (
        "version: 1\nclients: [{key: 0x12345678, session: 0x81, objects: []}]\n",
        lambda source, diagnostics: parse_preconfigured([source], diagnostics),
    ),
    "msg": (MESSAGE, lambda s, d: parse_msg(s, TypeName("p", "msg", "A"), d)),
    "srv": (f"{MESSAGE}---\nbool ok\n", lambda s, d: parse_srv(s, TypeName("p", "srv", "A"), d)),
    "action": (f"{MESSAGE}---\nbool ok\n---\nint8 x\n", lambda s, d: parse_action(s, TypeName("p", "action", "A"), d)),
    "idl": (IDL, lambda s, d: parse_idl(s, "p", "msg", d)),
    "meta": (META, read_settings),
    "C": (C_SOURCE, lambda s, d: read_program([read_c(s)])),
}  # fmt: skip
NASTY = (
    *"[]{}()<>:;,#&*!|>'\"\\@%`~-=+/. \n\t\0\ufeff\u2028\u0663\u00b2\U0001f600",
    *("9" * 5000, "-1", "0x" + "f" * 400, "1e999", ".inf", ".nan", "- " * 300, "[" * 300, "{" * 300, "((((", "/*"),
    *("null", "true", "<<", "*a", "&a ", "!!python/object:os.system", "a" * 5000, "../" * 50, "---\n", "\r\n"),
    *("const long X = 1;\n", "module m { const long X = 1; };\n", 'R"(', "'", '"""', "1<<62", "9**9**9", "\\N{DASH}"),
)  # fmt: skip


def mutated(text: str, chance: random.Random) -> str:
    for _ in range(chance.randint(1, 4)):
        at, length = chance.randrange(len(text) + 1), chance.choice((0, 0, 1, 3, 20, 200))
        lines = text.splitlines(keepends=True) or [""]
        new = chance.choice((*NASTY, chance.choice(lines), text[at : at + length]))
        text = text[:at] + new + text[at + length :]
    return text


@pytest.mark.parametrize("kind", SEEDS)
def test_a_mutated_text_never_ends_in_an_exception(kind: str) -> None:
    seed, read = SEEDS[kind]
    chance = random.Random(kind)
    for _ in range(MUTATIONS):
        text = mutated(seed, chance)
        diagnostics = Diagnostics()
        try:
            read(Source("file", text), diagnostics)
        except UserError as error:
            diagnostics.extend(error.diagnostics)
        reported = "\n".join(d.render() for d in diagnostics)
        assert "internal error" not in reported, f"{reported}\n{text!r}"


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("version: 1\nmemory: {arena: " + "9" * 5000 + "}\n", "a number of 5000 characters is too long"),
        ("version: 1\nmemory: {arena: " + "9" * 5000 + " kB}\n", "must be a size in bytes"),
        (f'version: 1\ntransport: {{type: udp, agent: "1.2.3.4:{"9" * 5000}"}}\n', "the agent's port must be"),
        (f"version: 1\non_full: block {'9' * 5000} ms\n", "on_full"),
        ("version: 1\nx: " + "[" * 100_000, "nested too deeply"),
        ("- " * 100_000, "nested too deeply"),
        (f"version: 1\nprofiles: [{'a' * 5000}]\n", "unknown profile 'aaa"),
        ('version: 1\nprofiles: ["a\\0.yaml"]\n', "the text contains a NUL character"),
        (f"version: 1\nprofiles: [pure_sender]\ntarget: {'a' * 5000}.yaml\n", "cannot read the target file"),
        ('version: 1\nprofiles: [pure_sender]\ntarget: "a\\0.yaml"\n', "the text contains a NUL character"),
        (f"version: 1\nprofiles: [pure_sender]\ninterfaces: [{'a' * 5000}/msg/A]\n", "unknown interface package"),
        (f"version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/{'A' * 5000}]\n", "A"),
    ],
    ids=lambda value: value[:40] if len(value) < 60 else "",
)  # fmt: skip
def test_what_was_once_a_traceback(run: Runner, folder: Path, text: str, reported: str) -> None:
    (folder / "microros.yaml").write_text(text)
    outcome = run("generate", "-o", "out")
    assert outcome.status == 2
    assert reported in outcome.err
    assert "internal error" not in outcome.err
    assert max(map(len, outcome.err.splitlines())) < 1200


def test_a_constant_before_the_first_module_of_an_idl_file(folder: Path) -> None:
    diagnostics = Diagnostics()
    text = "const long X = 1;\nmodule p { const long X = 1; module msg { struct A { long a; }; }; };\n"
    parse_idl(Source("A.idl", text), "p", "msg", diagnostics)
    assert "the constant 'X' is in no module" in "\n".join(without_id(d.headline()) for d in diagnostics)


AIMS = ("pipe", "/dev/zero", "large")
PLACES = ("p/msg/A.msg", "microros.yaml", "own.yaml", "board.yaml", "p/package.xml")
"""Every place with a pipe and the first one with each aim in CI: one function opens all of them."""


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are FIFOs on POSIX alone")
@pytest.mark.parametrize(
    ("place", "aim"),
    [
        *((PLACES[0], aim) for aim in AIMS),
        *((place, AIMS[0]) for place in PLACES[1:]),
        *(pytest.param(place, aim, marks=pytest.mark.variant) for place in PLACES[1:] for aim in AIMS[1:]),
    ],
)
def test_only_regular_files_of_a_bounded_size_are_read(folder: Path, aim: str, place: str) -> None:
    """In a separate process, which a time-out ends if it waits."""
    (folder / "p/msg").mkdir(parents=True)
    (folder / "p/msg/A.msg").write_text("int32 a\n")
    (folder / "microros.yaml").write_text(
        "version: 1\nprofiles: [own.yaml]\ntarget: board.yaml\ninterfaces: [p/msg/A]\n"
    )
    (folder / "own.yaml").write_text("profile: own\nsummary: Mine\nextends: [pure_sender]\n")
    (folder / "board.yaml").write_text("extends: host\nsummary: Mine\n")
    (folder / place).unlink(missing_ok=True)
    if aim == "pipe":
        os.mkfifo(folder / place)
    elif aim == "large":
        (folder / place).write_bytes(b"#" * (1 << 20) + b"\n")
    else:
        (folder / place).symlink_to(aim)
    command = [sys.executable, "-m", "microros_gen", "generate", "--interface-path", "p", "-o", "out"]
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=seconds(60), check=False
    )
    if place == "p/package.xml":  # its folder's name is taken then
        assert done.returncode == 0, done.stderr
    else:
        assert done.returncode == 2
        assert Path(place).name in done.stderr
        assert (
            ("not a regular file" in done.stderr)
            or ("larger than" in done.stderr)
            or "profile" in done.stderr
        )


@pytest.mark.parametrize(
    "command",
    [["generate", "-o", "out"], ["check", "--golden", "golden", "--update"], ["resolve"], ["init", "new"], ["build"]],
    ids=lambda command: command[0],
)  # fmt: skip
def test_only_build_starts_the_program_that_a_target_file_names(
    run: Runner, folder: Path, command: list[str]
) -> None:
    program = folder / "program"
    program.write_text(f"#!/bin/sh\ntouch {folder}/started\nexit 1\n")
    program.chmod(0o755)
    target = f"extends: cortex-m4\nsummary: Mine\ncompilers: [{program}]\narchivers: [{program}]\n"
    (folder / "board.yaml").write_text(target)
    run(*command, "--profile", "pure_sender", "--target", "board.yaml")
    assert (folder / "started").exists() == (command[0] == "build")


def test_an_unexpected_exception_names_the_text(run: Runner, monkeypatch: pytest.MonkeyPatch) -> None:
    @reads
    def fails(source: Source) -> None:
        raise IndexError("tuple index out of range")

    with pytest.raises(UserError, match=r"^x\.yaml:1:1: error: internal error: IndexError: tuple index"):
        fails(Source("x.yaml", "a: 1"))


def test_an_exception_outside_of_any_text_is_a_diagnostic_too(
    run: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: object) -> None:
        raise ZeroDivisionError("by accident")

    monkeypatch.setattr("microros_gen.compiler.pipeline.resolve_profiles", fails)
    outcome = run("resolve", "--profile", "pure_sender")
    assert outcome.status == 2
    assert "microros-gen: error: internal error: ZeroDivisionError: by accident" in outcome.err
    assert "Traceback" not in outcome.err
    monkeypatch.setenv("MICROROS_GEN_TRACEBACK", "1")
    with pytest.raises(ZeroDivisionError):
        run("resolve", "--profile", "pure_sender")


@pytest.mark.parametrize("column", [1, 5, 500, 990])
def test_a_long_line_is_shown_around_its_place(column: int) -> None:
    line = "".join(chr(ord("a") + i % 26) for i in range(1000))
    lines = Diagnostic("x", Span(Source("f", line), 1, column, column + 3)).render().splitlines()
    at = lines[2].index("^")
    assert lines[1][at : at + 3] == line[column - 1 : column + 2]
    assert lines[2].strip() == "^~~"
    assert len(lines[1]) <= LONGEST_LINE + 4
