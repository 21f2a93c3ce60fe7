# SPDX-License-Identifier: Apache-2.0
"""Rules on statuses of /diagnostics that belong to no part: `hardware` below `diagnostics` of a rule."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path

import pytest

from microros_gen.mode_manager.diagnosis import OtherStatus, array_of, read_others, read_rows, rows_of
from microros_gen.mode_manager.monitor import Overview
from microros_gen.mode_manager.outside import MOST, Outside
from microros_gen.mode_manager.reports import REPEAT_S
from microros_gen.mode_manager.settings import Settings
from microros_gen.mode_manager.simulation import Played
from microros_gen.modes import Report, check
from microros_gen.modes.model import active
from tests.support.mode_manager.arm import start_diagnosed
from tests.support.mode_manager.played import play
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import changed, model_of, model_text

PLACE = "      # in __DEFAULT__ nothing is left to degrade to\n"
LINK = """\
      weak_link:
        if_target: active.QUICK
        if_part: [gripper, active.FIRM]
        diagnostics: {level: [warn, stale], hardware: "*", names: ["agent: client 0A0B*"]}
        new_target: active.GENTLE
        recover_if: [gripper, active.SOFT]
"""
ARM = changed(model_text("arm"), PLACE, LINK)
REQUEST = "- {at: 0 s, request: arm, target: active.QUICK}\n"
CLIENT = "agent: client 0A0B0C0D"


def played(script: str, text: str = ARM) -> Played:
    return play(script, text)


def warned(level: str, name: str, hardware: str = "0A0B0C0D", at: int = 2) -> str:
    return f"- {{at: {at} s, hardware: '{hardware}', level: {level}, name: '{name}'}}\n"


def test_a_status_of_no_part_degrades_the_system_and_its_end_undoes_it() -> None:
    text = played(REQUEST + warned("warn", CLIENT) + warned("ok", CLIENT, at=30)).text()
    rule = f"arm: rule weak_link: active.GENTLE ({CLIENT}: warn)"
    assert f"2 s       hardware 0A0B0C0D {CLIENT} warn" in text
    assert text.index("status arm active.QUICK") < text.index(rule) < text.index("status arm active.GENTLE")
    assert text.index("30 s      hardware") < text.index("arm: rule weak_link is over: active.QUICK")
    assert text.count("rule weak_link: ") == 1
    assert "end       arm active.QUICK" in text


@pytest.mark.parametrize(
    ("script", "target"),
    [
        (warned("stale", CLIENT), "active.GENTLE"),
        (warned("error", CLIENT), "active.GENTLE"),
        (warned("warn", CLIENT, "anything"), "active.GENTLE"),
        (warned("warn", "agent: client 01020304"), "active.QUICK"),
        (warned("warn", "0A0B"), "active.QUICK"),
        ("- {at: 2 s, diagnose: gripper, level: warn, name: 'agent: client 0A0B'}\n", "active.QUICK"),
    ],
)
def test_only_the_level_and_the_whole_name_count(script: str, target: str) -> None:
    ends = {end.part: str(end.target) for end in played(REQUEST + script).ends}
    assert ends["arm"] == target


def test_statuses_with_one_name_differ_by_their_hardware() -> None:
    text = changed(ARM, 'hardware: "*"', "hardware: battery*")
    for hardware, target in (("battery 2", "active.GENTLE"), ("charger", "active.QUICK")):
        ends = {e.part: str(e.target) for e in played(REQUEST + warned("warn", CLIENT, hardware), text).ends}
        assert ends["arm"] == target


def test_one_that_is_not_repeated_is_stale() -> None:
    """The agent that published it was killed: nothing else says so."""
    world = World(model_of(ARM), {"gripper": Node(), "joint": Node()})
    world.request("arm", active("QUICK"))
    for _ in range(4):
        world.manager.diagnosed.hear_outside("0A0B0C0D", CLIENT, "")
        world.let(REPEAT_S - 1)
    assert world.status("arm") == "active.QUICK"
    world.let(3)
    assert (world.status("arm"), world.manager.cause("arm")) == ("active.GENTLE", f"{CLIENT}: stale")
    world.manager.diagnosed.hear_outside("0A0B0C0D", CLIENT, "")
    world.let(2)
    assert world.status("arm") == "active.QUICK"


def test_a_slow_publisher_is_not_stale_with_a_longer_time() -> None:
    for repeat_s, target in ((20.0, "active.QUICK"), (REPEAT_S, "active.GENTLE")):
        world = World(
            model_of(ARM), {"gripper": Node(), "joint": Node()}, settings=Settings(repeat_s=repeat_s)
        )
        world.request("arm", active("QUICK"))
        for _ in range(2):
            world.manager.diagnosed.hear_outside("0A0B0C0D", CLIENT, "")
            world.let(12)
        assert world.status("arm") == target


IN_TURN = changed(
    model_text("arm"),
    PLACE,
    """\
      gently:
        if_target: active.QUICK
        if_part: [gripper, active.FIRM]
        diagnostics: {level: warn, hardware: battery, names: [low]}
        new_target: active.GENTLE
      quickly:
        if_target: active.GENTLE
        if_part: [gripper, active.SOFT]
        diagnostics: {level: warn, hardware: battery, names: [full]}
        new_target: active.QUICK
""",
)


@pytest.mark.parametrize(("rest_s", "oscillates"), [(100, False), (5, True)])
def test_only_rules_without_a_rest_in_between_are_an_oscillation(rest_s: int, oscillates: bool) -> None:
    """A battery that is charged once a day is none."""
    world = World(model_of(IN_TURN), {"gripper": Node(), "joint": Node()})
    world.request("arm", active("QUICK"))
    for i in range(24):
        for name in ("low", "full"):
            level = "warn" if (name == "low") == (i % 2 == 0) else ""
            world.manager.diagnosed.hear_outside("battery", name, level)
        world.let(rest_s)
    assert world.manager.oscillating == ({"arm"} if oscillates else set())
    if not oscillates:
        assert world.log.count("arm: rule gently: active.GENTLE (low: warn)") == 12


def test_what_no_rule_wants_is_not_kept_and_the_rest_is_bounded() -> None:
    rules = [rule for part in model_of(ARM).parts.values() for rule in part.rules]
    levels: dict[str, dict[str, str]] = {}
    kept = Outside(rules, levels)
    kept.hear("x", "battery", "error", 0)
    assert levels == {}
    for number in range(MOST + 10):
        kept.hear(f"{number}", f"agent: client 0A0B{number}", "warn", number)
    assert len(levels) == MOST
    assert "hardware 9" not in levels
    assert levels["hardware 10"] == {"agent: client 0A0B10": "warn"}
    kept.step(MOST + 10)
    assert sum(list(own.values()) != ["stale"] for own in levels.values()) == REPEAT_S - 1


def test_statuses_of_parts_and_of_managers_are_not_among_them() -> None:
    names = {
        "/gripper: motor": "g",
        "gripper": "g",
        "arm: x": "a",
        "modes: arm": "mode manager",
        CLIENT: "0A0B0C0D",
    }
    message = {"status": [{"name": n, "hardware_id": h, "level": 2, "message": ""} for n, h in names.items()]}
    assert list(read_others(message, model_of(ARM).parts)) == [OtherStatus("0A0B0C0D", CLIENT, "error")]


def test_the_diagnosis_of_the_manager_and_the_monitor_say_why() -> None:
    world = World(model_of(ARM), {"gripper": Node(), "joint": Node()})
    world.request("arm", active("QUICK"))
    world.manager.diagnosed.hear_outside("0A0B0C0D", CLIENT, "warn")
    world.let(2)
    overview = Overview(model_of(ARM), lambda: 0.0)
    overview.hear(array_of(rows_of(world.manager)))
    arm = next(iter(read_rows(array_of(rows_of(world.manager)))))
    assert (arm.part, arm.rule, arm.cause) == ("arm", "weak_link", f"{CLIENT}: warn")
    assert f"rule weak_link ({CLIENT}: warn)" in overview.table()


def test_the_rules_are_proven_or_refuted_with_the_status(tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM, encoding="utf-8")
    report = check(path)
    assert report.exit_status == 0, [d.render() for d in report.diagnostics]
    assert any("rules: 4, with diagnostics: 1; " in p.detail for p in report.properties)
    back = """\
      weak_slow:
        if_target: active.GENTLE
        if_part: [gripper, active.SOFT]
        diagnostics: {level: warn, hardware: 0A0B0C0D, names: ["agent: client 0A0B0C0D"]}
        new_target: active.QUICK
"""
    path.write_text(changed(ARM, LINK, LINK + back), encoding="utf-8")
    report = check(path)
    (found,) = [d for d in report.diagnostics if d.id == "MG-8844"]
    assert found.block[0] == f"  diagnosed hardware 0A0B0C0D {CLIENT} warn"
    assert any("oscillates: " in line for line in found.block)
    assert report.exit_status == 2


TWO = """\
top:
  ros__parameters:
    type: system
    parts: [low, lamp]
    modes:
      __DEFAULT__: {low: active.A, lamp: inactive}
      LIT: {low: active.A, lamp: active}
    rules:
      on: {if_target: active, if_part: [low, active.A], new_target: active.LIT, diagnostics: {level: warn, hardware: b}}
      off:
        if_target: active.LIT
        if_part: [low, active.A]
        new_target: active
        diagnostics: {level: warn, hardware: b}
low:
  ros__parameters:
    type: system
    parts: [motor]
    modes:
      __DEFAULT__: {motor: inactive}
      A: {motor: active.A}
      B: {motor: active.B}
    rules:
      weak:
        if_target: active.A
        if_part: [motor, active.A]
        new_target: active.B
        diagnostics: {level: warn, hardware: b}
lamp: {ros__parameters: {type: node, modes: {__DEFAULT__: {ros__parameters: {v: 1}}}}}
motor:
  ros__parameters:
    type: node
    modes:
      __DEFAULT__: {ros__parameters: {w: 1}}
      A: {ros__parameters: {w: 2}}
      B: {ros__parameters: {w: 3}}
"""


def checked(tmp_path: Path, text: str) -> Report:
    path = tmp_path / "two.yaml"
    path.write_text(text, encoding="utf-8")
    return check(path)


def test_a_cycle_that_needs_two_levels_of_one_status_is_not_found(tmp_path: Path) -> None:
    """While the status warns, the lower system is not in A: the two rules above never follow each other."""
    report = checked(tmp_path, TWO)
    assert ([d.render() for d in report.diagnostics], report.result) == ([], "proven")
    elsewhere = changed(
        TWO,
        "        new_target: active.B\n        diagnostics: {level: warn, hardware: b}",
        "        new_target: active.B\n        diagnostics: {level: warn, hardware: c}",
    )
    report = checked(tmp_path, elsewhere)
    assert [d.id for d in report.diagnostics] == ["MG-8844"]
    assert "diagnosed hardware b * warn" in report.diagnostics[0].block[0]


def more_rules(name: str, target: str, part: str) -> str:
    """Return eleven rules, each on its own hardware."""
    return "".join(
        f"      {name}_{i}: {{if_target: {target}, if_part: [{part}], new_target: inactive,"
        f" diagnostics: {{level: warn, hardware: c{i}}}}}\n"
        for i in range(11)
    )


@pytest.mark.parametrize("kind", ["outside", "node"])
def test_the_limit_bounds_the_levels_of_statuses(tmp_path: Path, kind: str) -> None:
    """Forty statuses have more combinations than there is memory; what was not covered is not proven."""
    rules = "".join(
        f"      r{i}: {{if_target: active.A, if_part: [motor, active.A], new_target: active.B,"
        f" diagnostics: {{level: warn, {f'hardware: c{i}' if kind == 'outside' else f'names: [c{i}]'}}}}}\n"
        for i in range(40)
    )
    path = tmp_path / "many.yaml"
    path.write_text(changed(TWO, "      weak:\n", rules + "      weak:\n"), encoding="utf-8")
    report = check(path, most=1000)
    assert [d.message.partition(":")[0] for d in report.diagnostics if d.id == "MG-8845"] == [
        "not proven for 'low'",
        "not proven for 'top'",
    ]
    assert report.exit_status == 1


LOWER = changed(TWO, "      weak:\n", more_rules("also", "active.B", "motor, active.B") + "      weak:\n")
"""The lower system has rules with 2048 combinations of levels."""


def test_levels_of_what_one_system_sees_leave_nothing_open(tmp_path: Path) -> None:
    report = checked(tmp_path, LOWER)
    assert ([d.render() for d in report.diagnostics], report.result) == ([], "proven")
    rule = "        new_target: active.B\n        diagnostics: {level: warn, hardware: b}"
    report = checked(tmp_path, changed(LOWER, rule, rule.replace("hardware: b", "hardware: c3")))
    assert [d.id for d in report.diagnostics] == ["MG-8844"]


@pytest.mark.system
def test_too_many_levels_of_what_both_see_leave_such_a_cycle_open(tmp_path: Path) -> None:
    upper = more_rules("too", "active.LIT", "lamp, inactive")
    report = checked(tmp_path, changed(LOWER, "      on: {", upper + "      on: {"))
    assert [d.id for d in report.diagnostics] == ["MG-9838"], [d.render() for d in report.diagnostics]
    assert "not proven for 'top'" in report.diagnostics[0].message
    assert (report.exit_status, report.diagnostics[0].hint) == (
        1,
        "Let only one system have rules with 'hardware'",
    )


@pytest.mark.ros
@pytest.mark.system
def test_a_status_of_no_part_on_diagnostics_applies_the_rule(
    stack: ExitStack, domain: int, tmp_path: Path
) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM, encoding="utf-8")
    asking, managing, publisher = start_diagnosed(stack, domain, path)
    status = {"name": CLIENT, "hardware_id": "0A0B0C0D", "message": "silent"}
    publisher.publish({"status": [{**status, "level": 1}]})
    managing.wait_for(f"arm: rule weak_link: active.GENTLE ({CLIENT}: warn)")
    asking.until_row("arm", "active.GENTLE")
    publisher.publish({"status": [{**status, "level": 0}]})
    managing.wait_for("arm: rule weak_link is over: active.QUICK")
    managing.wait_for(f"arm: rule weak_link: active.GENTLE ({CLIENT}: stale)")
