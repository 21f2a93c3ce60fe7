# SPDX-License-Identifier: Apache-2.0
"""Rules that apply at a level of a status on /diagnostics, while their node goes on: `diagnostics` of a rule."""

from __future__ import annotations

import re
from contextlib import ExitStack
from pathlib import Path

import pytest

from microros_gen.components import diagnosis
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.shipped import COMPONENTS
from microros_gen.mode_manager.diagnosis import PartStatus, array_of, read_rows, rows_of
from microros_gen.mode_manager.monitor import Overview
from microros_gen.mode_manager.problems import Problems
from microros_gen.mode_manager.reports import Reports
from microros_gen.mode_manager.simulation import Played, simulate
from microros_gen.modes import Report, check
from microros_gen.modes.model import active
from microros_gen.modes.published import LIBRARY_STATUSES
from microros_gen.modes.script import parse_script
from tests.support.mode_manager.arm import start_diagnosed
from tests.support.mode_manager.world import Node, World
from tests.support.modes.models import changed, model_of, model_text

PLACE = "      # in __DEFAULT__ nothing is left to degrade to\n"
HOT = """\
      hot_motor:
        if_target: active.QUICK
        if_part: [gripper, active.FIRM]
        diagnostics: {level: warn, names: [motor*]}
        new_target: active.GENTLE
        recover_if: [gripper, active.SOFT]
"""
ARM = changed(model_text("arm"), PLACE, HOT)
REQUEST = "- {at: 0 s, request: arm, target: active.QUICK}\n"


def played(text: str, script: str) -> Played:
    model = model_of(text)
    found = Diagnostics()
    events = parse_script(Source("s.yaml", script), model, found)
    assert not found.has_errors(), [d.render() for d in found]
    return simulate(model, events)


def targets(play: Played) -> dict[str, str]:
    return {end.part: str(end.target) for end in play.ends}


def test_a_warning_degrades_the_system_while_its_node_goes_on_and_ends_with_it() -> None:
    script = f"""\
{REQUEST}- {{at: 2 s, diagnose: gripper, level: warn, name: motor left}}
- {{at: 9 s, diagnose: gripper, level: ok, name: motor left}}
"""
    lines = [line.split(None, 2) for line in played(ARM, script).text().splitlines()]
    text = played(ARM, script).text()
    rule = "arm: rule hot_motor: active.GENTLE (gripper: motor left: warn)"
    assert text.index("status arm active.QUICK") < text.index(rule) < text.index("status arm active.GENTLE")
    assert text.index("9 s       diagnose") < text.index("arm: rule hot_motor is over: active.QUICK")
    assert text.count("rule hot_motor: ") == 1
    assert "errorprocessing" not in text
    assert lines[-3][1:] == ["arm", "active.QUICK"]


@pytest.mark.parametrize(
    ("status", "target"),
    [
        ("level: warn, name: motor", "active.GENTLE"),
        ("level: warn, name: motor left", "active.GENTLE"),
        ("level: stale, name: motor", "active.QUICK"),
        ("level: warn, name: heat", "active.QUICK"),
        ("level: warn", "active.QUICK"),
        ("level: ok, name: motor", "active.QUICK"),
        ("level: error, name: motor", "active.QUICK"),
    ],
)
def test_only_the_level_and_the_names_of_the_rule_count(status: str, target: str) -> None:
    """An error puts the node into error processing, for which this rule is not."""
    script = f"{REQUEST}- {{at: 2 s, diagnose: gripper, {status}}}\n"
    assert targets(played(ARM, script))["arm"] == target


def test_two_errors_of_one_node_have_rules_of_their_own() -> None:
    rules = """\
      broken_motor:
        if_target: active.QUICK
        if_part: [gripper, errorprocessing]
        diagnostics: {level: error, names: [motor]}
        new_target: inactive
      dirty_lens:
        if_target: active.QUICK
        if_part: [gripper, errorprocessing]
        diagnostics: {level: [warn, stale], names: [lens]}
        new_target: active.__DEFAULT__
"""
    text = changed(model_text("arm"), PLACE, rules)
    for name, target in (("motor", "inactive"), ("lens", "active.__DEFAULT__"), ("heat", "active.QUICK")):
        script = f"{REQUEST}- {{at: 2 s, diagnose: gripper, level: error, name: {name}}}\n"
        assert targets(played(text, script))["arm"] == target


def test_a_rule_waits_for_parts_on_their_way_and_is_not_applied_again_by_itself() -> None:
    """The warning is there before the request; a second request leads there again."""
    script = """\
- {at: 0 s, diagnose: gripper, level: warn, name: motor}
- {at: 1 s, delay: joint, time: 2 s}
- {at: 2 s, request: arm, target: active.QUICK}
- {at: 60 s, request: arm, target: active.QUICK}
"""
    text = played(ARM, script).text()
    assert text.index("status joint active.RUSH") < text.index("rule hot_motor: active.GENTLE")
    assert text.count("rule hot_motor: active.GENTLE") == 2
    assert "end       arm active.GENTLE" in text


def test_a_node_that_was_away_and_still_has_the_warning_stays_degraded() -> None:
    """It repeats the status after it got its target: the rule is not over in between."""
    script = f"""\
{REQUEST}- {{at: 2 s, diagnose: gripper, level: warn, name: motor}}
- {{at: 9 s, leave: gripper}}
- {{at: 20 s, repair: gripper}}
- {{at: 23 s, diagnose: gripper, level: warn, name: motor}}
"""
    text = played(ARM, script).text()
    assert text.count("rule hot_motor") == 1
    assert "end       arm active.GENTLE" in text
    ok = changed(script, "23 s, diagnose: gripper, level: warn", "23 s, diagnose: gripper, level: ok")
    assert "rule hot_motor is over" in played(ARM, ok).text().partition("23 s")[2]


def test_a_status_that_a_node_does_not_repeat_after_it_was_away_is_forgotten() -> None:
    script = f"""\
{REQUEST}- {{at: 2 s, diagnose: gripper, level: warn, name: motor}}
- {{at: 9 s, leave: gripper}}
- {{at: 20 s, repair: gripper}}
"""
    assert targets(played(ARM, script))["arm"] == "active.QUICK"


def test_a_warning_that_appears_and_ends_is_not_followed_for_ever() -> None:
    script = REQUEST + "".join(
        f"- {{at: {2 + 4 * i} s, diagnose: gripper, level: {level}, name: motor}}\n"
        for i, level in enumerate(("warn", "ok") * 5)
    )
    text = played(ARM, script).text()
    assert text.count("rule hot_motor is over") == 3
    assert "arm: it recovered again and again, and stays so until the next request" in text
    assert "end       arm active.GENTLE" in text


def checked(folder: Path, text: str, application: str = "") -> Report:
    (folder / "arm.yaml").write_text(text, encoding="utf-8")
    (folder / "microros.yaml").write_text(application, encoding="utf-8")
    return check(folder / "arm.yaml", [folder / "microros.yaml"] if application else [])


def test_rules_with_diagnostics_are_proven(tmp_path: Path) -> None:
    report = checked(tmp_path, ARM)
    assert report.exit_status == 0, [d.render() for d in report.diagnostics]
    assert any("rules: 4, with diagnostics: 1; " in p.detail for p in report.properties)


def test_two_rules_that_send_each_other_back_are_refuted_with_the_status(tmp_path: Path) -> None:
    back = """\
      hot_slow:
        if_target: active.GENTLE
        if_part: [gripper, active.SOFT]
        diagnostics: {level: [warn, stale], names: [motor left]}
        new_target: active.QUICK
"""
    report = checked(tmp_path, changed(ARM, HOT, HOT + back))
    found = [d for d in report.diagnostics if d.id == "MG-8844"]
    assert [d.block[0] for d in found] == ["  diagnosed gripper motor left warn"]
    assert any("oscillates: " in line for line in found[0].block)
    assert report.exit_status == 2
    harmless = changed(back, "[warn, stale]", "stale")
    assert checked(tmp_path, changed(ARM, HOT, HOT + harmless)).exit_status == 2, (
        "warn of one, stale of another"
    )
    harmless = changed(harmless, "[gripper, active.SOFT]", "[gripper, inactive]")
    assert checked(tmp_path, changed(ARM, HOT, HOT + harmless)).exit_status == 0


def test_a_mode_that_only_diagnostics_lead_to_is_reached(tmp_path: Path) -> None:
    top = "top: {ros__parameters: {type: system, parts: [arm], modes: {__DEFAULT__: {arm: active.QUICK}}}}\n"
    report = checked(tmp_path, f"{ARM}{top}")
    assert not [d for d in report.diagnostics if "'GENTLE'" in d.message]
    without = checked(tmp_path, f"{model_text('arm')}{top}")
    assert [d.id for d in without.diagnostics if "'GENTLE' of 'arm'" in d.message] == ["MG-8843"]


DEVICE = """\
version: 1
profiles: [managed_service]
components: [+diagnosis]
diagnosis:
  checks: [{name: motor_left, above: {warn: 60}}]
nodes:
  - name: gripper
    parameters: [{name: force, type: double, default: 0.5}]
    modes: {SOFT: {force: 0.5}, FIRM: {force: 2.0}}
"""
NODE = "gripper:\n  ros__parameters:\n"


def of_device(text: str) -> str:
    """Return the model without the modes of the gripper, which its application file has."""
    return re.sub(rf"{NODE}(    .*\n)+", "", text)


@pytest.mark.parametrize(
    ("names", "device", "identities"),
    [
        ("[motor*]", DEVICE, []),
        ("[motor_left, session]", DEVICE, []),
        ("[motor_leff]", DEVICE, ["MG-9832"]),
        ("[lens*, heat]", DEVICE, ["MG-9832", "MG-9832"]),
        ("[lens*, heat]", DEVICE.replace("[+diagnosis]", "[+diagnosis, +of_ours]"), []),
        ("[heat]", re.sub(r"diagnosis:\n.*\n", "", DEVICE), []),
    ],
)
def test_names_that_the_application_file_does_not_have(
    names: str, device: str, identities: list[str], tmp_path: Path
) -> None:
    report = checked(tmp_path, of_device(changed(ARM, "[motor*]", names)), device)
    assert [d.id for d in report.diagnostics] == identities, [d.render() for d in report.diagnostics]
    for d in report.diagnostics:
        assert d.span is not None
        assert d.span.source.line(d.span.line)[d.span.column - 1 :].startswith(d.message.split("'")[1])
        assert d.hint


def test_names_of_a_node_are_checked_as_well(tmp_path: Path) -> None:
    node = "gripper: {ros__parameters: {type: node, diagnostics: {level: warn, names: [motor_leff]}}}\n"
    report = checked(tmp_path, of_device(model_text("arm")) + node, DEVICE)
    assert [d.headline().partition(": error: ")[2] for d in report.diagnostics] == [
        "nothing publishes the status 'motor_leff' of 'gripper'. Did you mean 'motor_left'? [MG-9832]"
    ]


def test_the_statuses_of_the_library_are_known() -> None:
    """Groups of counters of all components, and those that the diagnosis itself has."""
    groups = {
        group
        for path in COMPONENTS.glob("*/component.yaml")
        for group in re.findall(r"\{group: (\w+),", path.read_text(encoding="utf-8"))
    }
    plan = (Path(next(iter(diagnosis.__path__))) / "plan.py").read_text(encoding="utf-8")
    groups |= set(re.findall(r'CounterRow\(\s*"(\w+)"', plan)) | set(re.findall(r'_measure\("(\w+)"', plan))
    assert groups == set(LIBRARY_STATUSES)


def test_the_diagnosis_of_the_manager_and_the_monitor_say_why() -> None:
    world = World(model_of(ARM), {"gripper": Node(), "joint": Node()})
    world.request("arm", active("QUICK"))
    Problems(world.manager).report(PartStatus("gripper", "motor", "warn", ""))
    world.let(2)
    overview = Overview(model_of(ARM), lambda: 0.0)
    overview.hear(array_of(rows_of(world.manager)))
    arm = next(iter(read_rows(array_of(rows_of(world.manager)))))
    assert (arm.part, arm.rule, arm.cause, arm.level) == ("arm", "hot_motor", "gripper: motor: warn", 0)
    assert "rule hot_motor (gripper: motor: warn)" in overview.table()
    assert overview.data()["parts"][0]["diagnostics"] == "gripper: motor: warn"
    Problems(world.manager).report(PartStatus("gripper", "motor", "", ""))
    world.let(2)
    assert [(row.rule, row.cause) for row in rows_of(world.manager)] == [("", "")] * 3


@pytest.mark.ros
@pytest.mark.system
def test_a_warning_on_diagnostics_applies_the_rule_and_its_end_undoes_it(
    stack: ExitStack, domain: int, tmp_path: Path
) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM, encoding="utf-8")
    asking, managing, publisher = start_diagnosed(stack, domain, path)
    publisher.publish({"status": [{"name": "gripper: motor left", "level": 1, "message": "warm"}]})
    managing.wait_for("arm: rule hot_motor: active.GENTLE (gripper: motor left: warn)")
    asking.until_row("arm", "active.GENTLE")
    assert (asking.rows["arm"].rule, asking.rows["arm"].cause) == ("hot_motor", "gripper: motor left: warn")
    publisher.publish({"status": [{"name": "gripper: motor left", "level": 0, "message": ""}]})
    managing.wait_for("arm: rule hot_motor is over: active.QUICK")
    asking.until_row("arm", "active.QUICK")


def test_statuses_that_are_always_fine_take_no_memory() -> None:
    reports = Reports()
    for number in range(100):
        reports.hear(f"status {number}", "")
    assert reports.levels == {}
    reports.hear("motor", "warn")
    reports.hear("motor", "")
    assert reports.levels == {"motor": ""}
