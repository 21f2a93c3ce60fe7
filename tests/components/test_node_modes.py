# SPDX-License-Identifier: Apache-2.0
"""The tables of modes as C: constants that modes share, what the plan id depends on, nodes without modes."""

from __future__ import annotations

import re
from pathlib import Path

from microros_gen import compiler

TEXT = """\
version: 1
profiles: [managed_service]
components: [+node_modes]
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: speed, type: double, default: 0.5}
      - {name: label, type: string, default: calm}
      - {name: limit, type: double}
    modes:
      __DEFAULT__: {limit: $(parent limit)}
      SLOW: {speed: 0}
      FAST: {label: wild, limit: 2.5}
  - {name: other}
"""


def generated(folder: Path, text: str) -> tuple[Path, str]:
    """Return the output folder of an application, and its plan id."""
    folder.mkdir(exist_ok=True)
    (folder / "microros.yaml").write_text(text, encoding="utf-8")
    out = compiler.generate(compiler.Options(config=folder / "microros.yaml"), folder / "out").out
    match = re.search(r'"plan": "([0-9a-f]+)"', (out / "manifest.json").read_text(encoding="utf-8"))
    assert match is not None
    return out, match[1]


def test_the_tables(tmp_path: Path) -> None:
    """A text that a mode inherits is the constant of `__DEFAULT__`; whole numbers become floating-point ones."""
    out, _ = generated(tmp_path / "a", TEXT)
    source = (out / "src" / "node_modes" / "rclc_modes_declared.c").read_text(encoding="utf-8")
    assert source.count('"calm"') == 1
    assert source.count("mode_of_arm_device_DEFAULT__1,") == 2
    assert "{.value = {.double_value = 0.0}}" in source
    assert "mode_of_arm_device_SLOW__given[] = {true, true, false};" in source
    assert '{"FAST", mode_of_arm_device_FAST, NULL}' in source


def test_only_nodes_with_modes_have_services(tmp_path: Path) -> None:
    out, _ = generated(tmp_path / "a", TEXT)
    manifest = (out / "manifest.json").read_text(encoding="utf-8")
    assert "/arm/device/change_mode" in manifest
    assert "/other/change_mode" not in manifest
    assert "/other/change_state" in manifest


def test_the_plan_id_depends_on_the_positions_of_modes(tmp_path: Path) -> None:
    """A library and an application fit together if each mode has the same position; values do not matter."""
    _, first = generated(tmp_path / "a", TEXT)
    changed = TEXT.replace("speed: 0}", "speed: 0.25}")
    assert generated(tmp_path / "b", changed)[1] == first
    swapped = TEXT.replace("SLOW", "QUIET").replace("FAST", "SLOW").replace("QUIET", "FAST")
    assert generated(tmp_path / "c", swapped)[1] != first
    more = TEXT.replace("      FAST", "      MIDDLE: {speed: 1.0}\n      FAST")
    assert generated(tmp_path / "d", more)[1] != first


def test_parameters_that_the_agent_holds(tmp_path: Path) -> None:
    """Modes set these as well."""
    text = TEXT.replace("    parameters:\n", "    parameters:\n      at: agent\n      declare:\n")
    text = text.replace("      - {", "        - {").replace("+node_modes", "+node_modes, +parameters_held")
    out, _ = generated(tmp_path / "a", text)
    assert (out / "src" / "node_modes" / "rclc_modes_apply.c").is_file()
    assert "/arm/device/set_parameters" not in (out / "manifest.json").read_text(encoding="utf-8")
