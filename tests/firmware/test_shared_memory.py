# SPDX-License-Identifier: Apache-2.0
"""Two images on the two cores of one chip: QEMU's mps2-an521, an SSE-200 with two Cortex-M33."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.support.firmware.board import C_FILES, Built, compile_merged_image, generate, need, target
from tests.support.firmware.instructions import EXIT
from tests.support.patience import seconds
from tests.support.runtime.images import SYSTEM

TARGET = """\
target: {name}
summary: A core of the MPS2 with AN521, whose CPU 0 has no FPU
extends: cortex-m3
clock_hz: 20000000
flash: {{origin: {flash:#x}, size: 2 MiB}}
ram: {{origin: {ram:#x}, size: 1 MiB}}
uart: {{driver: cmsdk, base: {uart:#x}, irq: {irq}}}
emulator: {{program: qemu-system-arm, package: qemu-system-arm, arguments: [-M, mps2-an521]}}
"""
APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor]
errors: code
system: {{file: ../system.yaml, board: {name}}}
nodes:
  - name: {name}
    publishers: [{{topic: {sent}, type: std_msgs/msg/Int32, local: chip, qos: {{depth: 4}}}}]
    subscriptions: [{{topic: {heard}, type: std_msgs/msg/Int32, local: chip, qos: {{depth: 4}}}}]
"""
CORES = {
    "first": {"flash": 0x10000000, "ram": 0x38000000, "uart": 0x50200000, "irq": 32},
    "second": {"flash": 0x10200000, "ram": 0x38100000, "uart": 0x50201000, "irq": 34},
}
TOPICS = {"first": {"sent": "ping", "heard": "pong"}, "second": {"sent": "pong", "heard": "ping"}}


def image(folder: Path, name: str) -> Path:
    """Build the image of a core."""
    home = folder / name
    place = home / f"{name}.yaml"
    place.write_text(TARGET.format(name=name, **CORES[name]))
    generate(home, str(place), APPLICATION.format(name=name, **TOPICS[name]))
    built = Built(home / "out", target(str(place)))
    compile_merged_image(built)
    elf = home / f"{name}.elf"
    built.link(C_FILES / f"shared_{name}.c", elf)
    return elf


@pytest.mark.variant  # of tests/runtime/test_shared_memory.py, on two boards
@pytest.mark.system
def test_two_cores(tmp_path: Path) -> None:
    need("qemu-mps2-an505", emulator=True)
    (tmp_path / "system.yaml").write_text(SYSTEM)
    for name in CORES:
        (tmp_path / name).mkdir()
        (tmp_path / name / "microros.yaml").write_text(APPLICATION.format(name=name, **TOPICS[name]))
    first, second = image(tmp_path, "first"), image(tmp_path, "second")
    command = ["qemu-system-arm", "-M", "mps2-an521", *EXIT, "-monitor", "none"]
    command += [
        "-serial",
        "null",
        "-serial",
        "null",
        "-kernel",
        str(first),
        "-device",
        f"loader,file={second}",
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stderr) == (0, "")
