# SPDX-License-Identifier: Apache-2.0
"""What a device reports of itself on /diagnostics, as rclpy receives it; an error of a check changes the mode."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from microros_gen.cli.modes.devices import read_system
from microros_gen.mode_manager.diagnosis import PartStatus, read_statuses
from microros_gen.mode_manager.scope import select_scope
from microros_gen.mode_manager.server import ModeManager
from microros_gen.modes.model import DiagnosticLevels, active
from microros_gen.ros.peer import Peer
from tests.support.agent.observer import Observer
from tests.support.agent.process import environment, running_agent
from tests.support.e2e.commanded import CommandedProgram
from tests.support.e2e.images import C_FILES, Images, ends_well, started
from tests.support.e2e.relay import Relay
from tests.support.patience import deadline

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [managed_service]
components: [+node_modes, +timers, +diagnosis]
logging: rosout
session: {connect_timeout: 20 s, create_timeout: 10 s, liveliness_timeout: 1 s, liveliness_period: 500 ms}
diagnosis:
  period: 200 ms
  hardware_id: board-7
  deadline: 50 ms
  callbacks: [{name: tick, limit: 100 ms}]
  checks:
    - name: battery
      unit: mV
      below: {warn: 11500, error: 11000}
      hysteresis: 200
      timeout: 60 s
      mode: SLOW
      node: device
nodes:
  - name: device
    namespace: /arm
    timers: [{name: tick, period: 20 ms}]
    parameters: [{name: speed, type: double, default: 0.5, range: {min: 0.0, max: 2.0}}]
    modes:
      SLOW: {speed: 0.25}
"""
STRICT = ("-std=c99", "-Wall", "-Wextra", "-Werror")
TOPIC, TYPE = "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"
OK, WARN, ERROR, STALE = range(4)
NAMES = {"executor", "timers", "errors", "log", "session", "battery", "callback tick"}


class Board:
    """The program, and what rclpy has received of it."""

    def __init__(self, program: CommandedProgram, observer: Observer) -> None:
        self.call = program.call
        self._observer = observer
        self.arrays: list[dict[str, Any]] = []

    def look(self) -> None:
        """Take what has arrived."""
        self.arrays += [value for topic, value in self._observer.ask(do="samples") if topic == TOPIC]

    def next(self, name: str, seen: Callable[[dict[str, Any]], object] = bool) -> dict[str, Any]:
        """Return the next status of that name which `seen` accepts."""
        self.look()
        self.arrays.clear()
        end = deadline(60)
        while True:
            for array in self.arrays:
                for status in array["status"]:
                    if status["name"] == f"arm/device: {name}" and seen(status):
                        return dict(status)
            assert time.monotonic() < end, [s for a in self.arrays for s in a["status"]][-8:]
            time.sleep(0.02)
            self.look()


def values(status: dict[str, Any]) -> dict[str, str]:
    return {pair["key"]: pair["value"] for pair in status["values"]}


@pytest.fixture(scope="module")
def program(images: Images, image_port: Relay, tmp_path_factory: pytest.TempPathFactory) -> Path:
    image = images.build(image_port.port, APPLICATION)
    return image.application(C_FILES / "diagnosis.c", tmp_path_factory.mktemp("diag") / "diagnosis", *STRICT)


@pytest.fixture
def board(program: Path, observer: Observer, image_port: Relay, agent: object) -> Iterator[Board]:
    observer.subscribe(TOPIC, TYPE)
    with started(program) as process:
        yield Board(CommandedProgram(process), observer)
        assert process.stdin is not None
        process.stdin.write("end\n")
        ends_well(process)


def test_everything_is_reported_once_in_a_period(board: Board) -> None:
    board.next("session")
    begin = time.monotonic()
    counted = 0
    while time.monotonic() < begin + 2:
        board.next("session")
        counted += 1
    assert 2 <= counted <= 11, "five a second"
    found: dict[str, dict[str, Any]] = {}
    while found.keys() != NAMES:
        board.next("session")
        found |= {s["name"].partition(": ")[2]: s for array in board.arrays for s in array["status"]}
    assert {status["hardware_id"] for status in found.values()} == {"board-7"}
    assert all(len(array["status"]) == 1 for array in board.arrays)
    assert all(abs(array["header"]["stamp"]["sec"] - time.time()) < 60 for array in board.arrays)
    assert (found["session"]["level"], found["session"]["message"]) == (OK, "ok")
    counters = values(found["session"])
    assert list(counters) == ["sent", "resent", "received", "malformed", "dropped", "reconnects", "refused"]
    assert int(counters["sent"]) > 10
    later = values(board.next("session"))
    assert int(later["sent"]) > int(counters["sent"])
    executor = values(found["executor"])
    assert list(executor) == ["rounds", "longest_us", "missed", "cpu_percent", "warn"]
    assert int(executor["rounds"]) > 0
    assert 0 <= int(executor["cpu_percent"]) <= 100
    battery = found["battery"]
    assert (battery["level"], battery["message"]) == (STALE, "not set, or too long ago")
    assert values(battery) == {
        "value": "unknown",
        "unit": "mV",
        "warn": "11500",
        "error": "11000",
        "mode": "SLOW",
        "mode waits": "false",
    }


def test_overruns_and_missed_deadlines(board: Board) -> None:
    """A callback of 70 ms is longer than the deadline, and the timer of 20 ms has missed its next calls."""
    before = {name: values(board.next(name)) for name in ("executor", "timers")}
    board.call("busy 150")
    executor = board.next("executor", lambda s: s["message"] == "missed has changed")
    assert executor["level"] == WARN
    after = values(executor)
    assert int(after["missed"]) > int(before["executor"]["missed"])
    assert 150_000 <= int(after["longest_us"]) < 10_000_000
    timers = board.next("timers", lambda s: int(values(s)["overruns"]) > int(before["timers"]["overruns"]))
    assert int(values(timers)["latest_us"]) >= 20_000


def test_times_of_a_callback(board: Board) -> None:
    """One of 150 ms is the longest and an overrun, a warning; those after it are short. C has the same numbers."""
    before = values(board.next("callback tick"))
    assert list(before) == ["runs", "last_us", "longest_us", "overruns"]
    board.call("busy 150")
    late = board.next("callback tick", lambda s: s["message"] == "overruns has changed")
    assert late["level"] == WARN
    after = values(board.next("callback tick", lambda s: int(values(s)["last_us"]) < 100_000))
    assert int(after["runs"]) > int(before["runs"])
    assert int(after["overruns"]) > int(before["overruns"])
    assert int(after["longest_us"]) >= 150_000
    code, _, (line,) = board.call("times")
    runs, last_us, longest_us, overruns = map(int, line.split())
    assert code == 0
    assert runs >= int(after["runs"])
    assert overruns >= int(after["overruns"])
    assert longest_us >= int(after["longest_us"]) >= last_us


def shares_in(status: dict[str, Any]) -> list[int]:
    """Return the share of the processor in percent; none where it is not known yet."""
    return [int(v) for k, v in values(status).items() if k == "cpu_percent" and v != "unknown"]


def test_share_of_the_processor(board: Board) -> None:
    """Callbacks that last for nearly a whole period are nearly 100 %; a node that waits is far below.

    What others do on the machine counts as well, so a period is waited for in which the node had the processor.
    """
    board.next("executor", lambda s: any(share < 60 for share in shares_in(s)))
    board.call("busy 900")
    board.next("executor", lambda s: any(share > 90 for share in shares_in(s)))
    board.next("executor", lambda s: any(share < 60 for share in shares_in(s)))


def test_errors_are_counted(board: Board) -> None:
    before = int(values(board.next("errors"))["count"])
    code, text, _ = board.call("fail")
    assert (code, text) == (11, "diagnosis: no such check")
    assert int(values(board.next("errors", lambda s: values(s)["count"] != str(before)))["count"]) > before


def test_levels_and_the_requested_mode(board: Board) -> None:
    """Warning, error with its hysteresis, and a mode that waits until the node can change to it."""
    board.call("set 12000")
    board.next("battery", lambda s: s["level"] == OK)
    board.call("set 11499")
    assert board.next("battery", lambda s: s["level"] == WARN)["message"] == "value below 11500"
    board.call("set 10999")
    error = board.next("battery", lambda s: s["level"] == ERROR)
    assert error["message"] == "value below 11000"
    assert values(error)["mode waits"] == "true", "the node is not configured"
    assert board.call("show")[2] == ["__DEFAULT__ 2"]
    assert board.call("refuse")[0] == 0
    assert board.call("activate")[0] == 0
    board.next("battery", lambda s: values(s)["mode waits"] == "true")
    board.call("accept")
    assert board.next("battery", lambda s: values(s)["mode waits"] == "false")["level"] == ERROR
    assert board.call("show")[2] == ["SLOW 2"]
    statuses = list(read_statuses({"status": [error]}, {"arm/device": DiagnosticLevels()}))
    assert statuses == [PartStatus("arm/device", "battery", "error", "value below 11000")]
    board.call("set 11199")
    assert board.next("battery", lambda s: values(s)["value"] == "11199")["level"] == ERROR
    board.call("set 11200")
    assert board.next("battery", lambda s: s["level"] == WARN)["message"] == "value below 11500"
    board.call("set 11700")
    assert board.next("battery", lambda s: s["level"] == OK)["message"] == "ok"
    assert board.call("show")[2] == ["SLOW 0"]


CELL = """\
cell:
  ros__parameters:
    type: system
    parts: [arm/device]
    modes:
      __DEFAULT__: {arm/device: inactive}
      RUN: {arm/device: active}
"""


@pytest.mark.system
def test_a_mode_manager_leaves_the_requested_mode_alone(
    board: Board, domain: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The check's mode is known from the application file: it is shown, and no rule or request changes it."""
    (tmp_path / "cell.yaml").write_text(CELL, encoding="utf-8")
    (tmp_path / "microros.yaml").write_text(APPLICATION, encoding="utf-8")
    model, _ = read_system(tmp_path / "cell.yaml", [tmp_path / "microros.yaml"])
    assert model.parts["arm/device"].contingencies == ("SLOW",)
    for name, value in environment(domain).items():
        monkeypatch.setenv(name, value)
    lines: list[str] = []
    with Peer(f"manager_{os.getpid()}", domain=domain) as peer:
        manager = ModeManager(peer, model, select_scope(model), lines.append)
        orchestrator = manager.orchestrator

        def until(condition: Callable[[], bool]) -> None:
            end = deadline(60)
            while not condition():
                manager.turn()
                assert time.monotonic() < end, (lines, orchestrator.leaves)

        def actual(part: str) -> str:
            return str(orchestrator.statuses()[part])

        board.call("set 12000")
        until(lambda: actual("arm/device") != "unknown")
        orchestrator.request("cell", active("RUN"))
        until(lambda: actual("cell") == "active.RUN")
        board.call("set 10999")
        until(lambda: actual("cell") == "errorprocessing")
        until(lambda: "arm/device: it went to active.SLOW by itself" in lines)
        begin = time.monotonic()
        until(lambda: time.monotonic() > begin + 4)
        assert board.call("show")[2] == ["SLOW 2"]
        board.call("set 12000")
        until(lambda: actual("arm/device") == "active.SLOW")
        begin = time.monotonic()
        until(lambda: time.monotonic() > begin + 2)
        assert board.call("show")[2] == ["SLOW 0"]
        assert actual("cell") == "activating"
        orchestrator.request("cell", active("RUN"))
        until(lambda: actual("cell") == "active.RUN")
        assert board.call("show")[2] == ["__DEFAULT__ 0"]


@pytest.mark.system
def test_a_lost_session_is_reported_afterwards(
    program: Path, observer: Observer, relay: Relay, domain: int
) -> None:
    observer.subscribe(TOPIC, TYPE)
    options = ("--domain", str(domain))
    with running_agent(domain, *options) as first:
        relay.connect(first.port)
        with started(program) as process:
            board = Board(CommandedProgram(process), observer)
            assert values(board.next("session", lambda s: s["level"] == OK))["reconnects"] == "0"
            board.call("set 11400")
            relay.connect(0)
            first.stop()
            with running_agent(domain, *options) as second:
                relay.connect(second.port)
                lost = board.next("session", lambda s: values(s)["reconnects"] == "1")
                assert (lost["level"], lost["message"]) == (WARN, "reconnects has changed")
                for _ in range(
                    2
                ):  # it is reported again: readers find the new data writer after the first reports
                    assert values(board.next("session", lambda s: s["level"] == WARN))["reconnects"] == "1"
                assert board.next("session", lambda s: s["level"] == OK)
                assert values(board.next("battery"))["value"] == "11400"
                assert process.stdin is not None
                process.stdin.write("end\n")
                ends_well(process)
