# SPDX-License-Identifier: Apache-2.0
"""A node with modes is changed and reconfigured by a node of ROS, over an agent: services, events, parameters."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from microros_gen.cli.modes.devices import read_system
from microros_gen.mode_manager.leaflet import mine
from microros_gen.mode_manager.scope import select_scope
from microros_gen.mode_manager.server import ModeManager
from microros_gen.mode_manager.settings import Settings
from microros_gen.modes.model import active
from microros_gen.ros.peer import Peer
from tests.support.agent.process import environment
from tests.support.e2e.commanded import CommandedProgram
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.mode_asker import ACTIVATE, CONFIGURE, DEACTIVATE, DOUBLE, ModeAsker
from tests.support.e2e.relay import Relay
from tests.support.modes.models import model_of
from tests.support.patience import deadline, seconds

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [managed_service]
components: [+node_modes]
session: {connect_timeout: 20 s, create_timeout: 10 s}
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: speed, type: double, default: 0.5, range: {min: 0.0, max: 2.0}}
      - {name: limit, type: double, default: 1.0}
    modes:
      __DEFAULT__: {limit: $(parent limit)}
      SLOW: {speed: 0.25}
      FAST: {speed: 2.0}
"""
CELL = """\
cell:
  ros__parameters:
    type: system
    parts: [arm/device]
    modes:
      __DEFAULT__: {arm/device: inactive}
      GENTLE: {arm/device: active.SLOW}
      QUICK: {arm/device: active.FAST}
arm/device:
  ros__parameters:
    type: node
    modes:
      __DEFAULT__: {ros__parameters: {speed: 0.5}}
      SLOW: {ros__parameters: {speed: 0.25}}
      FAST: {ros__parameters: {speed: 2.0}}
"""
LIMITED = """\
cell:
  ros__parameters:
    type: system
    parts: [arm/device]
    modes:
      __DEFAULT__: {arm/device: active.SLOW, ros__parameters: {limit: 0.25}}
      WIDE: {arm/device: active.SLOW, ros__parameters: {limit: 0.75}}
      QUICK: {arm/device: active.FAST, ros__parameters: {limit: 0.75}}
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")
REJECTED = 4001


class Asker(ModeAsker):
    """The same with the program that has the device."""

    def __init__(self, program: CommandedProgram, peer: Peer) -> None:
        super().__init__(peer)
        self.program = program

    def shown(self) -> str:
        """Return speed and state, as the program has them."""
        _, _, (line,) = self.program.call("show")
        return line


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    return image.application(C_FILES / "modes.c", tmp_path_factory.mktemp("modes") / "modes", *STRICT)


@pytest.fixture
def asker(
    program: Path, image_port: Relay, agent: object, domain: int, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Asker]:
    for name, value in environment(domain).items():
        monkeypatch.setenv(name, value)
    with Peer(f"asker_{os.getpid()}", domain=domain) as peer, started(program) as process:
        yield Asker(CommandedProgram(process), peer)
        assert process.stdin is not None
        process.stdin.write("end\n")
        ends_well(process)


def test_modes_from_ros(asker: Asker) -> None:
    """All services, in each state; events have the time of the device, which is that of its host."""
    assert asker.ask("get_available_modes")["available_modes"] == ["__DEFAULT__", "SLOW", "FAST"]
    assert not asker.change("SLOW")
    asker.state(CONFIGURE)
    asker.state(ACTIVATE)
    assert asker.mode() == "__DEFAULT__"
    begin = time.time_ns()
    for mode, speed in (("SLOW", "0.25"), ("FAST", "2.00"), ("__DEFAULT__", "0.50")):
        assert asker.change(mode)
        assert asker.mode() == mode
        assert asker.shown() == f"{speed} active"
    assert not asker.change("slow")
    asker.program.call("refuse")
    assert not asker.change("FAST")
    asker.program.call("accept")
    assert asker.shown() == "0.50 active"
    assert asker.await_events(3) == [("__DEFAULT__", "SLOW"), ("SLOW", "FAST"), ("FAST", "__DEFAULT__")]
    assert all(begin - 1_000_000_000 <= at <= time.time_ns() for at in asker.times)


def test_reconfiguration_from_ros(asker: Asker) -> None:
    """By the services that every manager has: inactive, the mode and a parameter that the system gives, active."""
    asker.state(CONFIGURE)
    asker.state(ACTIVATE)
    asker.state(DEACTIVATE)
    assert asker.mode() == ""
    limit = {"name": "limit", "value": {"type": DOUBLE, "double_value": 0.75}}
    assert asker.ask("set_parameters", parameters=[limit])["results"][0]["successful"]
    assert asker.change("FAST")
    asker.state(ACTIVATE)
    assert asker.mode() == "FAST"
    assert asker.shown() == "2.00 active"


def test_reconfiguration_by_the_device(asker: Asker) -> None:
    asker.state(CONFIGURE)
    asker.state(ACTIVATE)
    assert asker.program.call("reconfigure SLOW")[:2] == (0, "")
    assert asker.mode() == "SLOW"
    asker.program.call("refuse")
    code, error, _ = asker.program.call("reconfigure FAST")
    assert (code, error) == (REJECTED, "mode FAST: the callback refused it")
    assert asker.mode() == "SLOW"
    assert asker.shown() == "0.25 active"
    assert asker.await_events(1) == [("__DEFAULT__", "SLOW")]


def test_a_manager_changes_the_mode_while_the_device_is_inactive(asker: Asker, domain: int) -> None:
    """Before the first activation, and between two with `--reconfigure`: no request is refused."""
    states: list[str] = []
    lines: list[str] = []
    asker.peer.subscribe(
        "/arm/device/transition_event",
        "lifecycle_msgs/msg/TransitionEvent",
        lambda event: states.append(event["goal_state"]["label"]),
    )
    model = model_of(CELL)
    with Peer(f"manager_{os.getpid()}", domain=domain) as peer:
        settings = Settings(reconfigured=frozenset({"arm/device"}))
        manager = ModeManager(peer, model, select_scope(model), lines.append, settings)
        orchestrator = manager.orchestrator
        end = deadline(60)
        while orchestrator.statuses()["arm/device"].state != "unconfigured":
            manager.turn()
            assert time.monotonic() < end, lines
        for mode, shown in (("GENTLE", "0.25 active"), ("QUICK", "2.00 active")):
            orchestrator.request("cell", active(mode))
            while orchestrator.statuses()["cell"] != active(mode):
                manager.turn()
                assert time.monotonic() < end, lines
            assert asker.shown() == shown
    assert asker.await_events(2) == [("__DEFAULT__", "SLOW"), ("SLOW", "FAST")]
    reached = ["inactive", "active", "inactive", "active"]
    asker.peer.spin(lambda: [s for s in states if not s.endswith("ing")] == reached, seconds(20))
    assert [s for s in states if not s.endswith("ing")] == reached
    assert not any("refuse" in line for line in lines)


def test_a_manager_gives_values_of_the_parent_and_notices_those_of_others(
    asker: Asker, domain: int, tmp_path: Path
) -> None:
    """As `--application` does: the modes are on the device, the limit is the cell's."""
    model_path, application = tmp_path / "cell.yaml", tmp_path / "microros.yaml"
    model_path.write_text(LIMITED, encoding="utf-8")
    application.write_text(APPLICATION, encoding="utf-8")
    model, _ = read_system(model_path, [application])
    lines: list[str] = []

    def has(speed: float, limit: float) -> bool:
        values = asker.ask("get_parameters", names=["speed", "limit"])["values"]
        return [value["double_value"] for value in values] == [speed, limit]

    with Peer(f"manager_{os.getpid()}", domain=domain) as peer:
        manager = ModeManager(peer, model, select_scope(model), lines.append)
        orchestrator = manager.orchestrator

        def until(condition: Callable[[], bool]) -> None:
            end = deadline(60)
            while not condition():
                manager.turn()
                assert time.monotonic() < end, lines

        def change(mode: str) -> None:
            orchestrator.request("cell", active(mode))
            until(lambda: orchestrator.statuses()["cell"] == active(mode))

        until(lambda: orchestrator.statuses()["arm/device"].state == "unconfigured")
        change("__DEFAULT__")
        assert has(0.25, 0.25)
        change("WIDE")
        assert has(0.25, 0.75)
        change("QUICK")
        assert has(2.0, 0.75)
        until(lambda: not orchestrator.progress.is_moving("cell"))
        assert not any("others" in line for line in lines)
        for name, value in (("speed", 1.5), ("limit", 0.125)):
            parameter = {"name": name, "value": {"type": DOUBLE, "double_value": value}}
            assert asker.ask("set_parameters", parameters=[parameter])["results"][0]["successful"]
            until(lambda: any("from active.FAST to active" in line for line in lines))
            until(lambda: orchestrator.statuses()["cell"] == active("QUICK"))
            until(lambda: not orchestrator.progress.is_moving("cell"))
            assert has(2.0, 0.75)
            lines.clear()


def test_each_mode_of_the_device_is_mined(asker: Asker) -> None:
    """What is printed are the values of the application file; the device is in its mode of before then."""
    asker.state(CONFIGURE)
    asker.state(ACTIVATE)
    assert asker.change("FAST")
    reported: list[str] = []
    assert mine(asker.peer, "arm/device", seconds(30), reported.append).startswith(
        "# Read in the mode FAST. Its modes: __DEFAULT__, SLOW, FAST "
    )
    text = mine(asker.peer, "arm/device", seconds(30), reported.append, each_mode=True)
    assert (asker.mode(), reported) == ("FAST", [])
    modes = model_of(text).parts["arm/device"].modes
    assert {name: mode.parameters["speed"].value for name, mode in modes.items()} == {
        "__DEFAULT__": 0.5,
        "SLOW": 0.25,
        "FAST": 2.0,
    }
