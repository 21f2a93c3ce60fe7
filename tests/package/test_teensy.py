# SPDX-License-Identifier: Apache-2.0
"""The package `teensy`: the files of `arduino`, the number of the chip as client key, native Ethernet.

What was linked with Teensyduino's cores by hand is in docs/howto/teensy.md.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.package.render import describe, plan_package, render_package
from tests.support.command_line import Runner
from tests.support.paths import TESTS

CORE = TESTS / "package" / "arduino_core"
NETWORK = """\
#pragma once
#include <HostNetwork.h>
#define LED_BUILTIN 13
#define OUTPUT 1
void pinMode(int pin, int mode);
void digitalWrite(int pin, int value);
int digitalRead(int pin);
typedef HostUDP EthernetUDP;
enum EthernetLinkStatus { Unknown, LinkON, LinkOFF };
struct NativeEthernetClass {
  int begin(uint8_t *, IPAddress) { return 1; }
  EthernetLinkStatus linkStatus() { return LinkON; }
};
static NativeEthernetClass Ethernet;
"""
CHIPS = {
    "4": ("__IMXRT1062__", ("HW_OCOTP_CFG0", "HW_OCOTP_CFG1")),
    "3": ("__MK66FX1M0__", ("SIM_UIDH", "SIM_UIDMH", "SIM_UIDML", "SIM_UIDL")),
    "LC": ("__MKL26Z64__", ("SIM_UIDMH", "SIM_UIDML", "SIM_UIDL")),
}
MAIN = """\
#include "Arduino.h"
#include <stdio.h>
uint32_t word[4];
uint32_t port_unique_id(void);
int main(void)
{
  printf("%u", port_unique_id());
  for (int bit = 0; bit < 32 * WORDS; ++bit) {
    word[bit / 32] ^= 1u << (bit % 32);
    printf(" %u", port_unique_id());
    word[bit / 32] ^= 1u << (bit % 32);
  }
  return 0;
}
"""


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("teensy") / "micro_ros_arduino"
    compiler.write(render_package(plan_package(describe("teensy"), None)), out)
    return out


def test_it_has_the_files_of_arduino(library: Path) -> None:
    arduino = render_package(plan_package(describe("arduino"), None))
    own = [
        name
        for name in arduino
        if name.startswith("src/micro_ros_arduino") or name.endswith((".cpp", ".ino"))
        if name != "src/board_memory.cpp"  # names the package
    ]
    assert own
    for name in own:
        assert (library / name).read_bytes() == arduino[name], name
    examples = {path.name for path in (library / "examples").iterdir()}
    assert examples >= {"publisher", "publisher_native_ethernet", "subscriber"}
    for name in examples:
        assert (library / "examples" / name / f"{name}.ino").is_file()
    assert "microros-gen package teensy" in (library / "README.md").read_text()


def test_a_plan_of_a_project_has_no_examples(run: Runner, folder: Path) -> None:
    (folder / "own.yaml").write_text("version: 1\nprofiles: [pure_sender]\ntransport: {type: custom}\n")
    done = run("package", "teensy", "-c", "own.yaml", "-o", "out")
    assert (done.status, "you define" in done.out) == (0, False), done.err
    assert not (folder / "out" / "examples").exists()


@pytest.mark.builds
@pytest.mark.parametrize("chip", CHIPS)
def test_each_bit_of_the_number_counts(library: Path, tmp_path: Path, chip: str) -> None:
    macro, words = CHIPS[chip]
    registers = "".join(f"#define {name} word[{place}]\n" for place, name in enumerate(words))
    (tmp_path / "Arduino.h").write_text(
        f"#include <stdint.h>\n#define {macro}\n#define WORDS {len(words)}\nextern uint32_t word[4];\n{registers}"
    )
    (tmp_path / "main.c").write_text(MAIN)
    program = tmp_path / "number"
    call = ["gcc", "-std=gnu11", "-Wall", "-Wextra", "-Werror", f"-I{tmp_path}", f"-I{library / 'src'}"]
    files = [str(tmp_path / "main.c"), str(library / "src" / "teensy_port.c"), "-o", str(program)]
    subprocess.run([*call, *files], check=True)
    numbers = subprocess.run([str(program)], capture_output=True, text=True, check=True).stdout.split()
    assert len(set(numbers)) == len(numbers) == 1 + 32 * len(words)
    assert "0" not in numbers


@pytest.mark.builds
def test_the_ethernet_example_calls_what_is_there(library: Path, tmp_path: Path) -> None:
    """A check of syntax with stand-ins of the core and of NativeEthernet."""
    if shutil.which("g++") is None:
        pytest.skip("no g++")
    (tmp_path / "NativeEthernet.h").write_text(NETWORK)
    name = "publisher_native_ethernet"
    call = ["g++", "-std=gnu++17", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-DARDUINO_TEENSY41"]
    call += [f"-I{tmp_path}", f"-I{CORE}", f"-I{library / 'src'}", "-x", "c++", "-include", "Arduino.h"]
    done = subprocess.run(
        [*call, str(library / "examples" / name / f"{name}.ino")], capture_output=True, text=True, check=False
    )
    assert done.stderr == ""


@pytest.mark.builds
def test_a_sketch_of_init_calls_what_is_there(run: Runner, folder: Path) -> None:
    """A check of syntax with stand-ins of the core; the library is that of the sketch's own plan."""
    if shutil.which("g++") is None:
        pytest.skip("no g++")
    done = run("init", "my-robot", "--platform", "teensy")
    assert (done.status, done.err) == (0, "")
    robot = folder / "my-robot"
    call = ["g++", "-std=gnu++17", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", f"-I{folder}", f"-I{CORE}"]
    call += [f"-I{robot / 'libraries' / 'micro_ros_arduino' / 'src'}", "-x", "c++"]
    call += ["-include", "Arduino.h", "-include", "board.h"]
    (folder / "board.h").write_text(NETWORK)
    checked = subprocess.run(
        [*call, str(robot / "my_robot" / "my_robot.ino")], capture_output=True, text=True, check=False
    )
    assert checked.stderr == ""
    assert checked.returncode == 0
