# SPDX-License-Identifier: Apache-2.0
"""A node with modes on a board: a node of ROS drives it over the serial line; its size, also of each mode."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import cycle
from pathlib import Path
from typing import Any

import pytest

from microros_gen.cli.size.format import constants
from microros_gen.image.report import measure
from microros_gen.ros.peer import Peer
from tests.support.agent.process import enter_domain
from tests.support.e2e.mode_asker import ACTIVATE, CONFIGURE, ModeAsker
from tests.support.firmware.board import Board, Builds, Built, board, check, generate, need
from tests.support.firmware.footprint import bounded_stack, image_sections
from tests.support.firmware.running import started
from tests.support.patience import deadline, seconds
from tests.support.slices import beyond

NAME = "qemu-mps2-an386"
PARAMETERS = """\
version: 1
profiles: [managed_service]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: speed, type: double, default: 0.5, range: {min: 0.0, max: 2.0}}
      - {name: gain, type: integer, default: 3}
      - {name: limit, type: double, default: 1.0}
      - {name: brake, type: bool}
"""
MODES = """\
    modes:
      __DEFAULT__: {limit: $(parent limit)}
      SLOW: {speed: 0.2, brake: true}
      FAST: {speed: 2.0, gain: 5, limit: 2.5}
"""
APPLICATION = f"{PARAMETERS}{MODES}components: [+node_modes]\n"
WITHOUT = f"{PARAMETERS}components: [+parameters]\n"
SIZES = {NAME: (33_420, 6_796, 1_184), "qemu-mps2-an505": (35_028, 6_804, 1_188)}
"""Flash, RAM without the stack, worst stack."""
MORE = (3_112, 576)
"""Flash and RAM of modes on the Cortex-M4: what the image has more than without them."""
EACH = {"mode arm_device_DEFAULT": 36, "mode arm_device_FAST": 32, "mode arm_device_SLOW": 36}
"""Bytes of each mode: 8 for a number, 1 for each parameter where the system sets one."""

UNCONFIGURED, ACTIVE = 1, 3
BOOL, INTEGER, DOUBLE = 1, 2, 3
NAMES = ["speed", "gain", "limit", "brake"]
KINDS = {"speed": DOUBLE, "gain": INTEGER, "limit": DOUBLE, "brake": BOOL}
MEMBERS = {BOOL: "bool_value", INTEGER: "integer_value", DOUBLE: "double_value"}
DEFAULTS = [0.5, 3, 1.0, False]


@pytest.fixture
def driven(builds: Builds) -> tuple[Built, Path]:
    """Return the output and the image whose parameters decide what its callbacks do."""
    need(NAME, emulator=True)
    built = builds.merged(NAME, APPLICATION)
    return built, builds.application(built, "modes.c", "-DMODES_DRIVEN")


@pytest.fixture
def own_domain(monkeypatch: pytest.MonkeyPatch) -> int:
    return enter_domain(monkeypatch)


@contextmanager
def agent_of(running: Board, domain: int) -> Iterator[Any]:
    """Run an agent at the board's line."""
    with started("agent", "serial", "--dev", running.device, "--domain", str(domain), domain=domain) as agent:
        agent.wait_for("agent ready", 30)
        yield agent


def values(asker: ModeAsker) -> list[Any]:
    """Return the parameters in the order of `NAMES`."""
    found = asker.ask("get_parameters", names=NAMES)["values"]
    return [value[MEMBERS[value["type"]]] for value in found]


def give(asker: ModeAsker, **changed: Any) -> None:
    """Set parameters, as a system does with those that its modes leave to it."""
    requests = [
        {"name": name, "value": {"type": KINDS[name], MEMBERS[KINDS[name]]: value}}
        for name, value in changed.items()
    ]
    assert all(result["successful"] for result in asker.ask("set_parameters", parameters=requests)["results"])


@pytest.mark.system
@pytest.mark.ros
def test_a_node_of_ros_changes_modes_of_a_board(driven: tuple[Built, Path], own_domain: int) -> None:
    """Services, events and parameters; what is refused, by either callback, leaves every value as it was."""
    with (
        Peer(f"asker_{os.getpid()}", domain=own_domain) as peer,
        board(*driven) as running,
        agent_of(running, own_domain),
    ):
        running.go_on()
        asker = ModeAsker(peer)
        assert asker.ask("get_available_modes")["available_modes"] == ["__DEFAULT__", "SLOW", "FAST"]
        assert not asker.change("SLOW"), "it is unconfigured"
        asker.state(CONFIGURE)
        asker.state(ACTIVATE)
        assert (asker.mode(), values(asker)) == ("__DEFAULT__", DEFAULTS)
        assert asker.change("SLOW")
        slow = [0.2, 3, 1.0, True]
        assert (asker.mode(), values(asker)) == ("SLOW", slow)
        assert not asker.change("FAST"), "the callback of modes refuses it with the brake on"
        assert (asker.mode(), values(asker)) == ("SLOW", slow)
        give(asker, brake=False, limit=0.5)
        assert not asker.change("FAST"), "the callback of parameters refuses the gain, after the speed"
        slow = [0.2, 3, 0.5, False]
        assert (asker.mode(), values(asker)) == ("SLOW", slow)
        give(asker, limit=1.5)
        assert asker.change("FAST")
        assert (asker.mode(), values(asker)) == ("FAST", [2.0, 5, 2.5, False])
        assert not asker.change("fast")
        assert asker.await_events(2) == [("__DEFAULT__", "SLOW"), ("SLOW", "FAST")]
        running.wait_for(lambda: running.words("modes_report", 3) == [ACTIVE, 2, 2000])


@pytest.mark.system
@pytest.mark.ros
def test_an_agent_that_restarts_during_a_change(driven: tuple[Built, Path], own_domain: int) -> None:
    """The change is completed once, its response gets nobody; events go on when readers know the new agent."""
    with Peer(f"asker_{os.getpid()}", domain=own_domain) as peer, board(*driven) as running:
        with agent_of(running, own_domain) as agent:
            running.go_on()
            asker = ModeAsker(peer)
            asker.state(CONFIGURE)
            asker.state(ACTIVATE)
            give(asker, limit=9.5)
            calls = running.words("modes_report", 4)[3]
            answers = asker.begin("change_mode", mode_name="SLOW")
            running.wait_for(lambda: running.words("modes_held") == [1])
            running.pause()
            agent.process.kill()
            agent.process.wait(timeout=seconds(15))
        assert running.words("modes_held") == [1]
        with agent_of(running, own_domain):
            running.go_on()
            asker.await_answer("get_mode", {})
            assert (asker.mode(), values(asker)) == ("SLOW", [0.2, 3, 9.5, True])
            assert running.words("modes_report", 4)[3] == calls + 1
            assert not answers
            give(asker, brake=False, limit=1.0)
            asker.events.clear()  # that of the change, which arrives only where the reader is known in time
            end, modes = deadline(30), cycle(("FAST", "__DEFAULT__"))
            while not asker.events:
                assert time.monotonic() < end
                assert asker.change(next(modes))
                peer.spin(lambda: asker.events, 0.5)
            start, goal = asker.events[-1]
            assert start != goal == asker.mode()


@pytest.mark.system
@pytest.mark.ros
def test_a_board_that_is_reset_begins_with_its_defaults(driven: tuple[Built, Path], own_domain: int) -> None:
    """Also in the middle of a change: unconfigured, no mode, every parameter as declared; the way back is open."""
    with (
        Peer(f"asker_{os.getpid()}", domain=own_domain) as peer,
        board(*driven, restarts=True) as running,
        agent_of(running, own_domain),
    ):
        running.go_on()
        asker = ModeAsker(peer)
        asker.state(CONFIGURE)
        asker.state(ACTIVATE)
        assert asker.change("SLOW")
        give(asker, limit=9.5, brake=False)
        answers = asker.begin("change_mode", mode_name="FAST")
        running.wait_for(lambda: running.words("modes_held") == [1])
        running.restart()
        running.wait_for(lambda: running.words("modes_report", 3) == [UNCONFIGURED, 0, 500], 60)
        asker.await_answer("get_mode", {})
        assert (asker.mode(), values(asker)) == ("", DEFAULTS)
        assert not answers
        assert not asker.change("FAST")
        asker.state(CONFIGURE)
        asker.state(ACTIVATE)
        assert asker.mode() == "__DEFAULT__"
        assert asker.change("FAST")
        assert values(asker) == [2.0, 5, 2.5, False]


@pytest.mark.system
@pytest.mark.parametrize(("name", "limits"), beyond(SIZES, {"qemu-mps2-an505"}))
def test_its_size(builds: Builds, name: str, limits: tuple[int, int, int]) -> None:
    """Life cycle, parameters and modes, executor, over a serial line."""
    need(name)
    built = builds.build(name, APPLICATION)
    image = builds.application(built, "modes.c")
    size = image_sections(built, image)
    found = (size.text + size.data, size.ram, bounded_stack(built, image))
    assert all(value <= limit for value, limit in zip(found, limits, strict=True)), found


@pytest.mark.system
def test_what_modes_take(builds: Builds) -> None:
    need(NAME)
    built, plain = builds.build(NAME, APPLICATION), builds.build(NAME, WITHOUT)
    image = image_sections(built, builds.application(built, "modes.c"))
    without = image_sections(plain, builds.application(plain, "modes_without.c"))
    found = (image.text + image.data - without.text - without.data, image.ram - without.ram)
    assert all(value <= limit for value, limit in zip(found, MORE, strict=True)), found


@pytest.mark.system
def test_the_size_of_each_mode_is_reported(builds: Builds) -> None:
    """In flash alone, as nm has it; a number has 8 bytes, and the texts of others are in the mode that writes them."""
    need(NAME)
    built = builds.build(NAME, APPLICATION)
    image = builds.application(built, "modes.c")
    report = measure(built.out, image)
    assert {use: sizes for owner, use, *sizes in constants(report) if owner == "node_modes"} == {
        use: [size, 0] for use, size in EACH.items()
    }
    lines = [line.split() for line in check([built.tool("nm"), "-S", str(image)]).splitlines()]
    of_modes = [line for line in lines if len(line) == 4 and line[3].startswith("mode_of_")]
    assert sum(int(size, 16) for _, size, _, _ in of_modes) == sum(EACH.values())
    assert {kind for _, _, kind, _ in of_modes} <= {"r", "t"}, "they are in flash"


@pytest.mark.system
def test_a_further_mode_takes_no_ram(builds: Builds) -> None:
    need(NAME)
    more = builds.build(NAME, APPLICATION.replace("      FAST:", "      WALK: {speed: 1.0}\n      FAST:"))
    assert "mode_of_arm_device_WALK" in " ".join(more.symbols(image := builds.application(more, "modes.c")))
    built = builds.build(NAME, APPLICATION)
    before = image_sections(built, builds.application(built, "modes.c"))
    assert image_sections(more, image).ram == before.ram


def test_a_client_without_modes_has_nothing_of_them(tmp_path: Path) -> None:
    generate(tmp_path, NAME, WITHOUT)
    plain = tmp_path / "out"
    assert (plain / "src" / "parameters").exists()
    assert not (plain / "src" / "node_modes").exists()
    assert "modes" not in (plain / "include" / "microros" / "xrce_client.h").read_text()
