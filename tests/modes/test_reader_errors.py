# SPDX-License-Identifier: Apache-2.0
"""Every mistake of a model file is reported with its place and a hint, all of them in one run."""

from __future__ import annotations

import pytest

from tests.support.modes.models import changed, model_text, parsed

BASE = model_text("robot")
ARM = model_text("arm")

RULE = "        if_target: active.QUICK\n        if_part: [joint, inactive]\n"
WARNED = "        if_target: active.QUICK\n        if_part: [joint, active.RUSH]\n"
DIAGNOSED = [
    (
        "{level: warm}",
        "MG-8882",
        "warm}",
        "unknown level 'warm' of the diagnostics of 'without_joint'. Did you",
    ),
    ("warn", "MG-1007", "warn", "'diagnostics' of 'without_joint' must be a mapping of keys and values"),
    ("{names: [heat]}", "MG-1009", "{names: [heat]}", "missing key 'level'"),
    ("{level: warn, name: heat}", "MG-1008", "name: heat}", "unknown key 'name'. Did you mean 'names'?"),
    ("{level: [warn, [stale]]}", "MG-8883", "[warn, [stale]]}", "'level' must be a text, or a list of texts"),
    ("{level: warn, names: ['m*r']}", "MG-9830", "'m*r']}", "'m*r' has a '*' that is not at its end"),
    (
        "{level: warn, names: ['joint: heat']}",
        "MG-9832",
        "'joint: heat']}",
        "status 'joint: heat' of 'joint': its own name is left out here. Write 'heat'",
    ),
    ("{level: warn, names: ['/joint:*']}", "MG-9832", "'/joint:*']}", "Write '*'"),
    ("{level: [warn, warn]}", "MG-9831", "warn]}", "'warn' is listed twice. Remove it"),
    ("{level: warn, names: [heat, heat]}", "MG-9831", "heat]}", "'heat' is listed twice"),
    ("{level: warn, names: [heater, heat*]}", "MG-9831", "heater, heat*]}", "'heater' is among 'heat*'"),
    ("{level: warn, names: []}", "MG-9833", "[]}", "'names' of the diagnostics of 'without_joint' is empty"),
    (
        "{level: warn, hardware: ''}",
        "MG-9836",
        "''}",
        "must be a hardware_id of another program. Write hardware: battery, or hardware: '*' for each",
    ),
    (
        "{level: warn, hardware: 5}",
        "MG-9836",
        "5}",
        "'hardware' of the diagnostics of 'without_joint' must be",
    ),
    ("{level: warn, hardware: mode manager}", "MG-9836", "mode manager}", "of another program"),
    ("{level: warn, hardware: 'b*d'}", "MG-9830", "'b*d'}", "'b*d' has a '*' that is not at its end"),
    (
        "{level: warn, hardware: '*', names: ['joint: heat']}",
        "MG-9837",
        "'joint: heat']}",
        "is a status of 'joint', which is a part: 'hardware' leaves it out. Remove hardware and write names: [heat]",
    ),
    (
        "{level: warn, hardware: '*', names: ['joint:*']}",
        "MG-9837",
        "'joint:*']}",
        "and write no names, in a rule on joint",
    ),
    (
        "{level: warn, hardware: '*', names: ['arm: x']}",
        "MG-9837",
        "'arm: x']}",
        "Name a status of no part: no rule waits for those of a system",
    ),
    ("{level: error}", "MG-9835", "error}", "with these statuses 'joint' is in errorprocessing"),
]

CASES = [
    (
        "camera:\n  ros__parameters:\n    type: node\n",
        "camera:\n  ros__parameters:\n    type: node\n    contingencies: [SAVE]\n",
        "MG-8881",
        "SAVE]",
        "'contingencies' of 'camera': unknown mode 'SAVE'",
    ),
    (
        "camera:\n  ros__parameters:\n    type: node\n",
        "camera:\n  ros__parameters:\n    type: node\n    diagnostics: {level: warm}\n",
        "MG-8882",
        "warm}",
        "unknown level 'warm' of the diagnostics of 'camera'. Did you mean 'warn'?",
    ),
    (
        "camera:\n  ros__parameters:\n    type: node\n",
        "camera:\n  ros__parameters:\n    type: node\n    contingencies: {a: b}\n",
        "MG-8883",
        "{a: b}",
        "'contingencies' must be a text, or a list of texts",
    ),
    ("", "", "MG-8802", "", "has no parts"),
    (
        "base:\n  ros__parameters:\n    type: system",
        "base:\n  parameters:\n    type: system",
        "MG-8803",
        "parameters:",
        "the part 'base' has no 'ros__parameters'. Did you mean 'ros__parameters'?",
    ),
    (
        "base:\n  ros__parameters:\n    type: system",
        "base:\n  a:\n    type: system",
        "MG-8803",
        "base:",
        "the part 'base' has no 'ros__parameters'. Indent its keys",
    ),
    ("/camera:", "base2: {}\n/camera:", "MG-8803", "base2: {}", "the part 'base2'"),
    ("/camera:", "/base:", "MG-8804", "/base:", "duplicate part 'base'; first in line 25"),
    ("/camera:", "/camera 2:", "MG-8805", "/camera 2:", "'camera 2' is not the name of a part"),
    ("[base, camera]", "[base, camra]", "MG-8806", "camra]", "unknown part 'camra' of 'robot'. Did you mean"),
    ("[base, camera]", "[base, camera, base]", "MG-8807", "base]", "'base' is listed as a part of 'robot'"),
    (
        "[base, camera]",
        "[base, [camera]]",
        "MG-8808",
        "[base, [camera]]",
        "a list of parts must have names only",
    ),
    ("[base, camera]", "[]", "MG-8809", "[]", "the system 'robot' has no parts"),
    (
        "      __DEFAULT__:\n        ros__parameters:\n          limit",
        "      DEFAULT:\n        ros__parameters:\n          limit",
        "MG-8810",
        "DEFAULT:",
        "the part 'robot' has no mode __DEFAULT__. Write __DEFAULT__",
    ),
    (
        "      __DEFAULT__:\n        ros__parameters:\n          limit",
        "      FIRST:\n        ros__parameters:\n          limit",
        "MG-8810",
        "modes:",
        "the part 'robot' has no mode __DEFAULT__. Add `__DEFAULT__:` before",
    ),
    ("      FAST:", "      FA.ST:", "MG-8811", "FA.ST:", "'FA.ST' is not the name of a mode"),
    (
        "        camera: active\n",
        "",
        "MG-8812",
        "__DEFAULT__:",
        "__DEFAULT__ of 'robot' gives no state of the part 'camera'",
    ),
    ("base: active.DRIVE", "bass: active.DRIVE", "MG-8813", "bass: active.DRIVE", "Did you mean 'base'?"),
    (
        "base: active.DRIVE",
        "base: Active",
        "MG-8814",
        "Active",
        "unknown state 'Active'. Did you mean 'active'?",
    ),
    ("base: active.DRIVE", "base: DRIVE", "MG-8814", "DRIVE", "unknown state 'DRIVE'. Write active.DRIVE"),
    ("base: active.DRIVE", "base: active DRIVE", "MG-8814", "active DRIVE", "Write active.DRIVE"),
    ("base: active.DRIVE", "base: active/DRIVE", "MG-8814", "active/DRIVE", "Write active.DRIVE"),
    ("base: active.DRIVE", "base: Active DRIVE", "MG-8814", "Active DRIVE", "Write active.DRIVE"),
    ("base: active.DRIVE", "base: inactive DRIVE", "MG-8814", "inactive DRIVE", "Did you mean 'inactive'?"),
    ("base: active.DRIVE", "base: not-DRIVE", "MG-8814", "not-DRIVE", "Did you mean 'inactive'?"),
    (
        "base: active.DRIVE",
        "base: unconfigured",
        "MG-8815",
        "unconfigured",
        "a system cannot be commanded to be unconfigured",
    ),
    (
        "        camera: active\n",
        "        camera: activating\n",
        "MG-8815",
        "activating",
        "a node cannot be commanded",
    ),
    (
        "base: active.DRIVE",
        "base: inactive.DRIVE",
        "MG-8816",
        "inactive.DRIVE",
        "the state inactive has no modes",
    ),
    (
        "base: active.DRIVE",
        "base: active.DRIV",
        "MG-8817",
        "active.DRIV",
        "unknown mode 'DRIV' of 'base'. Did you mean 'DRIVE'?",
    ),
    ("base: active.DRIVE", "base: 3", "MG-8818", "3", "a state must be a text"),
    ("          limit: 1.2", "          limits: 1.2", "MG-8820", "limits: 1.2", "Did you mean 'limit'?"),
    (
        "          limit: 1.2",
        "          limit: 1",
        "MG-8821",
        "1",
        "is of type integer, and in __DEFAULT__ double. Write it with",
    ),
    (
        "          limit: 1.2",
        "          limit: $(var fast)",
        "MG-8821",
        "$(var fast)",
        "is of type string, and in __DEFAULT__ double. Write a value, or $(parent NAME)",
    ),
    *(
        (
            "          limit: 1.2",
            f"          limit: {text}",
            "MG-8822",
            text,
            f"this is no template. Write {right}",
        )
        for text, right in (
            ("$(parents limit)", "$(parent limit)"),
            ("$( parent limit )", "$(parent limit)"),
            ("$(parent)", "$(parent NAME)"),
            ("$(parent 2nd)", "$(parent NAME)"),
            ("$( parents 2nd )", "$(parent NAME)"),
        )
    ),
    (
        "          limit: 1.2",
        "          limit: fast",
        "MG-8821",
        "fast",
        "is of type string, and in __DEFAULT__ double. Use one",
    ),
    ("rate: 10", "rate: ~", "MG-8822", "~", "the parameter 'rate' has no value of a type of ROS 2"),
    ("rate: 10", "rate: 9223372036854775808", "MG-8822", "9223372036854775808", "'rate'"),
    ("[front, rear]", "[front, 2]", "MG-8822", "[front, 2]", "'topics'"),
    ("[front, rear]", "[]", "MG-8822", "[]", "'topics'"),
    (
        "wheels/left\n      wheels/right",
        "wheels/left\n      robot",
        "MG-8823",
        "robot",
        "the system 'robot' contains itself: robot > base > robot",
    ),
    (
        "[base, camera]",
        "[base, camera, wheels/left]",
        "MG-8824",
        "wheels/left",
        "the part 'wheels/left' is in two systems, 'robot' and 'base'",
    ),
    (
        "base: camera\n",
        "{base: camera, camera: base}\n",
        "MG-8825",
        "base}",
        "is circular: base after camera after base",
    ),
    (
        "base: camera\n",
        "base: camara\n",
        "MG-8826",
        "camara",
        "names 'camara', which is no part of it. Did you mean 'camera'?",
    ),
    ("limit: 0.3", "limit: $(parent rate)", "MG-8827", "$(parent rate)", "'robot' is in no system"),
    (
        "$(parent limit)",
        "$(parent limits)",
        "MG-8828",
        "$(parent limits)",
        "the system 'robot' has no parameter 'limits'. Did you mean 'limit'?",
    ),
    (
        "speed: 0.0\n            pid",
        "speed: 0\n            pid",
        "MG-8829",
        "$(parent speed)",
        "is of type integer, and 'speed' of the parent is double",
    ),
    (
        "if_part: [base, activating]",
        "if_part: [base, activating]\n        recover_if: [base]",
        "MG-8885",
        "[base]",
        "'recover_if' must be a part and its states",
    ),
    ("[base, activating]", "base", "MG-8830", "base", "'if_part' must be a part and its state"),
    (
        "[base, activating]",
        "[bass, activating]",
        "MG-8831",
        "bass, activating]",
        "'bass' is no part of 'robot', whose rule names it. Did you mean",
    ),
    (
        "type: system\n    parts: [",
        "type: systems\n    parts: [",
        "MG-1011",
        "systems",
        "'type' must be one of system, node",
    ),
    ("    rules:", "    rule:", "MG-1008", "rule:", "unknown key 'rule'. Did you mean 'rules'?"),
    ("        new_target: active\n", "", "MG-1009", "if_target: active.FAST", "missing key 'new_target'"),
    (
        "        base: active.DRIVE",
        "        base: active\n        base: active",
        "MG-1044",
        "base: active",
        "duplicate key 'base'; first in line 18",
    ),
    (
        "            speed: 0.0\n            pid",
        "            spd\n            pid",
        "MG-1018",
        ": {p: 1.0, i: 0.1}",
        "not valid YAML",
    ),
]
"""What is replaced in robot.yaml, by what; the id, the text at the caret, and words of the first line."""


@pytest.mark.parametrize(("old", "new", "identity", "place", "words"), CASES)
def test_a_mistake_is_reported_at_its_place(
    old: str, new: str, identity: str, place: str, words: str
) -> None:
    text = changed(BASE, old, new) if old else new
    model, found = parsed(text)
    assert model is None
    matching = [d for d in found if d.id == identity and words in d.headline()]
    assert matching, [d.render() for d in found]
    span = matching[0].span
    assert (span.source.line(span.line)[span.column - 1 :] if span else "") == place
    assert matching[0].hint


@pytest.mark.parametrize(("value", "identity", "place", "words"), DIAGNOSED)
def test_a_mistake_in_the_diagnostics_of_a_rule(value: str, identity: str, place: str, words: str) -> None:
    model, found = parsed(changed(ARM, RULE, f"{WARNED}        diagnostics: {value}\n"))
    assert model is None
    assert [d.id for d in found] == [identity], [d.render() for d in found]
    span = found[0].span
    assert span is not None
    assert span.source.line(span.line)[span.column - 1 :] == place
    assert words in found[0].headline()
    assert found[0].hint


def test_diagnostics_of_a_rule_are_those_of_a_node() -> None:
    rule = "        if_part: [base, activating]\n"
    _, found = parsed(changed(BASE, rule, f"{rule}        diagnostics: {{level: warn}}\n"))
    assert [d.id for d in found] == ["MG-9834"]
    assert "'base' is a system, and the rule 'stop' wants diagnostics of it" in found[0].headline()


def test_what_is_no_part_can_be_wanted_with_a_system_too_and_is_no_error_of_a_node() -> None:
    rule = "        if_part: [base, activating]\n"
    wanted = "        diagnostics: {level: error, hardware: battery, names: [cell 1, pack*]}\n"
    assert parsed(changed(BASE, rule, f"{rule}{wanted}"))[1] == []


def test_a_level_that_is_an_error_of_the_node_as_well() -> None:
    """Then the rule has to be one for error processing."""
    text = changed(ARM, RULE, f"{WARNED}        diagnostics: {{level: warn, names: [heat]}}\n")
    joint = "joint:\n  ros__parameters:\n    type: node\n"
    assert parsed(text)[1] == []
    for names, identities in (("[heat]", ["MG-9835"]), ("[h*]", ["MG-9835"]), ("[motor]", [])):
        keys = f"    diagnostics: {{level: warn, names: {names}}}\n"
        assert [d.id for d in parsed(changed(text, joint, f"{joint}{keys}"))[1]] == identities
    right = changed(text, "[joint, active.RUSH]", "[joint, errorprocessing]")
    assert parsed(changed(right, joint, f"{joint}    diagnostics: {{level: warn}}\n"))[1] == []


def test_all_mistakes_are_reported_in_one_run_in_the_order_of_lines() -> None:
    text = changed(
        changed(ARM, "gripper: active.SOFT", "gripper: active.SOFTT"), "joint: active.RUSH", "jnt: active"
    )
    text = changed(changed(text, "force: 2.0", "force: 2"), "[joint, inactive]", "[joint, idle]")
    _, found = parsed(text)
    assert [(d.span.line if d.span else 0, d.id) for d in found] == [
        (16, "MG-8817"),
        (20, "MG-8813"),
        (32, "MG-8814"),
        (48, "MG-8821"),
    ]


def test_what_is_reported_once_has_no_consequences() -> None:
    """A part that is misspelled in the list is not reported again in each mode."""
    _, found = parsed(changed(ARM, "      gripper\n", "      griper\n"))
    assert [d.id for d in found if d.id == "MG-8806"] == ["MG-8806"]


def test_a_cycle_of_one() -> None:
    _, found = parsed(changed(ARM, "      joint\n", "      joint\n      arm\n"))
    assert "the system 'arm' contains itself: arm > arm" in [d.message for d in found]


def nested(levels: int) -> str:
    """Return a file of systems above each other, and a node."""
    system = "s%d: {ros__parameters: {type: system, parts: [s%d], modes: {__DEFAULT__: {s%d: active}}}}\n"
    node = "s%d: {ros__parameters: {type: node, modes: {__DEFAULT__: {ros__parameters: {x: 1}}}}}\n"
    return "".join(system % (i, i + 1, i + 1) for i in range(levels)) + node % levels


def test_a_hierarchy_has_a_bound() -> None:
    assert parsed(nested(32))[1] == []
    model, found = parsed(nested(300))
    assert model is None
    assert [d.headline() for d in found] == [
        "m.yaml:33:47: error: the hierarchy has more than 32 levels of systems. Flatten it [MG-8832]"
    ]


def test_a_system_without_modes_is_reported_once() -> None:
    """Its rules name modes, which are no further mistakes."""
    text = ARM[: ARM.index("    modes:")] + ARM[ARM.index("    rules:") :]
    _, diagnostics = parsed(text)
    assert [(d.id, d.hint) for d in diagnostics] == [("MG-1009", "Add `modes: …`")]
