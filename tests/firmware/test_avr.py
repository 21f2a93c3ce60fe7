# SPDX-License-Identifier: Apache-2.0
"""An Arduino Uno with 2 KiB of RAM is a node of ROS 2: sizes, and samples in both directions in a simulator."""

from __future__ import annotations

import os
import re
import struct
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.firmware.avr import (
    ANSWERS,
    EXCHANGES,
    MEGA,
    READS,
    SENDS,
    UNO,
    bounded,
    flash_and_ram,
    linked,
    read_line,
    simulated,
)
from tests.support.firmware.board import C_FILES, Builds, Built, build, check, generate, need, target
from tests.support.firmware.line import scripted_agent
from tests.support.firmware.running import started
from tests.support.paths import ROOT
from tests.support.patience import deadline, seconds
from tests.support.quality.corpus import APPLICATIONS
from tests.support.runtime.reading_agent import ReadingAgent
from tests.support.slices import first, spread_rows

FLASH, RAM = 32 * 1024, 2048
ROOM = {UNO: (FLASH, RAM), MEGA: (256 * 1024, 8192)}
FLASH_READERS = (
    *("action_server", "action_client", "graph_topic_xml", "lifecycle", "logger_services"),
    *("services_xml", "reader_xml", "sleep_reader", "remapped"),
)
"""Applications of the corpus that an AVR has room to compile."""
POWER, WATCHDOG = 1, 4
"""Of port_reset_t."""


def _on_avr(name: str) -> str:
    """Return an application of the corpus without its line and with a key."""
    return re.sub(r"(?m)^transport:.*\n", "", APPLICATIONS[name]) + "session: {key: 1}\n"


def test_what_a_sender_takes(builds: Builds) -> None:
    """Goals: 16,000 bytes of flash and 900 of RAM, with the driver of the UART."""
    need(UNO)
    built = builds.build(UNO, SENDS)
    flash, ram = flash_and_ram(built, built.image)
    assert flash <= 11_950
    assert ram <= 760


def test_texts_of_errors_stay_in_flash(builds: Builds) -> None:
    """An Uno has room for them: each object of the library's texts lies below the code."""
    need(UNO)
    built = builds.build(UNO, SENDS.replace("errors: code", "errors: text"))
    flash, ram = flash_and_ram(built, built.image)
    assert flash <= 15_000
    assert ram <= 1150
    names = [name for name in built.symbols() if name.startswith("microros_error_")]
    assert len(names) > 20
    assert all(built.symbols()[name] < FLASH for name in names)
    assert ram + bounded(built, built.image)[0] < RAM


@pytest.mark.system
def test_texts_of_errors_are_read_from_flash(builds: Builds) -> None:
    """One with the name of an argument, which lies there, too, and one with numbers."""
    built = builds.build(MEGA, SENDS.replace("errors: code", "errors: text"))
    wanted = b"support or allocator: NULL or not initialized\0domain 1000 is above 232\0"
    with simulated(builds, built, linked(builds, built, "error_texts.c")) as board:
        line = os.open(board.device, os.O_RDWR | os.O_NOCTTY)
        try:
            assert read_line(line, len(wanted)) == wanted
        finally:
            os.close(line)


@pytest.mark.system
def test_too_many_variables_are_an_error_with_a_remedy(tmp_path: Path) -> None:
    """With memory for messages and texts of errors."""
    need(UNO)
    text = SENDS.replace("errors: code", "errors: text")
    done = build(tmp_path, UNO, f"{text}memory: {{arena: 1 KiB}}\n")
    assert done.returncode == 1
    assert "The variables take more than the target's RAM: `errors: code` leaves out" in done.stderr


@pytest.mark.system
def test_a_stack_without_room_is_an_error(tmp_path: Path) -> None:
    """Variables fit the RAM, and the worst stack with them does not: a board would overwrite its variables."""
    need(UNO)
    text = EXCHANGES.replace("errors: code", "errors: code\nentities: xml")
    done = build(tmp_path, UNO, text)
    assert done.returncode == 1
    reason = re.search(r"has (\d+) bytes of variables and needs up to (\d+) of stack", done.stderr)
    assert reason is not None
    variables, stack = map(int, reason.groups())
    assert variables < RAM < variables + stack
    assert "[MG-8608]" in done.stderr
    budget = re.search(r"memory: \{ram_budget: \d+\}", done.stderr)
    assert budget is not None
    again = build(tmp_path, UNO, f"{text}{budget[0]}\n")
    assert again.returncode == 1
    assert "raise the budget" in again.stderr


@pytest.mark.system
@pytest.mark.parametrize("name", first([UNO, MEGA]))
@pytest.mark.parametrize(
    "application",
    [
        pytest.param(SENDS, id="sends"),
        pytest.param(READS, id="reads", marks=pytest.mark.variant),  # EXCHANGES has both directions
        pytest.param(EXCHANGES, id="exchanges"),
    ],
)
def test_the_stack_has_a_bound(builds: Builds, name: str, application: str) -> None:
    """The generated example: what its callbacks are is known, so that nothing is left out."""
    need(name)
    built = builds.build(name, application)
    bound, left_out = bounded(built, built.image)
    assert left_out == []
    assert 250 < bound < 700


@pytest.mark.parametrize(
    ("errors", "entities"),
    spread_rows([("text", "xml"), ("code", "binary"), ("code", "xml"), ("text", "binary")]),
)
def test_names_of_types_and_descriptions_stay_in_flash(builds: Builds, entities: str, errors: str) -> None:
    """What is copied to RAM before main contains neither a name of a type in DDS nor an element of XML."""
    need(MEGA)
    application = EXCHANGES.replace("errors: code", f"errors: {errors}\nentities: {entities}")
    built = builds.build(MEGA, application)
    copied, image = built.out / "copied.bin", built.image.read_bytes()
    check([built.tool("objcopy"), "-O", "binary", "-j", ".data", str(built.image), str(copied)])
    data = copied.read_bytes()
    assert b"/count" in data, "the names of topics are the application's, too"
    for words in (b"dds_::Int32_", b"</", b"MISMATCH"):
        assert words not in data
    assert b"dds_::Int32_" in image
    assert (b"</name><dataType>" in image) == (entities == "xml")


def _converted(out: Path, sources: Sequence[str]) -> str:
    """Return what the compiler says of sources below `out` with a warning for each pointer that leaves flash."""
    avr = target(MEGA)
    flags = [*avr.c_flags, "-Iinclude", "-Waddr-space-convert", "-Wextra", "-fsyntax-only"]
    call = [avr.compilers[0], *flags, *sources]
    done = subprocess.run(call, cwd=out, text=True, capture_output=True, check=False, timeout=seconds(60))
    return done.stderr


@pytest.mark.system
def test_flash_is_not_read_as_ram(tmp_path: Path) -> None:
    """A pointer to flash that becomes one to RAM compiles, and reads another place; a warning tells.

    The plans have every component that an AVR can have and that reads names of types, descriptions or tables. Files
    that two plans have in common are compiled once.
    """
    need(MEGA)
    compiled: set[tuple[str, bytes]] = set()
    for name in FLASH_READERS:
        home = tmp_path / name
        home.mkdir()
        generate(home, MEGA, _on_avr(name))
        files = [file for file in (home / "out" / "sources.txt").read_text().split() if file.endswith(".c")]
        fresh = [file for file in files if (file, (home / "out" / file).read_bytes()) not in compiled]
        compiled |= {(file, (home / "out" / file).read_bytes()) for file in fresh}
        assert _converted(home / "out", fresh) == ""
    (home / "out" / "wrong.c").write_text(
        '#include "microros/plan.h"\nconst microros_declared_endpoint_t * wrong(void);\n'
        "const microros_declared_endpoint_t * wrong(void) { return microros_declared_endpoints; }\n"
    )
    assert "addr-space-convert" in _converted(home / "out", ["wrong.c"])


def test_applications_in_iso_c_pass_no_pointer_to_both_memories(tmp_path: Path) -> None:
    """In ISO C and C++ such a pointer has 2 bytes, not 3: no function in a public header may pass one on."""
    need(MEGA)
    generate(tmp_path, MEGA, _on_avr("action_server"))
    out, avr = tmp_path / "out", target(MEGA)
    include = out / "include"
    headers = sorted(path.relative_to(include) for path in include.rglob("*.h"))
    texts = {header: (include / header).read_text() for header in headers}
    takes_both = {
        name
        for text in texts.values()
        for name, arguments in re.findall(r"(\w+)\(([^;{}()]*)\)\s*[;{]", text)
        if "MICROROS_ANYWHERE" in arguments
    }
    assert {"microros_text_size", "microros_error_set"} <= takes_both
    public = [name for name in headers if name.parts[0] != "microros" and "#error" not in texts[name]]
    (out / "all.c").write_text("".join(f"#include <{name.as_posix()}>\n" for name in public))
    flags = [*avr.c_flags, "-std=c99", "-O0", "-fkeep-inline-functions", "-Iinclude"]
    check([avr.compilers[0], *flags, f"-I{include}", "-c", str(out / "all.c"), "-o", str(out / "all.o")])
    called = set(check([Built(out, avr).tool("nm"), "-u", str(out / "all.o")]).split())
    assert len(called) > 3
    assert called & takes_both == set()


def test_a_budget_of_the_stack(tmp_path: Path) -> None:
    need(UNO)
    done = build(tmp_path, UNO, f"{SENDS}memory: {{stack: 100}}\n")
    assert done.returncode == 1
    assert re.search(r"worst stack from main with 3 interrupt handler\(s\) on top: [0-9]+ bytes", done.stderr)


@pytest.mark.variant  # of tests/package/test_arduino.py: a service on a Mega
@pytest.mark.ros
def test_a_server_of_set_bool(builds: Builds, observer: Observer, domain: int) -> None:
    """A Mega answers requests; the stack stays below its bound."""
    built = builds.build(MEGA, ANSWERS)
    image = linked(builds, built, "setbool.c")
    with simulated(builds, built, image) as board:
        with started(
            "agent", "serial", "--dev", board.device, "--domain", str(domain), domain=domain
        ) as agent:
            agent.wait_for("agent ready")
            for data in (True, False):
                observer.ask(do="set_bool", service="/set_bool", data=data)
                _answered(observer, data)
        touched = board.touched_stack()
    assert touched <= bounded(built, image)[0]


def _answered(observer: Observer, data: bool) -> None:
    end = deadline(60)
    while observer.ask(do="answers") != [[data, "ok"]]:
        assert time.monotonic() < end, "no answer"
        time.sleep(0.1)


@pytest.mark.ros
@pytest.mark.parametrize(
    ("name", "entities"),
    [(UNO, "binary"), pytest.param(MEGA, "xml", marks=[pytest.mark.system, pytest.mark.variant])],
    ids=["binary", "xml"],
)
def test_samples_of_both_directions(
    builds: Builds, observer: Observer, domain: int, name: str, entities: str
) -> None:
    """Publisher, subscription, timer and executor; the agent restarts in between.

    An Uno has too little RAM for descriptions in XML: 1,797 bytes, and a stack of 466.
    """
    need(name)
    built = builds.build(name, f"{EXCHANGES}entities: {entities}\n")
    image = linked(builds, built, "uno.c")
    flash, ram = flash_and_ram(built, image)
    bound, left_out = bounded(built, image)
    assert flash <= ROOM[name][0]
    assert ram + bound < ROOM[name][1], "the stack would overwrite variables"
    observer.subscribe("/count", "std_msgs/msg/Int32")
    with simulated(builds, built, image) as board:
        serial = ("agent", "serial", "--dev", board.device, "--domain", str(domain))
        for number in (1234, -1235):
            with started(*serial, domain=domain) as agent:
                agent.wait_for("agent ready")
                _published_until_heard(observer, number)
        touched = board.touched_stack()
    assert touched <= bound
    assert [called for called in left_out if "callback" not in called] == []


def _published_until_heard(observer: Observer, number: int) -> None:
    end = deadline(60)
    while ["/count", {"data": number}] not in observer.ask(do="samples"):
        assert time.monotonic() < end, "not heard"
        where = {"topic": "/led", "type": "std_msgs/msg/Int16"}
        observer.ask(do="publish", values=[{"data": number}], **where)
        time.sleep(0.1)


class Forger(ReadingAgent):
    """Sends, with each answer, reliable messages whose submessages pretend to have nearly 2^16 bytes."""

    def receive(self, datagram: bytes) -> list[bytes]:
        answers = super().receive(datagram)
        forged = [
            b"\x81\x80\0\0\x09\x01" + struct.pack("<H", size) + bytes(4) for size in range(65528, 65536)
        ]
        return answers + (forged if self.connected and self.written else [])


@pytest.mark.system
def test_lengths_that_a_16_bit_sum_cannot_hold(builds: Builds) -> None:
    """The position after such a submessage is one that was there before: a loop over them would never end."""
    need(UNO)
    built = builds.build(UNO, f"{EXCHANGES}entities: binary\n")
    image, agent = linked(builds, built, "uno.c"), Forger()
    with simulated(builds, built, image) as board, scripted_agent(board.device, agent):
        end = deadline(20)
        while len(agent.written) < 3:
            assert time.monotonic() < end, "the board hangs"
            time.sleep(0.1)


RELIABLE = """\
version: 1
profiles: [pure_sender]
errors: code
liveliness: acknack
session: {key: 1, create_timeout: 20 s, liveliness_timeout: 180 s}
nodes: [{name: mega, publishers: [{topic: count, type: std_msgs/msg/Int32}]}]
"""
TIMES = """\
#include "microros/xrce_liveliness_acknack.h"
#include "microros/xrce_stream_reliable.h"
_Static_assert(XRCE_HELD_MS == 80000, "a node and the three objects of a publisher");
uint32_t lost_ms(void);
uint32_t lost_ms(void)
{
  static const xrce_liveliness_acknack_t silent = {0};
  return xrce_liveliness_acknack_due(&silent);
}
"""


@pytest.mark.system
def test_times_that_a_16_bit_product_cannot_hold(tmp_path: Path) -> None:
    """An int of this compiler ends at 65.5 s: messages were let go, and sessions lost, after what is left of it."""
    need(MEGA)
    generate(tmp_path, MEGA, RELIABLE)
    (tmp_path / "out" / "times.c").write_text(TIMES)
    avr = target(MEGA)
    call = [avr.compilers[0], *avr.c_flags, "-Iinclude", "-S", "-o", "-", "times.c"]
    done = subprocess.run(
        call, cwd=tmp_path / "out", text=True, capture_output=True, check=False, timeout=seconds(60)
    )
    assert done.stderr == ""
    loaded = [int(byte, 0) & 0xFF for byte in re.findall(r"ldi r2[2-5],lo8\((-?\w+)\)", done.stdout)]
    assert int.from_bytes(loaded, "little") == 180_000, done.stdout


@pytest.mark.parametrize("name", [UNO, MEGA])
def test_the_cause_of_a_reset(builds: Builds, name: str, tmp_path: Path) -> None:
    """It is turned on, then the watchdog resets it; each cause is told again until the next reset."""
    need(name)
    processor, image = target(name), tmp_path / "reset_cause.elf"
    parts = ROOT / "microros_gen"
    include = parts / "components" / "diagnosis" / "include"
    source = parts / "platform" / "cpu" / "avr" / "src" / "port_avr_reset.c"
    flags = [*processor.c_flags, "-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{include}"]
    check([processor.compilers[0], *flags, str(C_FILES / "reset_cause.c"), str(source), "-o", str(image)])
    built = Built(builds.build(name, SENDS).out, processor)
    with simulated(builds, built, image) as board:
        # Raw already; tty.setraw would also discard what the board has sent by now.
        line = os.open(board.device, os.O_RDWR | os.O_NOCTTY)
        try:
            assert read_line(line, 6) == f"{POWER}{POWER}0{WATCHDOG}{WATCHDOG}0".encode()
        finally:
            os.close(line)
