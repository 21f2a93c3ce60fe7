# SPDX-License-Identifier: Apache-2.0
"""Properties of models are proven, refuted with a counterexample, or said to be open."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from microros_gen.mode_manager.simulation import simulate
from microros_gen.modes import Event, Report, Status, check
from microros_gen.modes.model import STATES
from microros_gen.modes.verification import check_model
from tests.support.modes.large import large_model
from tests.support.modes.models import MODELS, changed, model_of, model_text
from tests.support.patience import seconds

ARM = model_text("arm")
APPLICATION = (MODELS / "microros.yaml").read_text(encoding="utf-8")


def results(report: Report) -> dict[str, str]:
    return {found.name: found.result for found in report.properties}


def findings(report: Report) -> list[str]:
    return [diagnostic.render() for diagnostic in report.diagnostics]


def checked(text: str) -> Report:
    return check_model(model_of(text))


@pytest.mark.parametrize("name", ["arm", "robot"])
def test_a_right_model_is_proven(name: str) -> None:
    report = check(MODELS / f"{name}.yaml")
    assert findings(report) == []
    assert (report.result, report.exit_status) == ("proven", 0)
    assert set(results(report).values()) == {"proven"}
    assert list(results(report)) == [
        "parameters",
        "start order",
        "inference",
        "reachable modes",
        "stable rules",
        "single commands",
    ]


def test_a_file_with_mistakes_has_no_properties() -> None:
    report = check(MODELS / "two_arms.yaml")
    assert (report.properties, report.exit_status, len(report.diagnostics)) == ((), 2, 1)


def test_modes_that_look_the_same_because_nodes_have_the_same_values() -> None:
    """The default of the gripper equals SOFT, so that a mode with either cannot be told from the other one."""
    text = changed(
        ARM,
        "      QUICK:\n        gripper: active.FIRM\n        joint: active.RUSH",
        "      QUICK:\n        gripper: active\n        joint: active.CRAWL",
    )
    report = checked(text)
    assert results(report)["inference"] == "refuted"
    assert findings(report)[0].splitlines() == [
        "m.yaml:18:7: error: the modes 'GENTLE' and 'QUICK' of 'arm' look the same from outside. "
        "Command another mode or state of a part in one of them [MG-8841]",
        "        QUICK:",
        "        ^~~~~",
        "  gripper: active.SOFT in 'GENTLE', active.__DEFAULT__ in 'QUICK'",
        "  joint: active.CRAWL",
    ]
    assert report.exit_status == 2


def test_modes_that_look_the_same_because_unconfigured_counts_as_inactive() -> None:
    sleep = "      SLEEP:\n        gripper: unconfigured\n        joint: active\n    rules:\n"
    report = checked(changed(ARM, "    rules:\n", sleep))
    assert results(report)["inference"] == "refuted"
    assert "the modes '__DEFAULT__' and 'SLEEP' of 'arm' look the same from outside" in findings(report)[0]
    assert findings(report)[0].splitlines()[-2:] == [
        "  gripper: inactive in '__DEFAULT__', unconfigured in 'SLEEP'",
        "  joint: active.__DEFAULT__",
    ]


def test_a_stopped_system_looks_like_one_in_a_mode_that_stops_all_of_its_parts() -> None:
    text = changed(model_text("robot"), "        base: active.DRIVE\n", "        base: inactive\n")
    report = checked(text)
    assert results(report)["inference"] == "refuted"
    assert "  base: active.__DEFAULT__ in '__DEFAULT__', inactive in 'FAST'" in findings(report)[0]


def test_a_node_whose_modes_have_the_same_values_is_a_warning() -> None:
    report = checked(changed(ARM, "          force: 2.0", "          force: 0.5"))
    assert (
        "warning: the modes 'SOFT' and 'FIRM' of the node 'gripper' have the same values"
        in findings(report)[0]
    )
    assert report.exit_status == 0


def test_modes_that_differ_only_by_a_value_that_a_node_takes_look_different() -> None:
    text = changed(model_text("robot"), "        base: active.DRIVE\n", "        base: active\n")
    left = "            speed: 0.0\n            pid"
    with_template = changed(text, left, "            speed: $(parent speed)\n            pid")
    assert results(checked(text))["inference"] == "refuted"
    started = changed(with_template, "        wheels/left: inactive\n", "        wheels/left: active\n")
    assert results(checked(started))["inference"] == "proven"


def test_a_mode_that_is_never_commanded() -> None:
    report = checked(changed(ARM, "gripper: active.FIRM", "gripper: active.SOFT"))
    assert results(report)["reachable modes"] == "refuted"
    assert findings(report)[-1].splitlines() == [
        "m.yaml:46:7: error: the mode 'FIRM' of 'gripper' is never reached. "
        "Command it in a mode of 'arm', or remove it [MG-8843]",
        "        FIRM:",
        "        ^~~~",
        "  'arm' commands SOFT, __DEFAULT__",
    ]


def test_a_mode_that_only_a_rule_leads_to_is_reached() -> None:
    text = model_text("robot") + "".join(
        f"{line}\n"
        for line in (
            "top:",
            "  ros__parameters:",
            "    type: system",
            "    parts: [robot]",
            "    modes:",
            "      __DEFAULT__: {robot: inactive}",
            "      GO: {robot: active.FAST}",
        )
    )
    slow = "      SLOW:\n        camera: inactive\n    rules:\n"
    with_mode = changed(text, "    rules:\n", slow)
    assert results(checked(with_mode))["reachable modes"] == "refuted"
    with_rule = changed(with_mode, "        new_target: active\n", "        new_target: active.SLOW\n")
    assert results(checked(with_rule))["reachable modes"] == "proven"


REACHED_BY_RULE = """\
top:
  ros__parameters: {type: system, parts: [arm], modes: {__DEFAULT__: {arm: active.A}}}
arm:
  ros__parameters:
    type: system
    parts: [p]
    modes:
      __DEFAULT__: {p: inactive}
      A: {p: active.X}
      B: {p: active.Y}
    rules:
      a: {if_target: active.A, if_part: [p, active.X], new_target: active.B}
p:
  ros__parameters:
    type: node
    modes: {__DEFAULT__: {ros__parameters: {v: 1}}, X: {ros__parameters: {v: 2}}, Y: {ros__parameters: {v: 3}}}
"""


def test_a_mode_that_only_a_rule_that_never_holds_leads_to() -> None:
    """A system of one part that is what its target commands is in its target, where no rule is applied."""
    report = checked(REACHED_BY_RULE)
    assert (results(report)["reachable modes"], report.exit_status) == ("refuted", 2)
    assert findings(report)[-1].splitlines() == [
        "m.yaml:10:7: error: the mode 'B' of 'arm' is never reached. "
        "Command it in a mode of 'top', or remove it [MG-8843]",
        "        B: {p: active.Y}",
        "        ^",
        "  'top' commands A, __DEFAULT__",
        "  never applied: 'a'",
    ]
    other = changed(REACHED_BY_RULE, "if_part: [p, active.X]", "if_part: [p, active.Y]")
    assert results(checked(other))["reachable modes"] == "proven"


@pytest.mark.parametrize("state", [state for state in STATES if state != "active"])
def test_rules_oscillate_for_a_node_that_stays_in_any_state(state: str) -> None:
    text = changed(OSCILLATING, "        if_part: [joint, inactive]", f"        if_part: [joint, {state}]")
    report = checked(text.replace("if_part: [joint, inactive]", f"if_part: [joint, {state}]"))
    assert results(report)["stable rules"] == "refuted"
    assert f"failed joint {state}" in findings(report)[0]


RETRY = """\
      without_joint_retry:
        if_target: active.__DEFAULT__
        if_part: [joint, inactive]
        new_target: active.QUICK
"""
OSCILLATING = changed(ARM, "      # in __DEFAULT__ nothing is left to degrade to\n", RETRY).replace(
    "        new_target: inactive\n", "        new_target: active.__DEFAULT__\n"
)


ALIKE = """\
arm:
  ros__parameters:
    type: system
    parts: [p, q]
    modes:
      __DEFAULT__: {p: active.A, q: inactive}
      T1: {p: active.B, q: active}
      T3: {p: active.C, q: active}
    rules:
      a: {if_target: active.T1, if_part: [p, active.B], new_target: active.T3}
      b: {if_target: active.T3, if_part: [p, active.A], new_target: active.T1}
p:
  ros__parameters:
    type: node
    modes:
      __DEFAULT__: {ros__parameters: {v: 1}}
      A: {ros__parameters: {v: 2}}
      B: {ros__parameters: {v: 2}}
      C: {ros__parameters: {v: 3}}
q:
  ros__parameters: {type: node, modes: {__DEFAULT__: {ros__parameters: {v: 1}}}}
"""
"""The node p that stays in v: 2 is seen in B when that is its target, else in A."""


def test_rules_that_may_oscillate_for_modes_with_the_same_values_are_not_proven() -> None:
    report = checked(ALIKE)
    assert (results(report)["stable rules"], report.exit_status) == ("not proven", 1)
    (found,) = (text for text in findings(report) if "MG-8847" in text)
    assert "not proven for 'arm': its rules 'a', 'b' take modes with the same values for others" in found
    assert found.splitlines()[-2:] == ["  failed p active.A", "  failed q unknown"]
    failed = [Event(0, "fail", "q", Status("inactive")), Event(0, "fail", "p", Status("active", "B"))]
    requested = Event(10**6, "request", "arm", Status("active", "T1"))
    assert not simulate(model_of(ALIKE), (*failed, requested)).is_stable
    assert results(checked(changed(ALIKE, "{v: 3}", "{v: 4}").replace("{v: 2}", "{v: 3}", 1)))[
        "stable rules"
    ] == ("proven")


def test_a_rule_that_takes_a_mode_for_another_one_with_the_same_values() -> None:
    """A node that is inferred from values is in its target there, and no rule holds."""
    assert results(checked(changed(REACHED_BY_RULE, "[p, active.X]", "[p, active.Y]")))[
        "reachable modes"
    ] == ("proven")
    alike = changed(REACHED_BY_RULE, "{v: 3}", "{v: 2}")
    report = checked(changed(alike, "[p, active.X]", "[p, active.Y]"))
    assert results(report)["reachable modes"] == "not proven"


def test_an_oscillation_is_shown_as_a_trace() -> None:
    report = checked(OSCILLATING)
    assert results(report)["stable rules"] == "refuted"
    assert findings(report)[0].splitlines() == [
        "m.yaml:34:7: error: the rules of 'arm' oscillate: 'without_joint_retry', 'without_joint'. "
        "Let one of them lead to a target that has no rule for this failure [MG-8844]",
        "        without_joint_retry:",
        "        ^~~~~~~~~~~~~~~~~~~",
        "  failed joint inactive",
        "  request arm active.__DEFAULT__",
        "  command arm active.__DEFAULT__",
        "  command gripper inactive",
        "  command joint active.__DEFAULT__",
        "  rule without_joint_retry: arm active.QUICK",
        "  command gripper active.FIRM",
        "  command joint active.RUSH",
        "  rule without_joint: arm active.__DEFAULT__",
        "  command gripper inactive",
        "  command joint active.__DEFAULT__",
        "  rule without_joint_retry: arm active.QUICK",  # the gripper is inactive now, and was unconfigured
        "  command gripper active.FIRM",
        "  command joint active.RUSH",
        "  oscillates: arm active.QUICK again",
        "  status gripper active.FIRM",
        "  status arm activating",
    ]


UNCONFIGURED = """\
arm:
  ros__parameters:
    type: system
    parts: [p, q]
    modes:
      __DEFAULT__: {p: inactive, q: inactive}
      A: {p: unconfigured, q: active}
      B: {p: inactive, q: active.X}
      C: {p: active, q: active}
    rules:
      a: {if_target: active.A, if_part: [p, unconfigured], new_target: active.B}
      b: {if_target: active.B, if_part: [p, unconfigured], new_target: active.C}
      c: {if_target: active.C, if_part: [p, active], new_target: active.A}
p:
  ros__parameters: {type: node, modes: {__DEFAULT__: {ros__parameters: {v: 1}}}}
q:
  ros__parameters: {type: node, modes: {__DEFAULT__: {ros__parameters: {v: 1}}, X: {ros__parameters: {v: 2}}}}
"""
"""A cycle while q has failed and p follows: in B it is unconfigured, as A left it."""


def test_rules_oscillate_for_a_node_that_stays_unconfigured_where_it_has_to_be_inactive() -> None:
    report = checked(UNCONFIGURED)
    assert "the rules of 'arm' oscillate: 'b', 'c', 'a'." in findings(report)[0]
    events = [Event(0, "fail", "q", Status("inactive")), Event(1, "request", "arm", Status("active", "A"))]
    assert simulate(model_of(UNCONFIGURED), events).oscillating == ("arm",)
    inactive = changed(UNCONFIGURED, "B, if_part: [p, unconfigured]", "B, if_part: [p, inactive]")
    assert results(checked(inactive))["stable rules"] == "proven"


def test_a_trace_says_which_node_was_configured_before() -> None:
    report = checked(
        changed(
            UNCONFIGURED, "[p, unconfigured], new_target: active.C}", "[p, inactive], new_target: active.B}"
        )
    )
    lines = findings(report)[0].splitlines()[3:6]
    assert lines == ["  failed q unknown", "  configured p", "  request arm active.B"]


def test_a_rule_that_leads_to_its_own_target_oscillates() -> None:
    report = checked(changed(ARM, "        new_target: inactive\n", "        new_target: active.QUICK\n"))
    assert "the rules of 'arm' oscillate: 'without_joint'." in findings(report)[0]


def test_what_is_too_large_is_not_proven_and_not_refuted() -> None:
    report = check(MODELS / "robot.yaml", most=1)
    assert results(report)["stable rules"] == "not proven"
    assert (report.result, report.exit_status) == ("not proven", 1)
    names = [d.message for d in report.diagnostics]
    assert names == [
        f"not proven for '{name}': more than 1 different combinations of failures"
        for name in ("base", "robot")
    ]


@pytest.mark.parametrize("is_diagnosed", [False, True])
def test_five_subsystems_of_six_parts_take_less_than_ten_seconds(is_diagnosed: bool) -> None:
    """Also if each node has a rule for its warnings."""
    model = model_of(large_model(5, 6, is_diagnosed))
    assert len(model.nodes) == 30
    start = time.process_time()
    report = check_model(model)
    assert time.process_time() - start < seconds(10)
    assert set(results(report).values()) == {"proven"}
    (stable,) = (p.detail for p in report.properties if p.name == "stable rules")
    assert f"combinations of failures: {15**30:,}," in stable


def test_an_oscillation_among_thirty_nodes_is_found() -> None:
    text = changed(large_model(5, 6), "        new_target: inactive\n", "        new_target: active.FULL\n")
    assert results(checked(text))["stable rules"] == "refuted"


def with_application(tmp_path: Path, text: str, application: str = APPLICATION) -> Report:
    (tmp_path / "arm.yaml").write_text(text, encoding="utf-8")
    (tmp_path / "microros.yaml").write_text(application, encoding="utf-8")
    return check(tmp_path / "arm.yaml", [tmp_path / "microros.yaml"])


def test_parameters_that_the_board_accepts(tmp_path: Path) -> None:
    report = with_application(tmp_path, ARM)
    assert findings(report) == []
    assert report.properties[0].detail == "nodes as in application files: 1, as in __DEFAULT__: 1"


SPEED = "default: 0.1, range: {min: 0.0, max: 2.0, step: 0.1}"
STEPS = "range: {min: 0.0, max: 2.0, step: 0.25}"
LAW = "default: TORQUE, one_of: [TORQUE, SPEED], size: 8"
REFUSED = [
    ("name: law", "name: laws", "MG-8852", "law: TORQUE", "'joint' does not declare the parameter 'law'. Did"),
    (f"double, {SPEED}", "integer", "MG-8853", "speed: 0.1", "type double, the node declares integer"),
    (SPEED, f"read_only: true, {SPEED}", "MG-8854", "speed: 0.2", "'speed' is read-only"),
    ("max: 2.0", "max: 1.0", "MG-8855", "speed: 1.5", "is out of the node's range. Write 1.0: it goes from 0.0 to 1.0"),
    (SPEED, STEPS, "MG-8856", "speed: 0.1", "0.1, is between"),
    (LAW, "size: 5", "MG-8857", "law: TORQUE", "longer than its storage in the node. Set size: 6"),
    ("[TORQUE, SPEED]", "[TORQUE, FORCE]", "MG-8858", "law: SPEED", "that the node accepts. Available: TORQUE"),
    ("name: joint", "name: jiont", "MG-8851", "- name: jiont", "'/jiont' of the application is not in the model. Did"),
]  # fmt: skip
"""What is replaced in the application file, by what; the id, the line that is shown, words of the message."""


@pytest.mark.parametrize(("old", "new", "identity", "line", "words"), REFUSED)
def test_parameters_that_the_board_refuses(
    tmp_path: Path, old: str, new: str, identity: str, line: str, words: str
) -> None:
    report = with_application(tmp_path, ARM, changed(APPLICATION, old, new))
    matching = [text for text in findings(report) if f"[{identity}]" in text]
    assert matching, findings(report)
    assert words in matching[0]
    assert matching[0].splitlines()[1].strip() == line
    assert report.exit_status == 2


def test_a_template_is_checked_with_each_value_of_the_parent(tmp_path: Path) -> None:
    text = model_text("robot")
    application = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - name: left
    namespace: /wheels
    parameters:
      - {name: speed, type: double, range: {min: 0.0, max: 1.0}}
      - {name: pid.p, type: double}
      - {name: pid.i, type: double}
"""
    report = with_application(tmp_path, text, application)
    (found,) = report.diagnostics
    assert found.id == "MG-8855"
    assert "'speed', 1.2, is out of the node's range" in found.message
    assert found.span is not None
    assert found.span.source.line(found.span.line).strip() == "limit: 1.2"


def test_mistakes_of_both_files_are_reported_together(tmp_path: Path) -> None:
    report = with_application(
        tmp_path, changed(ARM, "active.SOFT", "active.SOFTT"), "profiles: pure_sender\n"
    )
    assert {d.span.source.name.rpartition("/")[2] for d in report.diagnostics if d.span} == {
        "arm.yaml",
        "microros.yaml",
    }


def test_rules_that_can_hold_at_once_are_counted() -> None:
    (detail,) = (p.detail for p in checked(ARM).properties if p.name == "single commands")
    assert detail == ("parts with one system: 2; pairs of rules of which the last by name is applied: 1")
