# SPDX-License-Identifier: Apache-2.0
"""The profile configurable_sender_with_diagnostics with each setting of `entities`; tests/firmware builds it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from microros_gen.toolchain.toolchain import WARNINGS
from tests.support.patience import seconds
from tests.support.profile_with_diagnostics import APPLICATION, ENTITIES
from tests.support.slices import only


def compile_example(out: Path) -> None:
    (example,) = (out / "examples").rglob("main.c")
    command = ["gcc", "-std=c99", *WARNINGS, "-Werror", f"-I{out / 'include'}", "-fsyntax-only", str(example)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=seconds(60))
    assert done.returncode == 0, done.stderr


def compile_library(out: Path) -> None:
    """Nothing that is selected has a buffer of no bytes."""
    for header in ("xrce_client.h", "xrce_streams.h"):
        command = ["gcc", "-std=c99", *WARNINGS, "-Werror", f"-I{out / 'include'}", "-fsyntax-only", "-xc"]
        source = out / "include" / "microros" / header
        if source.is_file():
            done = subprocess.run([*command, str(source)], capture_output=True, text=True, check=False)
            assert done.returncode == 0, done.stderr


def with_nothing_else(tmp_path: Path, *lines: str) -> str:
    """Return the example of the profile where nothing says which entities there are."""
    config = tmp_path / "microros.yaml"
    config.write_text(
        "\n".join(("version: 1", "profiles: [configurable_sender_with_diagnostics]", *lines, ""))
    )
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),))
    out = compiler.generate(options, tmp_path / "out").out
    compile_example(out)
    compile_library(out)
    return next((out / "examples").rglob("main.c")).read_text()


@pytest.mark.parametrize("entities", only({"binary", "reference"}, ENTITIES))
def test_the_profile_alone_has_all_three(tmp_path: Path, entities: str) -> None:
    example = with_nothing_else(tmp_path, f"entities: {entities}")
    assert "device_parameters_declare(&node_parameters)" in example
    assert "rcutils_logging_set_output_handler(on_log);" in example
    assert "diagnostic_array_1.status.size = 1;" in example
    assert '!put_text(&diagnostic_array_1.status.data[0].name, "device"))' in example


def test_another_writer_needs_no_function_of_the_example(tmp_path: Path) -> None:
    assert "on_log" not in with_nothing_else(tmp_path, "logging: console")


@pytest.mark.parametrize("entities", only({"binary", "reference"}, ENTITIES))
def test_the_example_has_parameters_log_messages_and_diagnostics(tmp_path: Path, entities: str) -> None:
    config = tmp_path / "microros.yaml"
    config.write_text(APPLICATION.format(entities=entities))
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),))
    out = compiler.generate(options, tmp_path / "out").out
    example = next((out / "examples").rglob("main.c")).read_text()
    assert "_parameters_declare(&node_parameters)" in example
    assert 'RCUTILS_LOG_INFO_NAMED("example", "all entities are open");' in example
    assert "diagnostic_msgs__msg__DiagnosticArray" in example
    compile_example(out)
