# SPDX-License-Identifier: Apache-2.0
"""Data flows one way: a folder of the package imports only from folders that stand before it."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import microros_gen

PACKAGE = Path(microros_gen.__file__).parent
# docs/architecture.md. What stands aside uses less of what precedes it: MAY.
ORDER = (
    "diagnostics",
    "documents",
    "interfaces",
    "application",
    "selection",
    "typesupport",
    "platform",
    "schedule",
    "client",
    "components",
    "selftest",
    "output",
    "toolchain",
    "image",
    "compiler",
    "package",
    "migrate",
    "ros",
    "graph_server",
    "parameter_server",
    "time_server",
    "ros_tools",
    "modes",
    "web",
    "mode_manager",
    "agent",
    "cli",
)
MAY = {
    "schedule": {"diagnostics", "schedule"},
    "graph_server": {"graph_server", "ros"},
    "parameter_server": {"diagnostics", "parameter_server", "records", "ros"},
    "ros_tools": {"diagnostics", "documents", "interfaces", "parameter_server", "ros", "ros_tools"},
    "time_server": {"records", "ros", "time_server"},
    "modes": {"application", "diagnostics", "documents", "modes"},
    "mode_manager": {"diagnostics", "mode_manager", "modes", "parameter_server", "ros", "web"},
    "agent": {"agent", "diagnostics", "documents", "interfaces", "ros", "web"},
    "web": {"web"},
    "cli": set(ORDER),
}
"""Folders that import other ones than those above them."""


def imports(path: Path) -> Iterator[tuple[int, str]]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno}: a relative import"
            yield node.lineno, node.module or ""


def violations(package: Path) -> list[str]:
    found = []
    for path in sorted(package.rglob("*.py")):
        folder = path.relative_to(package).parts[0]
        if folder not in ORDER:
            continue
        for line, module in imports(path):
            parts = module.split(".")
            if parts[0] != "microros_gen" or len(parts) == 1:
                continue
            used = parts[1]
            if used == "records":  # how data classes are defined, everywhere
                continue
            allowed = MAY.get(folder, set(ORDER[: ORDER.index(folder) + 1]))
            if used not in allowed:
                found.append(f"{path.relative_to(package)}:{line}: {folder} imports {used}")
    return found


def test_imports_point_one_way() -> None:
    assert violations(PACKAGE) == []


def test_the_compiler_is_used_by_its_documented_names() -> None:
    """`microros_gen.compiler` exports what other folders use; its modules are its own."""
    others = (path for path in sorted(PACKAGE.rglob("*.py")) if path.parent != PACKAGE / "compiler")
    inside = "microros_gen.compiler."
    assert [f"{p}:{line}" for p in others for line, module in imports(p) if module.startswith(inside)] == []


def test_every_folder_with_code_has_its_place() -> None:
    folders = {p.relative_to(PACKAGE).parts[0] for p in PACKAGE.rglob("*.py") if p.parent != PACKAGE}
    assert folders <= set(ORDER)


def test_the_check_finds_a_wrong_import(tmp_path: Path) -> None:
    (tmp_path / "interfaces").mkdir()
    (tmp_path / "interfaces" / "x.py").write_text("from microros_gen.client import y\n")
    assert violations(tmp_path) == ["interfaces/x.py:1: interfaces imports client"]


def test_only_reading_writing_and_building_touch_the_disk() -> None:
    """What parses, resolves and plans computes only: it starts no process, and opens no socket."""
    forbidden = {"subprocess", "socket", "tempfile", "shutil"}
    for folder in (
        "diagnostics",
        "interfaces",
        "application",
        "selection",
        "typesupport",
        "platform",
        "schedule",
        "client",
        "modes",
    ):
        for path in sorted((PACKAGE / folder).rglob("*.py")):
            names = {module.split(".")[0] for _, module in imports(path)}
            assert not names & forbidden, f"{path.name} uses {names & forbidden}"
