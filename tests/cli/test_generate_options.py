# SPDX-License-Identifier: Apache-2.0
"""Options for builds that call the tool: --depfile and --component, and the tool-chain file of a target."""

from __future__ import annotations

import json
import re
import time
from pathlib import Path

import microros_gen
from tests.support.command_line import Runner

OUT = Path("build/pure_sender")


def read_depfile(path: Path) -> tuple[str, list[str]]:
    """Return what was made and from what, as make reads it."""
    words = re.findall(r"(?:\\.|[^\s\\])+", path.read_text().replace("\\\n", " "))
    target, *inputs = [re.sub(r"\\(.)", r"\1", word).replace("$$", "$") for word in words]
    return target.removesuffix(":"), inputs


def test_the_depfile_names_what_was_read(run: Runner, folder: Path) -> None:
    own = folder / "with # and $ and space" / "own_msgs"
    (own / "msg").mkdir(parents=True)
    (own / "msg" / "Count.msg").write_text("int32 value\n")
    (folder / "mine.yaml").write_text("profile: mine\nsummary: mine\nextends: [pure_sender]\n")
    (folder / "board.yaml").write_text("target: board\nsummary: mine\nextends: host\n")
    (folder / "microros.yaml").write_text(
        "version: 1\nprofiles: [mine.yaml]\ninterfaces: [own_msgs]\ntarget: {name: board.yaml}\n"
    )
    arguments = ("generate", "--interface-path", str(own), "-o", "out", "--depfile", "build dir/out.d")
    assert run(*arguments).status == 0
    target, inputs = read_depfile(folder / "build dir/out.d")
    assert target == str(folder / "out/manifest.json")
    wanted = [own / "msg/Count.msg", *(folder / f"{name}.yaml" for name in ("microros", "mine", "board"))]
    package = Path(microros_gen.__file__).parent
    wanted += [package, package / "cli/generate.py", package / "components/publish/src/rcl_publisher.c"]
    assert {str(path) for path in wanted} <= set(inputs)
    assert all(Path(name).exists() for name in inputs)
    assert not [name for name in inputs if Path(name).is_relative_to(folder / "out")]


def test_a_depfile_that_is_gone_is_written_again_and_an_unchanged_one_is_not(
    run: Runner, folder: Path
) -> None:
    arguments = ("generate", "--profile", "pure_sender", "--depfile", "out.d")
    assert run(*arguments).status == 0
    first = (folder / "out.d").stat()
    time.sleep(0.03)  # what is as young as the run is never trusted
    assert run(*arguments).status == 0
    assert run(*arguments).status == 0
    assert (folder / "out.d").stat().st_mtime_ns == first.st_mtime_ns
    (folder / "out.d").unlink()
    output = run(*arguments)
    assert "0 written" in output.out
    assert read_depfile(folder / "out.d")[0] == str(folder / OUT / "manifest.json")


def test_a_depfile_that_cannot_be_written(run: Runner, folder: Path) -> None:
    (folder / "file").write_text("")
    output = run("generate", "--profile", "pure_sender", "--depfile", "file/out.d")
    assert output.status == 2
    assert "cannot write the depfile file/out.d" in output.err


def test_components_of_the_command_line_add_to_the_files(run: Runner, folder: Path) -> None:
    (folder / "microros.yaml").write_text("version: 1\nprofiles: [pure_sender]\ncomponents: [+timers]\n")
    chosen = ("--component", "+session_state", "--component", "cdr_decode", "--component", "-ping")
    resolved = run("resolve", *chosen, "--format", "json")
    assert resolved.status == 2  # liveliness: ping needs it
    assert "<command line>:1:13: error: '-ping' drops a component" in resolved.err
    resolved = run("resolve", *chosen[:4], "--format", "json")
    names = {c["name"] for c in json.loads(resolved.out)["components"]}
    assert {"timers", "session_state", "cdr_decode", "publish"} <= names
    unknown = run("resolve", "--component", "timer")
    assert unknown.status == 2
    assert "'timers'" in unknown.err
    contradicted = run("resolve", "--component", "-timers")
    assert "'-timers' contradicts '+timers' (microros.yaml:3)" in contradicted.err


def test_a_tool_chain_file_is_that_of_one_target_without_an_operating_system(
    run: Runner, folder: Path
) -> None:
    printed = run("targets", "cortex-m4f", "--format", "cmake")
    assert printed.status == 0
    assert 'set(CMAKE_C_FLAGS_INIT "' in printed.out
    assert "-mcpu=cortex-m4" in printed.out
    assert "NAME is missing" in run("targets", "--format", "cmake").err
    assert "target host has no tool-chain file" in run("targets", "host", "--format", "cmake").err


def test_a_depfile_is_no_folder(run: Runner, folder: Path) -> None:
    refused = run("generate", "--profile", "pure_sender", "-o", "out", "--depfile", ".")
    assert refused.status == 2
    assert "is a directory" in refused.err
    assert not (folder / "out").exists()
