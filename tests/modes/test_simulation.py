# SPDX-License-Identifier: Apache-2.0
"""Scripts of requests and failures are read with places and played with a trace that never differs."""

from __future__ import annotations

import pytest

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.modes import Manager, Model, Status, simulate
from microros_gen.modes.script import parse_script
from tests.support.modes.models import changed, model_of, model_text

ARM = model_text("arm")
ROBOT = model_text("robot")


def played(text: str, script: str) -> list[str]:
    model = model_of(text)
    diagnostics = Diagnostics()
    events = parse_script(Source("s.yaml", script), model, diagnostics)
    assert [d.render() for d in diagnostics] == []
    return simulate(model, events).text().splitlines()


def test_a_failure_degrades_and_a_request_after_the_repair_restores() -> None:
    script = """\
- {at: 0 s, request: arm, target: active.QUICK}
- {at: 1500 ms, fail: gripper, state: inactive}
- {at: 2 s, repair: gripper}
- {at: 2 s, request: /arm, target: active.QUICK}
"""
    assert played(ARM, script) == [
        "0 s       request arm active.QUICK",
        "            command arm active.QUICK",
        "            command gripper active.FIRM",
        "            command joint active.RUSH",
        "            status gripper active.FIRM",
        "            status joint active.RUSH",
        "            status arm active.QUICK",
        "1.5 s     fail gripper inactive",
        "            status gripper inactive",
        "            rule without_gripper_quick: arm active.__DEFAULT__",
        "            command gripper inactive",
        "            command joint active.__DEFAULT__",
        "            status joint active.__DEFAULT__",
        "            status arm active.__DEFAULT__",
        "2 s       repair gripper",
        "2 s       request arm active.QUICK",
        "            command arm active.QUICK",
        "            command gripper active.FIRM",
        "            command joint active.RUSH",
        "            status gripper active.FIRM",
        "            status joint active.RUSH",
        "            status arm active.QUICK",
        "end       arm active.QUICK",
        "          gripper active.FIRM",
        "          joint active.RUSH",
    ]


def test_a_node_that_others_changed_is_commanded_again() -> None:
    script = """\
- {at: 0 s, request: arm, target: active.QUICK}
- {at: 1 s, change: joint, parameters: {speed: 0.2, law: TORQUE}}
- {at: 2 s, change: joint, parameters: {speed: 9.0}}
"""
    lines = played(ARM, script)
    at = lines.index("1 s       change joint {speed: 0.2, law: TORQUE}")
    assert lines[at + 1 : at + 8] == [
        "            status joint active.CRAWL",
        "            repeat joint active.RUSH",
        "            status joint active.RUSH",
        "2 s       change joint {speed: 9.0}",
        "            status joint active",
        "            repeat joint active.RUSH",
        "            status joint active.RUSH",
    ]


def test_two_changes_of_parameters_add_up() -> None:
    """Nothing was requested, so the node is left alone; only both values together are another mode."""
    script = """\
- {at: 0 s, change: joint, state: active}
- {at: 1 s, change: joint, parameters: {speed: 1.5}}
- {at: 2 s, change: joint, parameters: {law: SPEED}}
"""
    assert played(ARM, script)[-1] == "          joint active.RUSH"


def test_parameters_of_a_node_that_is_not_active_are_no_mode() -> None:
    assert (
        played(ARM, "- {at: 0 s, change: joint, parameters: {speed: 1.5}}\n")[-1]
        == "          joint unconfigured"
    )


def test_a_failed_node_stays_until_it_is_repaired() -> None:
    script = """\
- {at: 0 s, fail: gripper}
- {at: 1 s, request: arm, target: active.QUICK}
- {at: 2 s, repair: gripper}
"""
    lines = played(ARM, script)
    assert lines[0] == "0 s       fail gripper errorprocessing"
    assert lines[-7:] == [
        "2 s       repair gripper",
        "            repeat gripper active.FIRM",
        "            status gripper active.FIRM",
        "            status arm active.QUICK",
        "end       arm active.QUICK",
        "          gripper active.FIRM",
        "          joint active.RUSH",
    ]


def commands(model: Model, *requests: tuple[str, Status]) -> list[str]:
    manager = Manager(model)
    steps = [step for part, status in requests for step in manager.request(part, status)]
    return [f"{step.part} {step.status}" for step in steps if step.kind == "command"]


def test_parts_start_in_order_and_stop_in_reverse() -> None:
    model = model_of(ROBOT)
    fast, inactive = Status("active", "FAST"), Status("inactive")
    assert commands(model, ("robot", fast), ("robot", inactive)) == [
        "robot active.FAST",
        "camera active.__DEFAULT__",
        "base active.DRIVE",
        "wheels/left active.TURN",
        "wheels/right active.TURN",
        "robot inactive",
        "base inactive",
        "wheels/right inactive",
        "wheels/left inactive",
        "camera inactive",
    ]


def test_what_is_stopped_in_a_mode_is_stopped_before_others_start() -> None:
    model = model_of(
        changed(
            ARM,
            "        gripper: inactive\n        joint: active\n",
            "        gripper: active\n        joint: inactive\n",
        )
    )
    requests = (("arm", Status("active", "QUICK")), ("arm", Status("active", "__DEFAULT__")))
    assert commands(model, *requests)[-2:] == ["joint inactive", "gripper active.__DEFAULT__"]


def test_a_redundant_request_commands_nothing() -> None:
    model = model_of(ARM)
    quick = Status("active", "QUICK")
    assert len(commands(model, ("arm", quick), ("arm", quick))) == 3


def test_a_subsystem_degrades_before_its_system() -> None:
    script = """\
- {at: 0 s, request: robot, target: active.FAST}
- {at: 1 s, fail: wheels/left, state: inactive}
"""
    lines = played(ROBOT, script)
    assert lines[lines.index("1 s       fail wheels/left inactive") + 1 :] == [
        "            status wheels/left inactive",
        "            rule stop: robot active.__DEFAULT__",
        "            command base active.__DEFAULT__",
        "            command wheels/right inactive",
        "            command wheels/left inactive",
        "            status wheels/right inactive",
        "            status base active.__DEFAULT__",
        "            status robot active.__DEFAULT__",
        "end       robot active.__DEFAULT__",
        "          base active.__DEFAULT__",
        "          wheels/left inactive",
        "          wheels/right inactive",
        "          camera active.__DEFAULT__",
    ]


def test_the_last_rule_by_name_decides() -> None:
    """The package applies all rules that hold in the order of their names."""
    script = """\
- {at: 0 s, fail: gripper, state: inactive}
- {at: 1 s, fail: joint, state: inactive}
- {at: 2 s, request: arm, target: active.QUICK}
"""
    lines = played(ARM, script)
    assert [line.strip() for line in lines if "rule" in line] == ["rule without_joint: arm inactive"]
    assert lines[-3:] == ["end       arm inactive", "          gripper inactive", "          joint inactive"]


@pytest.mark.parametrize(
    ("script", "identity", "words"),
    [
        ("", "MG-8861", "'s.yaml' is no list of events"),
        ("at: 1 s", "MG-8861", "is no list of events"),
        ("- {at: 1 s, repair: joint}\n- {at: 0 s, repair: joint}", "MG-8862", "2:3: error: the event is before"),
        ("- {at: 1 s, repare: joint}", "MG-8863", "request, fail, repair, change. Did you mean 'repair'?"),
        ("- {at: 1 s, repair: joint, fail: joint}", "MG-8863", "Write one event a line"),
        ("- {at: 1, repair: joint}", "MG-8864", "1:8: error: 'at' must be a time. Write 500 ms, or 2 s"),
        ("- {at: 1 s, fail: arm}", "MG-8865", "1:19: error: unknown node 'arm'"),
        ("- {at: 1 s, request: am, target: active}", "MG-8865", "unknown part 'am'. Did you mean 'arm'?"),
        ("- {at: 1 s, change: joint}", "MG-8866", "a change has either a state or parameters"),
        ("- {at: 1 s, change: joint, state: active, parameters: {speed: 1.0}}", "MG-8866", "a change has either"),
        ("- {at: 1 s, change: joint, parameters: {sped: 1.0}}", "MG-8867", "'sped'. Did you mean 'speed'?"),
        ("- {at: 1 s, change: joint, parameters: {speed: 1}}", "MG-8868", "takes a value of type double. Write it"),
        ("- {at: 1 s, request: arm}", "MG-1009", "missing key 'target'"),
        ("- {at: 1 s, request: arm, target: active.QUICC}", "MG-8817", "Did you mean 'QUICK'?"),
        ("- {request: arm, target: active}", "MG-1009", "missing key 'at'"),
        ("- 5", "MG-1007", "an event must be a mapping"),
    ],
)  # fmt: skip
def test_mistakes_in_a_script(script: str, identity: str, words: str) -> None:
    diagnostics = Diagnostics()
    parse_script(Source("s.yaml", script), model_of(ARM), diagnostics)
    (found,) = diagnostics
    assert found.id == identity
    assert words in found.headline()
