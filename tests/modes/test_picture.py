# SPDX-License-Identifier: Apache-2.0
"""The picture of a model is well-formed, complete, follows the theme, and is the same in every run."""

from __future__ import annotations

import subprocess
import sys
import xml.etree.ElementTree as ET

import pytest

from microros_gen.modes import draw
from tests.support.modes.large import large_model
from tests.support.modes.models import MODELS, changed, model_of, model_text

SVG = "{http://www.w3.org/2000/svg}"


def texts(picture: str) -> list[str]:
    return [element.text or "" for element in ET.fromstring(picture).iter(f"{SVG}text")]


@pytest.mark.parametrize("name", ["arm", "robot"])
def test_every_part_mode_and_value_is_in_it(name: str) -> None:
    model = model_of(model_text(name))
    shown = texts(draw(model))
    for part in model.parts.values():
        assert f"{part.name} ({'system' if part.is_system else 'node'})" in shown
        for mode in part.modes.values():
            assert mode.name in shown
            assert all(f"{p}: {command.target}" in shown for p, command in mode.commands.items())
        for rule in part.rules:
            assert f"{rule.if_target} → {rule.new_target}" in shown
            assert f"if {rule.if_part} is {rule.if_status}" in shown
    assert len(list(ET.fromstring(draw(model)).iter(f"{SVG}rect"))) == len(model.parts)
    assert len(list(ET.fromstring(draw(model)).iter(f"{SVG}path"))) == len(model.parents)


def test_a_rule_with_a_return_shows_when_it_is_over() -> None:
    rule = "        new_target: inactive\n"
    text = changed(model_text("arm"), rule, f"{rule}        recover_if: [joint, inactive, active.CRAWL]\n")
    assert "recover if joint is inactive or active.CRAWL" in texts(draw(model_of(text)))
    assert not any(line.startswith("recover") for line in texts(draw(model_of(model_text("arm")))))


def test_a_rule_shows_which_diagnostics_it_wants() -> None:
    part = "        if_part: [joint, inactive]\n"
    for keys, shown in (
        ("{level: [warn, stale], names: [heat, motor*]}", "and reports heat, motor*: warn or stale"),
        ("{level: warn}", "and reports any status: warn"),
        ("{level: warn, hardware: b*, names: [cell]}", "and there is cell of hardware b*: warn"),
    ):
        text = changed(model_text("arm"), part, f"{part}        diagnostics: {keys}\n")
        assert shown in texts(draw(model_of(text)))


def test_values_are_written_as_in_the_file() -> None:
    shown = texts(draw(model_of(changed(model_text("robot"), "rate: 10", "rate: true"))))
    assert {
        "rate: true",
        "topics: [front, rear]",
        "speed: $(parent limit)",
        "start base after camera",
    } <= set(shown)


def test_boxes_do_not_overlap_and_are_inside() -> None:
    root = ET.fromstring(draw(model_of(large_model(3, 4))))
    width, height = float(root.attrib["width"]), float(root.attrib["height"])
    boxes = [
        tuple(float(r.attrib[k]) for k in ("x", "y", "width", "height")) for r in root.iter(f"{SVG}rect")
    ]
    for i, (x, y, w, h) in enumerate(boxes):
        assert x >= 0
        assert y >= 0
        assert x + w <= width
        assert y + h <= height
        assert not any(
            x < x2 + w2 and x2 < x + w and y < y2 + h2 and y2 < y + h for x2, y2, w2, h2 in boxes[i + 1 :]
        )


def test_it_follows_the_theme_and_loads_nothing() -> None:
    picture = draw(model_of(model_text("arm")))
    assert "@media (prefers-color-scheme: dark)" in picture
    assert "http" not in picture.replace("http://www.w3.org/2000/svg", "")
    assert not list(ET.fromstring(picture).iter(f"{SVG}script"))


def test_texts_of_the_file_are_escaped_and_cut() -> None:
    text = changed(model_text("arm"), "law: TORQUE", f'law: "<&>{"x" * 100}"')
    (shown,) = {line for line in texts(draw(model_of(text))) if line.startswith("law: <&>")}
    assert shown.endswith("…")
    assert len(shown) < 70


@pytest.mark.builds
def test_another_process_draws_the_same_bytes() -> None:
    program = """\
import sys
from pathlib import Path
from microros_gen.modes import draw, read_model
sys.stdout.write(draw(read_model(Path(sys.argv[1]))))
"""
    outputs = {
        subprocess.run(
            [sys.executable, "-c", program, str(MODELS / "robot.yaml")],
            capture_output=True,
            check=True,
            env={"PYTHONHASHSEED": seed, "PYTHONPATH": ":".join(sys.path), "PYTHONUTF8": "1"},
        ).stdout
        for seed in ("1", "2")
    }
    assert len(outputs) == 1
