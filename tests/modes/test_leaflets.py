# SPDX-License-Identifier: Apache-2.0
"""Nodes whose modes are in application files are parts of a model, which need not repeat them."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.modes import Report, check

APPLICATION = """\
version: 1
profiles: [managed_service]
components: [+node_modes]
nodes:
  - name: joint
    namespace: /arm
    parameters:
      - {name: speed, type: double, default: 0.1, range: {min: 0.0, max: 2.0}}
      - {name: gains.p, type: integer, default: 3}
      - {name: path, type: "byte[]", size: 2}
      - {name: limit, type: double, default: 1.0, range: {min: 0.0, max: 5.0}}
    modes:
      __DEFAULT__: {limit: $(parent limit)}
      CRAWL: {speed: 0.2}
      RUSH: {speed: 1, path: [1, 2], gains: {p: 5}}
"""
MODEL = """\
robot:
  ros__parameters:
    type: system
    parts: [arm/joint]
    modes:
      __DEFAULT__: {arm/joint: active, ros__parameters: {limit: 1.0}}
      GENTLE: {arm/joint: active.CRAWL, ros__parameters: {limit: 0.5}}
      QUICK: {arm/joint: active.RUSH, ros__parameters: {limit: 2.5}}
"""
TWIN = """\
arm/joint:
  ros__parameters:
    type: node
    modes:
      __DEFAULT__:
        ros__parameters: {speed: 0.1, gains: {p: 3}, path: [7], limit: $(parent limit)}
      CRAWL:
        ros__parameters: {speed: 0.2}
      RUSH:
        ros__parameters: {speed: 1.0, path: [1, 2], gains: {p: 5}}
"""
WITH_PATH = APPLICATION.replace("size: 2}", "size: 2, default: [7]}")


def checked(folder: Path, model: str, application: str | None = APPLICATION) -> Report:
    (folder / "model.yaml").write_text(model, encoding="utf-8")
    if application is None:
        return check(folder / "model.yaml")
    (folder / "microros.yaml").write_text(application, encoding="utf-8")
    return check(folder / "model.yaml", [folder / "microros.yaml"])


def findings(report: Report) -> list[str]:
    return [diagnostic.render() for diagnostic in report.diagnostics]


def test_the_model_need_not_repeat_them(tmp_path: Path) -> None:
    report = checked(tmp_path, MODEL)
    assert findings(report) == []
    assert report.exit_status == 0
    details = {found.name: found.detail for found in report.properties}
    assert details["parameters"] == "nodes as in application files: 1, as in __DEFAULT__: 0"
    assert details["reachable modes"] == "modes: 6"
    assert "unknown part 'arm/joint'" in findings(checked(tmp_path, MODEL, None))[0]


def test_a_model_may_repeat_them(tmp_path: Path) -> None:
    """If it says the same; a difference is a mistake, as only one of them is on the device."""
    assert findings(checked(tmp_path, MODEL + TWIN, WITH_PATH)) == []
    for old, new in (
        ("speed: 0.2", "speed: 0.3"),
        ("CRAWL", "CREEP"),
        ("limit: $(parent limit)", "limit: 1.0"),
    ):
        text = (MODEL + TWIN).replace(old, new)
        found = findings(checked(tmp_path, text, WITH_PATH))
        assert len(found) == 1
        assert "model.yaml:9:1: error: the modes of 'arm/joint' are not those of the node" in found[0]
        assert "MG-8859" in found[0]


@pytest.mark.parametrize(
    ("old", "new", "identifier", "words"),
    [
        ("active.RUSH", "active.RUSHED", "MG-8817", "Did you mean 'RUSH'?"),
        ("parts: [arm/joint]", "parts: [arm/jiont]", "MG-8806", "Did you mean 'arm/joint'?"),
        ("limit: 2.5", "limit: 5.5", "MG-8855", "Write 5.0: it goes from 0.0 to 5.0"),
        (", ros__parameters: {limit: 1.0}", "", "MG-8828", "the system 'robot' has no parameter 'limit'"),
        ("active.CRAWL", "active", "MG-8843", "the mode 'CRAWL' of 'arm/joint' is never reached"),
    ],
)
def test_mistakes_in_the_model(tmp_path: Path, old: str, new: str, identifier: str, words: str) -> None:
    """What the system says of such a node is checked as for any other."""
    found = "\n".join(findings(checked(tmp_path, MODEL.replace(old, new))))
    assert words in found
    assert identifier in found


def test_a_mistake_in_the_application_file(tmp_path: Path) -> None:
    """It is shown there, and the model is not checked with half of its nodes."""
    found = findings(checked(tmp_path, MODEL, APPLICATION.replace("speed: 0.2", "speed: 9.0")))
    assert len(found) == 1
    assert "microros.yaml:14:22: error: the value of the parameter 'speed' is not in its range" in found[0]


def test_a_template_without_a_system(tmp_path: Path) -> None:
    """A node that no system has as a part gets no value for it."""
    others = """\
other:
  ros__parameters:
    type: node
    modes:
      __DEFAULT__: {ros__parameters: {v: 1}}
"""
    found = "\n".join(findings(checked(tmp_path, others)))
    assert "microros.yaml:13:28: error: the parameter 'limit' is the one of a parent" in found
    assert "MG-8827" in found


VALIDATED = """\
version: 1
profiles: [managed_service]
nodes:
  - name: joint
    parameters: {file: parameters.yaml}
"""
PARAMETERS = """\
joint:
  speed: {type: double, default_value: 1.0, validation: {gt<>: [0.0]}}
  share: {type: double, default_value: 0.5, validation: {gt<>: [0.0], lt<>: [1.0]}}
  count: {type: int, default_value: 3, validation: {gt_eq<>: [2]}}
  name: {type: string, default_value: "a", validation: {not_empty<>: null}}
"""
NODE = """\
joint:
  ros__parameters:
    type: node
    modes:
      __DEFAULT__: {ros__parameters: {speed: 1.0, share: 0.5, count: 3, name: "a"}}
"""


@pytest.mark.parametrize(
    ("old", "new", "identifier", "hint"),
    [
        ("speed: 1.0", "speed: 0.0", "MG-8855", "Write a number above 0.0"),
        ("share: 0.5", "share: 1.0", "MG-8855", "Write a number above 0.0 and below 1.0"),
        ("count: 3", "count: 1", "MG-8855", "Write a number from 2 on"),
        ('name: "a"', 'name: ""', "MG-3077", "Write \"x\": Parameter 'name' cannot be empty"),
    ],
)
def test_validation_of_a_parameter_file(
    tmp_path: Path, old: str, new: str, identifier: str, hint: str
) -> None:
    """Ends of a range that are excluded, or that nobody has set, are not shown as numbers."""
    (tmp_path / "parameters.yaml").write_text(PARAMETERS, encoding="utf-8")
    assert findings(checked(tmp_path, NODE, VALIDATED)) == []
    (found,) = findings(checked(tmp_path, NODE.replace(old, new), VALIDATED))
    assert "model.yaml:5:" in found
    assert hint in found
    assert identifier in found
