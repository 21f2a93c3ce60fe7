# SPDX-License-Identifier: Apache-2.0
"""Scripts of requests and failures are read with places and played with a trace that never differs."""

from __future__ import annotations

from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.mode_manager.settings import Settings
from microros_gen.mode_manager.simulation import simulate
from microros_gen.modes import Manager, Model, Status
from microros_gen.modes.script import parse_script
from tests.support.modes.models import changed, model_of, model_text

ARM = model_text("arm")
ROBOT = model_text("robot")


def played(
    text: str, script: str, settings: Settings | None = None, with_services: tuple[str, ...] = ()
) -> list[str]:
    model = model_of(text)
    diagnostics = Diagnostics()
    events = parse_script(Source("s.yaml", script), model, diagnostics)
    assert [d.render() for d in diagnostics] == []
    return simulate(model, events, settings, with_services).text().splitlines()


def test_a_failure_degrades_and_a_request_after_the_repair_restores() -> None:
    script = """\
- {at: 0 s, request: arm, target: active.QUICK}
- {at: 1500 ms, fail: gripper, state: inactive}
- {at: 4 s, repair: gripper}
- {at: 4 s, request: /arm, target: active.QUICK}
"""
    assert played(ARM, script) == [
        "0 s       request arm active.QUICK",
        "            status arm activating",
        "            call gripper change_state configure",
        "            call joint change_state configure",
        "0.01 s      status gripper inactive",
        "            status joint inactive",
        "            call gripper set_parameters_atomically",
        "            call joint set_parameters_atomically",
        "0.02 s      call gripper change_state activate",
        "            call joint change_state activate",
        "0.03 s      status gripper active.FIRM",
        "            status joint active.RUSH",
        "            status arm active.QUICK",
        "1.5 s     fail gripper inactive",
        "            gripper: others changed it from active.FIRM to inactive",
        "            arm: rule without_gripper_quick: active.__DEFAULT__",
        "            status gripper inactive",
        "            status arm activating",
        "            call joint set_parameters_atomically",
        "1.51 s      status joint active.__DEFAULT__",
        "            status arm active.__DEFAULT__",
        "4 s       repair gripper",
        "4 s       request arm active.QUICK",
        "            status arm activating.__DEFAULT__",
        "            call gripper change_state activate",
        "            call joint set_parameters_atomically",
        "4.01 s      status gripper active.FIRM",
        "            status joint active.RUSH",
        "            status arm active.QUICK",
        "end       arm active.QUICK",
        "          gripper active.FIRM",
        "          joint active.RUSH",
    ]


def test_a_node_that_others_changed_is_commanded_again() -> None:
    script = """\
- {at: 0 s, request: arm, target: active.QUICK}
- {at: 2 s, change: joint, parameters: {speed: 0.2, law: TORQUE}}
- {at: 4 s, change: joint, parameters: {speed: 9.0}}
"""
    lines = [line.strip() for line in played(ARM, script)]
    at = lines.index("2 s       change joint {speed: 0.2, law: TORQUE}")
    assert lines[at + 1 : at + 5] == [
        "joint: others changed it from active.RUSH to active.CRAWL",
        "status joint active.CRAWL",
        "status arm activating",
        "call joint set_parameters_atomically",
    ]
    assert "joint: others changed it from active.RUSH to active" in lines[at + 5 :]
    assert lines[-1] == "joint active.RUSH"


def test_two_changes_of_parameters_add_up() -> None:
    """Nothing was requested, so the node is left alone; only both values together are another mode."""
    script = """\
- {at: 0 s, change: joint, state: active}
- {at: 1 s, change: joint, parameters: {speed: 1.5}}
- {at: 2 s, change: joint, parameters: {law: SPEED}}
"""
    lines = played(ARM, script)
    assert lines[-1] == "          joint active.RUSH"
    assert not [line for line in lines if "call" in line]


def test_parameters_of_a_node_that_is_not_active_are_no_mode() -> None:
    assert (
        played(ARM, "- {at: 0 s, change: joint, parameters: {speed: 1.5}}\n")[-1]
        == "          joint unconfigured"
    )


def ends(script: str, text: str = ARM, **settings: Any) -> list[str]:
    """Return where the parts of a model end."""
    lines = played(text, script, Settings(**settings))
    at = next(i for i, line in enumerate(lines) if line.startswith("end "))
    return [line[10:] for line in lines[at:]]


def test_a_failed_node_stays_until_it_is_repaired() -> None:
    script = """\
- {at: 0 s, fail: gripper}
- {at: 2 s, request: arm, target: active.QUICK}
"""
    assert ends(script) == [
        "arm errorprocessing, target active.QUICK",
        "gripper errorprocessing, target active.FIRM: it is errorprocessing",
        "joint active.RUSH",
    ]
    repaired = f"{script}- {{at: 5 s, repair: gripper}}\n"
    assert ends(repaired) == ["arm active.QUICK", "gripper active.FIRM", "joint active.RUSH"]


def test_a_slow_node_responds_at_once_after_its_repair() -> None:
    """Without the responses that it still owed: of 30 seconds each, one after another."""
    script = """\
- {at: 0 s, request: arm, target: active}
- {at: 3 s, delay: joint, time: 30 s}
- {at: 3 s, request: arm, target: active.QUICK}
- {at: 80 s, repair: joint}
- {at: 90 s, change: gripper, parameters: {force: 2.0}}
"""
    assert ends(script) == ["arm active.QUICK", "gripper active.FIRM", "joint active.RUSH"]
    lines = played(ARM, script)
    after = lines[next(i for i, line in enumerate(lines) if "repair joint" in line) :]
    assert next(i for i, line in enumerate(after) if "status joint active.RUSH" in line) < next(
        i for i, line in enumerate(after) if line.startswith("90 s")
    )


def test_a_node_that_cannot_go_on_is_started_again_by_a_repair() -> None:
    """Finalized, or away: it returns unconfigured with its default parameters, and gets its target."""
    for fault in ("fail: gripper, state: finalized", "fail: gripper, state: unknown", "leave: gripper"):
        script = f"""\
- {{at: 0 s, request: arm, target: active.GENTLE}}
- {{at: 2 s, {fault}}}
- {{at: 9 s, repair: gripper}}
"""
        lines = [line.strip() for line in played(ARM, script)]
        assert lines[-2:] == ["gripper active.SOFT", "joint active.CRAWL"], fault
        assert "configure" in " ".join(lines[lines.index("9 s       repair gripper") :])


def test_a_refused_call_is_tried_three_times_before_a_rule_decides() -> None:
    script = """\
- {at: 0 s, refuse: gripper, calls: [activate]}
- {at: 0 s, request: arm, target: active.QUICK}
"""
    lines = [line[10:].strip() for line in played(ARM, script)]
    assert lines[0] == "refuse gripper activate"
    assert lines.count("call gripper change_state activate") == 3
    at = lines.index("gripper: it refuses change_state activate")
    assert lines[at + 1] == "arm: rule without_gripper_quick: active.__DEFAULT__"
    assert lines[-3:] == ["arm active.__DEFAULT__", "gripper inactive", "joint active.__DEFAULT__"]


def test_the_reason_of_refused_parameters_is_shown() -> None:
    script = """\
- {at: 0 s, request: arm, target: active.GENTLE}
- {at: 2 s, refuse: joint, calls: [set_parameters], reason: too hot}
- {at: 3 s, request: arm, target: active.QUICK}
"""
    assert ends(script)[2] == (
        "joint active.CRAWL, target active.RUSH: it refuses set_parameters_atomically: too hot"
    )


def test_a_late_response_is_found_later() -> None:
    """The joint does what it is told after the time-out; the manager asks, and does not tell it again."""
    script = """\
- {at: 0 s, delay: joint, time: 3 s, calls: [set_parameters]}
- {at: 0 s, request: arm, target: active.QUICK}
"""
    lines = played(ARM, script, Settings(call_s=2.0))
    assert lines[0] == "0 s       delay joint 3 s set_parameters"
    assert sum("call joint set_parameters" in line for line in lines) == 1
    assert [line[10:] for line in lines[-3:]] == [
        "arm active.QUICK",
        "gripper active.FIRM",
        "joint active.RUSH",
    ]
    assert max(float(line.split()[0]) for line in lines if line[0].isdigit()) >= 3.0


def test_the_time_of_a_response_is_that_of_the_script() -> None:
    script = "- {at: 0 s, delay: joint, time: 1 s}\n- {at: 0 s, request: arm, target: active.QUICK}\n"
    lines = played(ARM, script)
    heads = [line[:10].strip() for line in lines]
    assert [head for head in heads if head][-4:] == ["1 s", "2 s", "3 s", "end"]


def test_a_silent_node_is_unknown_until_it_answers() -> None:
    script = """\
- {at: 0 s, request: arm, target: active.QUICK}
- {at: 2 s, silence: joint}
"""
    assert ends(script)[2] == "joint unknown, target active.RUSH: it does not answer"
    assert ends(f"{script}- {{at: 60 s, repair: joint}}\n")[2] == "joint active.RUSH"


def test_nodes_with_mode_services_and_nodes_that_are_reconfigured() -> None:
    script = """\
- {at: 0 s, request: arm, target: active.GENTLE}
- {at: 2 s, request: arm, target: active.QUICK}
"""
    lines = played(ARM, script, Settings(reconfigured=frozenset({"gripper"})), ("joint",))
    calls = [line.split("call ")[1] for line in lines if " call " in line]
    assert [call for call in calls if "joint" in call] == [
        "joint change_state configure",
        "joint change_mode CRAWL",
        "joint change_state activate",
        "joint change_mode RUSH",
    ]
    assert [call for call in calls if "gripper" in call][-3:] == [
        "gripper change_state deactivate",
        "gripper set_parameters_atomically",
        "gripper change_state activate",
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
- {at: 2 s, fail: wheels/left, state: inactive}
"""
    lines = [line[10:].strip() for line in played(ROBOT, script)]
    after = lines[lines.index("fail wheels/left inactive") + 1 :]
    at = after.index("robot: rule stop: active.__DEFAULT__")
    assert "wheels/left: others changed it from active.TURN to inactive" in after[:at]
    assert next(line for line in after[at:] if line.startswith("call")) == (
        "call wheels/right change_state deactivate"
    )
    assert after[-5:] == [
        "robot active.__DEFAULT__",
        "base active.__DEFAULT__",
        "wheels/left inactive",
        "wheels/right inactive",
        "camera active.__DEFAULT__",
    ]


def test_the_last_rule_by_name_decides() -> None:
    """The package applies all rules that hold in the order of their names."""
    script = """\
- {at: 0 s, fail: gripper, state: inactive}
- {at: 1 s, fail: joint, state: inactive}
- {at: 2 s, request: arm, target: active.QUICK}
"""
    lines = played(ARM, script)
    assert [line[10:].strip() for line in lines if "rule" in line] == ["arm: rule without_joint: inactive"]
    assert lines[-3:] == ["end       arm inactive", "          gripper inactive", "          joint inactive"]


@pytest.mark.parametrize(
    ("script", "identity", "words"),
    [
        ("", "MG-8861", "'s.yaml' is no list of events"),
        ("at: 1 s", "MG-8861", "is no list of events"),
        ("- {at: 1 s, repair: joint}\n- {at: 0 s, repair: joint}", "MG-8862", "2:3: error: the event is before"),
        ("- {at: 1 s, repare: joint}", "MG-8863", "diagnose, hardware. Did you mean 'repair'?"),
        ("- {at: 1 s, repair: joint, fail: joint}", "MG-8863", "Write one event a line"),
        ("- {at: 1, repair: joint}", "MG-8864", "1:8: error: 'at' must be a time. Write 500 ms, or 2 s"),
        ("- {at: 1 s, fail: arm}", "MG-8865", "1:19: error: unknown node 'arm'"),
        ("- {at: 1 s, request: am, target: active}", "MG-8865", "unknown part 'am'. Did you mean 'arm'?"),
        ("- {at: 1 s, change: joint}", "MG-8866", "a change has either a state or parameters"),
        ("- {at: 1 s, change: joint, state: active, parameters: {speed: 1.0}}", "MG-8866", "a change has either"),
        ("- {at: 1 s, change: joint, parameters: {sped: 1.0}}", "MG-8867", "'sped'. Did you mean 'speed'?"),
        ("- {at: 1 s, change: joint, parameters: {speed: 1}}", "MG-8868", "takes a value of type double. Write it"),
        ("- {at: 1 s, request: arm}", "MG-1009", "missing key 'target'"),
        ("- {at: 1 s, delay: joint}", "MG-1009", "missing key 'time'"),
        ("- {at: 1 s, delay: joint, time: 3}", "MG-8864", "1:33: error: 'time' must be a time"),
        ("- {at: 1 s, refuse: joint, calls: [activat]}", "MG-8878", "'activat'. Did you mean 'activate'?"),
        ("- {at: 1 s, diagnose: joint, level: warm}", "MG-8884", "'warm' of a diagnosis. Did you mean 'warn'?"),
        ("- {at: 1 s, diagnose: joint}", "MG-1009", "missing key 'level'"),
        ("- {at: 1 s, hardware: battery}", "MG-1009", "missing key 'level'"),
        ("- {at: 1 s, hardware: 5, level: warn}", "MG-1010", "'hardware' must be a text"),
        ("- {at: 1 s, refuse: joint, calls: activate}", "MG-8879", "'calls' must be a list of calls"),
        ("- {at: 1 s, delay: joint, time: 3 s, calls: []}", "MG-8879", "'calls' must be a list of calls"),
        ("- {at: 1 s, refuse: joint, reason: 3}", "MG-1010", "'reason' must be a text"),
        ("- {at: 1 s, leave: arm}", "MG-8865", "unknown node 'arm'"),
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
