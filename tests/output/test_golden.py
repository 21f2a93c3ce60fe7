# SPDX-License-Identifier: Apache-2.0
"""Comparing with a golden copy."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.output.golden import golden_differences
from microros_gen.output.tree import MANIFEST, write_tree


def files(version: str = "1", **more: str) -> dict[str, bytes]:
    manifest = {"generator": {"name": "microros-gen", "version": version}, "outputs": {"a.c": ""}}
    content = {"a.c": "int a;\n"} | {name.replace("_", "."): text for name, text in more.items()}
    return {n: t.encode() for n, t in content.items()} | {MANIFEST: json.dumps(manifest).encode()}


def test_equal_trees_have_no_difference(tmp_path: Path) -> None:
    write_tree(tmp_path, files())
    assert golden_differences(tmp_path, files()) == ()


def test_the_generators_version_is_left_out(tmp_path: Path) -> None:
    write_tree(tmp_path, files("1"))
    assert golden_differences(tmp_path, files("2")) == ()


def test_built_files_are_no_part_of_the_comparison(tmp_path: Path) -> None:
    write_tree(tmp_path, files())
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib/libmicroros.a").write_bytes(b"!<arch>")
    assert golden_differences(tmp_path, files()) == ()


def test_a_changed_file_is_a_unified_diff(tmp_path: Path) -> None:
    write_tree(tmp_path, files())
    (difference,) = golden_differences(tmp_path, files() | {"a.c": b"int b;\n"})
    assert difference == "--- golden/a.c\n+++ generated/a.c\n@@ -1 +1 @@\n-int a;\n+int b;\n"


def test_missing_and_surplus_files_are_reported(tmp_path: Path) -> None:
    write_tree(tmp_path, files(b_c="int b;\n"))
    missing, surplus = golden_differences(tmp_path, files(c_c="int c;\n"))
    assert missing.startswith("--- golden/b.c\n+++ /dev/null\n")
    assert surplus.startswith("--- /dev/null\n+++ generated/c.c\n")


def test_a_lost_line_end_shows(tmp_path: Path) -> None:
    write_tree(tmp_path, files())
    (difference,) = golden_differences(tmp_path, files() | {"a.c": b"int a;"})
    assert "\\ No newline at end of file" in difference


def test_a_missing_golden_folder_is_reported(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="Write it with --update"):
        golden_differences(tmp_path / "none", files())
