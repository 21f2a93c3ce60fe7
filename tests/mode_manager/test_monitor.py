# SPDX-License-Identifier: Apache-2.0
"""What the monitor shows: the table, the data, and the page in a browser."""

from __future__ import annotations

import http.client
import json
import re
import shutil
import subprocess
import urllib.request
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.mode_manager.calls import Link
from microros_gen.mode_manager.diagnosis import PartStatus, array_of, read_rows, read_statuses, rows_of
from microros_gen.mode_manager.monitor import OLD_S, UNMANAGED, Overview
from microros_gen.mode_manager.page import served_page
from microros_gen.mode_manager.problems import Problem, Problems
from microros_gen.modes.model import DiagnosticLevels, active
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import changed, model_of, model_text
from tests.support.patience import seconds

ARM = model_text("arm")
ROBOT = model_text("robot")


def activates(call: Any) -> bool:
    return bool(call.transition == 3)


def degraded() -> World:
    world = World(model_of(ARM), {"gripper": Node(refuses=activates), "joint": Node()})
    world.request("arm", active("QUICK"), 6)
    return world


def test_the_table_shows_target_actual_and_reason() -> None:
    world = degraded()
    overview = Overview(world.model, lambda: 0.0)
    overview.hear(array_of(rows_of(world.manager)))
    assert (
        overview.table()
        == """\
part       target              actual              level  message
arm        active.__DEFAULT__  active.__DEFAULT__  ok     rule without_gripper_quick
  gripper  inactive            inactive            ok
  joint    active.__DEFAULT__  active.__DEFAULT__  ok
"""
    )
    assert overview.is_at_rest


def test_a_failed_part_and_one_on_its_way() -> None:
    world = World(
        model_of(ARM), {"gripper": Node(delay_s=1.0), "joint": Node(refuses=lambda c: c.mode != "")}
    )
    world.manager.link("joint", Link.ABSENT)
    world.manager.link("joint", Link.MODES)
    world.request("arm", active("QUICK"), 2.5)
    rows = {row.part: row for row in rows_of(world.manager)}
    assert (rows["arm"].level, rows["arm"].message) == (1, "it is on its way")
    assert (rows["gripper"].level, rows["gripper"].target) == (1, "active.FIRM")
    assert rows["joint"].retries > 0
    world.let(5)
    rows = {row.part: row for row in rows_of(world.manager)}
    assert (rows["joint"].level, rows["joint"].message) == (2, "it refuses change_mode RUSH")
    assert (rows["arm"].level, rows["arm"].message) == (2, "it is not in its target")


def test_a_part_that_waits_for_a_failed_one() -> None:
    model = model_of(changed(ROBOT, "if_target: active.FAST", "if_target: active"))
    nodes = {node.name: Node() for node in model.nodes}
    nodes["camera"].refuses = activates
    world = World(model, nodes)
    world.request("robot", active("FAST"), 8)
    rows = {row.part: row for row in rows_of(world.manager)}
    assert rows["wheels/left"].message == "it waits for camera"


def test_rows_survive_the_message() -> None:
    rows = rows_of(degraded().manager)
    assert tuple(read_rows(array_of(rows))) == rows


def test_a_silent_manager_does_not_count() -> None:
    now = [0.0]
    world = degraded()
    overview = Overview(world.model, lambda: now[0])
    overview.hear(array_of(rows_of(world.manager)))
    now[0] = OLD_S + 0.1
    assert {row.message for row in overview.rows()} == {UNMANAGED}
    assert not overview.is_at_rest


def test_the_manager_of_a_subsystem_counts_more_than_the_one_above() -> None:
    model = model_of(ROBOT)
    upper = World(model, {"camera": Node(), "base": Node(Link.SYSTEM, "inactive")}, without=("base",))
    lower = World(model, {n: Node() for n in ("wheels/left", "wheels/right")}, roots=("base",))
    lower.request("base", active("DRIVE"))
    upper.run(1)
    overview = Overview(model, lambda: 0.0)
    for _ in range(2):
        overview.hear(array_of(rows_of(lower.manager)))
        overview.hear(array_of(rows_of(upper.manager)))
    actual = {row.part: row.actual for row in overview.rows()}
    assert actual["base"] == "active.DRIVE"
    assert list(actual) == ["robot", "base", "wheels/left", "wheels/right", "camera"]


def status(name: str, level: int, message: str = "hot", hardware: str = "") -> dict[str, Any]:
    return {"name": name, "level": level, "message": message, "hardware_id": hardware, "values": []}


def test_errors_of_others_belong_to_parts() -> None:
    message = {
        "status": [
            status("/left/arm: motor", 2),
            status("left/arm", 1),
            status("left/army", 2),
            status("arm", 0),
            status("arm: modes", 2, "", "mode manager"),
            status("arm: cpu", 2, ""),
        ]
    }
    assert list(read_statuses(message, {"left/arm": DiagnosticLevels(), "arm": DiagnosticLevels()})) == [
        PartStatus("left/arm", "motor", "error", "hot"),
        PartStatus("left/arm", "", "warn", ""),
        PartStatus("arm", "", "", ""),
        PartStatus("arm", "cpu", "error", "error"),
    ]


class Deadlines:
    """A source of this process, as a component that measures deadlines has it."""

    def __init__(self) -> None:
        self.missed = False

    def problems(self) -> list[Problem]:
        return [Problem("gripper", "a deadline of 10 ms was missed")] if self.missed else []


def test_sources_of_problems_are_joined() -> None:
    world = World(model_of(ARM), {"gripper": Node(), "joint": Node()})
    deadlines = Deadlines()
    problems = Problems(world.manager, [deadlines])
    deadlines.missed = True
    problems.step()
    world.let(1)
    rows = {row.part: row for row in rows_of(world.manager)}
    assert (rows["gripper"].message, rows["gripper"].actual) == (
        "a deadline of 10 ms was missed",
        "errorprocessing",
    )
    assert rows["arm"].actual == "errorprocessing"
    problems.report(PartStatus("gripper", "motor", "error", "hot"))
    deadlines.missed = False
    problems.step()
    assert world.manager.leaves["gripper"].problem == "gripper: motor: hot"
    problems.report(PartStatus("gripper", "motor", "", ""))
    problems.step()
    assert world.manager.leaves["gripper"].problem == ""


@pytest.mark.parametrize("place", ["0.0.0.0:80", "8080", "192.0.2.1:80", "localhost:x", "127.0.0.1:70000"])
def test_the_page_is_for_this_machine_alone(place: str) -> None:
    with pytest.raises(UserError) as raised, served_page(place, dict):
        pass
    assert [d.id for d in raised.value.diagnostics] == ["MG-8875"]


def test_a_port_that_is_in_use() -> None:
    with served_page("127.0.0.1:0", dict) as address:
        place = address.removeprefix("http://").rstrip("/")
        with pytest.raises(UserError) as raised, served_page(place, dict):
            pass
    assert [d.id for d in raised.value.diagnostics] == ["MG-8876"]


def test_what_the_server_of_the_page_answers() -> None:
    overview = Overview(model_of(ARM), lambda: 0.0)
    with served_page("127.0.0.1:0", overview.data) as address:
        with urllib.request.urlopen(f"{address}state.json") as response:
            assert json.load(response) == overview.data()
        port = int(address.rstrip("/").rpartition(":")[2])
        for path, host, code in (("/x", "localhost:1", 404), ("/", "example.org:80", 403), ("/", "", 403)):
            connection = http.client.HTTPConnection("127.0.0.1", port)
            connection.request("GET", path, headers={"Host": host})
            assert connection.getresponse().status == code
            connection.close()


@pytest.mark.lint
def test_the_page_in_a_browser(tmp_path: Path) -> None:
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("no chromium: apt-get install chromium")
    world = degraded()
    overview = Overview(world.model, lambda: 0.0)
    arm, *nodes = rows_of(world.manager)
    overview.hear(array_of([replace(arm, cause="gripper: motor: warn"), *nodes]))
    with served_page("127.0.0.1:0", overview.data) as address:
        run = subprocess.run(
            [
                *(chromium, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"),
                *(f"--user-data-dir={tmp_path}", "--virtual-time-budget=5000", "--dump-dom", address),
            ],
            capture_output=True,
            text=True,
            timeout=seconds(60),
            check=True,
        )
    rows = re.findall(r'<tr class="(\w+)" id="part-([\w/]+)">(.*?)</tr>', run.stdout)
    shown = {part: re.findall(r"<td[^>]*>(.*?)</td>", cells) for _, part, cells in rows}
    assert shown == {
        "arm": [
            "arm",
            *["active.__DEFAULT__"] * 2,
            "ok",
            " (rule without_gripper_quick: gripper: motor: warn)",
        ],
        "gripper": ["gripper", "inactive", "inactive", "ok", ""],
        "joint": ["joint", "active.__DEFAULT__", "active.__DEFAULT__", "ok", ""],
    }
    assert ">Live<" in run.stdout
