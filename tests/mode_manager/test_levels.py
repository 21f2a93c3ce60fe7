# SPDX-License-Identifier: Apache-2.0
"""Which levels of /diagnostics are errors of a node: `diagnostics` of the model file."""

from __future__ import annotations

from contextlib import ExitStack
from itertools import product
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.mode_manager.diagnosis import read_statuses
from microros_gen.mode_manager.simulation import simulate
from microros_gen.modes import check, parse_model
from microros_gen.modes.leaflets import parts_of
from microros_gen.modes.script import parse_script
from microros_gen.modes.verification import read_applications
from tests.support.mode_manager.arm import start_diagnosed
from tests.support.modes.models import changed, model_of, model_text

ARM = changed(
    model_text("arm"),
    "        if_part: [gripper, inactive]\n        new_target: active.__DEFAULT__\n      without_joint:",
    "        if_part: [gripper, errorprocessing]\n        new_target: active.__DEFAULT__\n      without_joint:",
)
JOINT = "joint:\n  ros__parameters:\n    type: node\n"
GRIPPER = "gripper:\n  ros__parameters:\n    type: node\n"
OK, WARN, ERROR, STALE = range(4)


def problems(keys: str, name: str, level: int) -> list[str]:
    """Return the errors of the gripper for a status that it publishes."""
    levels = model_of(changed(model_text("arm"), GRIPPER, f"{GRIPPER}{keys}")).parts["gripper"].diagnostics
    status = {"name": name, "level": level, "message": "", "hardware_id": "board"}
    return [each.error for each in read_statuses({"status": [status]}, {"gripper": levels})]


@pytest.mark.parametrize(
    ("keys", "errors"),
    [
        ("", {("motor", ERROR), ("heat", ERROR)}),
        ("    diagnostics: {level: error}\n", {("motor", ERROR), ("heat", ERROR)}),
        ("    diagnostics: {level: warn}\n", {(n, lev) for n in ("motor", "heat") for lev in (WARN, ERROR)}),
        (
            "    diagnostics: {level: [warn, stale], names: [heat]}\n",
            {("motor", ERROR), ("heat", WARN), ("heat", ERROR), ("heat", STALE)},
        ),
        (
            "    diagnostics: {level: stale, names: motor}\n",
            {("motor", ERROR), ("motor", STALE), ("heat", ERROR)},
        ),
    ],
)
def test_levels_that_are_errors(keys: str, errors: set[tuple[str, int]]) -> None:
    words = {OK: "", WARN: "warn", ERROR: "error", STALE: "stale"}
    for name, level in product(("motor", "heat"), words):
        expected = words[level] if (name, level) in errors else ""
        assert problems(keys, f"gripper: {name}", level) == [expected]


def test_a_warning_in_a_script_reaches_the_rule_that_is_proven(tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    script = "- {at: 0 s, request: arm, target: active.QUICK}\n- {at: 3 s, diagnose: gripper, level: warn}\n"
    ends = {}
    for keys in ("", "    diagnostics: {level: warn}\n"):
        path.write_text(changed(ARM, GRIPPER, f"{GRIPPER}{keys}"), encoding="utf-8")
        assert check(path).exit_status == 0
        model = model_of(path.read_text(encoding="utf-8"))
        found = Diagnostics()
        events = parse_script(Source("s.yaml", script), model, found)
        assert not found.has_errors()
        ends[keys] = {end.part: str(end.target) for end in simulate(model, events).ends}["arm"]
    assert list(ends.values()) == ["active.QUICK", "active.__DEFAULT__"]


def test_a_status_that_is_ok_again_ends_the_error() -> None:
    model = model_of(changed(model_text("arm"), JOINT, f"{JOINT}    diagnostics: {{level: stale}}\n"))
    script = """\
- {at: 0 s, request: arm, target: active.GENTLE}
- {at: 3 s, diagnose: joint, level: stale, name: heat}
- {at: 4 s, diagnose: joint, level: warn, name: motor}
- {at: 5 s, diagnose: joint, level: ok, name: heat}
"""
    text = simulate(model, parse_script(Source("s.yaml", script), model, Diagnostics())).text()
    lines = [line.strip() for line in text.splitlines()]
    assert "3 s       diagnose joint heat stale" in text
    assert lines.index("joint: joint: heat: stale") < lines.index("status arm errorprocessing")
    assert "end       arm active.GENTLE" in text


def test_a_node_of_an_application_file_has_levels_without_its_modes(tmp_path: Path) -> None:
    """The model file names the node for them; the modes stay those of the application file."""
    application = tmp_path / "microros.yaml"
    application.write_text(
        "version: 1\nprofiles: [managed_service]\nnodes:\n  - name: device\n    parameters:\n"
        "      - {name: speed, type: double, default: 0.5}\n    modes:\n      SLOW: {speed: 0.2}\n",
        encoding="utf-8",
    )
    text = """\
cell: {ros__parameters: {type: system, parts: [device], modes: {__DEFAULT__: {device: active.SLOW}}}}
device: {ros__parameters: {type: node, diagnostics: {level: [warn, stale]}}}
"""
    found = Diagnostics()
    leaflets = parts_of(read_applications([application], found))
    model = parse_model(Source("m.yaml", text), found, leaflets)
    assert model is not None, [d.render() for d in found]
    device = model.parts["device"]
    assert (list(device.modes), device.diagnostics.levels) == (
        ["__DEFAULT__", "SLOW"],
        ("warn", "error", "stale"),
    )
    assert parse_model(Source("m.yaml", text), found) is None, "without the application file it has no modes"


@pytest.mark.ros
@pytest.mark.system
def test_a_warning_on_diagnostics_degrades_the_arm(stack: ExitStack, domain: int, tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    text = changed(ARM, GRIPPER, f"{GRIPPER}    diagnostics: {{level: warn, names: [motor]}}\n")
    path.write_text(text, encoding="utf-8")
    _, managing, publisher = start_diagnosed(stack, domain, path)
    publisher.publish({"status": [{"name": "gripper: heat", "level": 1, "message": "warm"}]})
    publisher.publish({"status": [{"name": "gripper: motor", "level": 1, "message": "slow"}]})
    managing.wait_for("arm: rule without_gripper_quick: active.__DEFAULT__")
    assert not managing.says("warm")
