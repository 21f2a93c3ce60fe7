# SPDX-License-Identifier: Apache-2.0
"""What counts of the statuses of a part while it is away, and when it is back: in made time."""

from __future__ import annotations

import pytest

from microros_gen.mode_manager.calls import Link
from microros_gen.mode_manager.diagnosis import PartStatus
from microros_gen.mode_manager.problems import Problem, Problems
from microros_gen.mode_manager.reports import REPEAT_S, Reports
from microros_gen.mode_manager.simulation import Played
from microros_gen.modes.model import active
from tests.support.mode_manager.played import CELL_NODES, play
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import model_of

CELL = (
    """\
cell:
  ros__parameters:
    type: system
    parts: [p, q]
    modes:
      __DEFAULT__: {p: active, q: active}
      LIMP: {p: inactive, q: active.SLOW}
    rules:
      broken:
        if_target: active
        if_part: [p, errorprocessing]
        new_target: active.LIMP
        recover_if: [p, inactive, unconfigured]
"""
    + CELL_NODES
)
BROKEN = """\
- {at: 0 s, request: cell, target: active}
- {at: 2 s, diagnose: p, level: error, name: motor}
"""
BACK_S = 20


def played(script: str) -> Played:
    return play(script, CELL)


def reconnected(level: str, after_s: float) -> Played:
    """Let the broken part be away, and report its motor some time after it is back."""
    return played(
        f"{BROKEN}- {{at: 9 s, leave: p}}\n- {{at: {BACK_S} s, repair: p}}\n"
        f"- {{at: {BACK_S * 1000 + round(after_s * 1000)} ms, diagnose: p, level: {level}, name: motor}}\n"
    )


@pytest.mark.parametrize("after_s", [0.02, 1, REPEAT_S - 0.2])
def test_a_part_that_is_back_and_still_broken_does_not_end_its_rule(after_s: float) -> None:
    text = reconnected("error", after_s).text()
    assert text.count("rule broken") == 1, text
    assert "end       cell errorprocessing, target active.LIMP" in text


def test_a_part_that_is_back_and_well_ends_its_rule_at_once() -> None:
    before, _, after = reconnected("ok", 1).text().partition("21 s      diagnose")
    assert "is over" not in before
    assert "cell: rule broken is over: active.__DEFAULT__" in after
    assert "end       cell active.__DEFAULT__" in after


def test_an_error_that_is_not_repeated_ends_after_the_hold_time() -> None:
    play = played(f"{BROKEN}- {{at: 9 s, leave: p}}\n- {{at: {BACK_S} s, repair: p}}\n")
    (over,) = [step for step in play.steps if step.text.startswith("rule broken is over")]
    assert REPEAT_S <= over.time_us / 1e6 - BACK_S < REPEAT_S + 0.5
    assert "end       cell active.__DEFAULT__" in play.text()


def test_one_that_leaves_again_and_again_does_not_change_the_system_again() -> None:
    script = BROKEN + "".join(
        f"- {{at: {at} s, leave: p}}\n- {{at: {at + 3} s, repair: p}}\n"
        f"- {{at: {at + 6} s, diagnose: p, level: error, name: motor}}\n"
        for at in range(9, 100, 10)
    )
    text = played(script).text()
    assert text.count("rule broken") == 1, text


def test_while_it_is_away_a_part_is_unknown_whatever_it_has_reported() -> None:
    world = World(model_of(CELL), {"p": Node(values={"v": 1}), "q": Node(values={"w": 1})})
    problems = Problems(world.manager)
    world.request("cell", active())
    problems.report(PartStatus("p", "motor", "error", "hot"))
    assert world.status("p") == "errorprocessing"
    world.manager.link("p", Link.ABSENT)
    assert world.status("p") == "unknown"
    problems.report(PartStatus("p", "motor", "error", "hot"))
    assert world.status("p") == "errorprocessing", "somebody else says so meanwhile"
    world.manager.link("p", Link.PARAMETERS)
    assert world.status("p") == "errorprocessing"
    world.let(REPEAT_S + 0.2)
    assert world.status("p") != "errorprocessing"
    assert [line for line in world.log if "p: motor: hot" in line] == ["p: p: motor: hot"] * 2


def test_the_error_of_a_source_in_this_process_lasts_as_long_as_the_source_says() -> None:
    class Deadlines:
        found: tuple[Problem, ...] = (Problem("p", "a deadline was missed"),)

        def problems(self) -> tuple[Problem, ...]:
            return self.found

    world = World(model_of(CELL), {"p": Node(values={"v": 1}), "q": Node(values={"w": 1})})
    world.let(1)
    source = Deadlines()
    problems = Problems(world.manager, [source])
    problems.step()
    world.manager.link("p", Link.ABSENT)
    assert world.status("p") == "errorprocessing"
    source.found = ()
    problems.step()
    assert world.status("p") == "unknown"


def test_only_what_was_repeated_counts_after_the_hold_time() -> None:
    reports = Reports()
    reports.arrive(0)
    for name in ("motor", "heat"):
        reports.hear(name, "error", f"{name} failed")
    reports.leave()
    assert (reports.error, reports.levels) == ("", {"motor": "error", "heat": "error"})
    reports.arrive(100)
    assert (reports.error, reports.confirmed_error) == ("motor failed", "")
    reports.hear("heat", "error", "heat failed")
    reports.step(100 + REPEAT_S - 0.01)
    assert (reports.error, reports.confirmed_error) == ("motor failed", "heat failed")
    reports.step(100 + REPEAT_S)
    assert (reports.error, reports.levels) == ("heat failed", {"heat": "error"})


def test_a_part_that_leaves_in_the_hold_time_begins_it_again() -> None:
    reports = Reports()
    reports.arrive(0)
    reports.hear("motor", "error", "failed")
    reports.leave()
    reports.arrive(10)
    reports.leave()
    reports.step(10 + REPEAT_S)
    assert reports.error == ""
    reports.arrive(20)
    reports.step(20 + REPEAT_S - 0.01)
    assert reports.error == "failed"
    reports.step(20 + REPEAT_S)
    assert (reports.error, reports.levels) == ("", {})
