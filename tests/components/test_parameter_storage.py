# SPDX-License-Identifier: Apache-2.0
"""Values of parameters without power: a cut at every unit of the memory, damage, other firmware; files on a host."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from tests.support.components.rendered import SANITIZE, UNITS, planned, program_of, rendered, run
from tests.support.matrix import has
from tests.support.patience import seconds

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+parameter_storage]
nodes:
  - name: arm
    parameters:
      - {name: gain, type: double, default: 1, range: {min: 0, max: 10}}
      - {name: label, type: string, size: 12}
      - {name: ports, type: "integer[]", size: 3, default: [1]}
      - {name: on, type: bool}
"""


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return rendered(tmp_path_factory.mktemp("storage"), APPLICATION)


@pytest.mark.system
def test_power_is_lost_at_every_unit(out: Path) -> None:
    """The unit's memory stands in for that of the port, whose file is left out."""
    program = program_of(out, "unit_parameter_storage.c", without=["port_posix_storage.c"])
    assert int(run(program).split()[0]) > 40


def test_slots_of_a_host_are_files(out: Path, tmp_path: Path) -> None:
    program, folder = tmp_path / "unit", tmp_path / "kept"
    port = next((out / "src").rglob("port_posix_storage.c"))
    run("gcc", *SANITIZE, f"-I{out / 'include'}", UNITS / "unit_posix_storage.c", port, "-o", program)
    folder.mkdir()
    for what, place in (("write", folder), ("read", folder), ("missing", tmp_path / "nowhere")):
        variables = {**os.environ, "MICROROS_STORAGE": str(place)}
        done = subprocess.run(
            [program, what], env=variables, capture_output=True, text=True, timeout=seconds(20), check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
    assert [path.name for path in folder.iterdir()] == ["microros_storage.1"]


def test_a_board_needs_functions_of_the_application(tmp_path: Path) -> None:
    found = planned(tmp_path, APPLICATION + "target: qemu-mps2-an386\nsession: {key: 5}\n")
    names = {"port_storage_erase", "port_storage_write", "port_storage_read"}
    assert names <= set(found.project.provisions.functions())


@pytest.mark.system
@pytest.mark.skipif(not has("gcc"), reason="no compiler")
def test_it_builds_and_brings_parameters_with_it(tmp_path: Path) -> None:
    found = planned(tmp_path, APPLICATION)
    compiler.write(compiler.render(found), tmp_path / "built")
    assert (tmp_path / "built" / compiler.compile(found, tmp_path / "built").report.library).is_file()
