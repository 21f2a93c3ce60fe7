# SPDX-License-Identifier: Apache-2.0
"""Where the application file is looked for."""

from __future__ import annotations

from pathlib import Path

from microros_gen.application.find import read_application
from microros_gen.diagnostics import Diagnostics
from tests.support.ids import without_id


def test_the_file_of_the_folder_is_taken_where_there_is_one(tmp_path: Path) -> None:
    found_diagnostics = Diagnostics()
    assert read_application(None, tmp_path, found_diagnostics) is None
    (tmp_path / "microros.yaml").write_text("version: 1\n")
    source = read_application(None, tmp_path, found_diagnostics)
    assert source is not None
    assert (source.name, source.text) == ("microros.yaml", "version: 1\n")
    assert list(found_diagnostics) == []


def test_a_named_file_is_named_as_the_user_wrote_it(tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text("version: 1\n")
    source = read_application(path, tmp_path / "elsewhere", Diagnostics())
    assert source is not None
    assert source.name == str(path)


def test_unreadable_files_are_reported(tmp_path: Path) -> None:
    (tmp_path / "bad.yaml").write_bytes(b"a: \xff\n")
    for name, reason in (
        ("none.yaml", "No such file"),
        ("bad.yaml", "it is not UTF-8 text. Save it as UTF-8"),
    ):
        found_diagnostics = Diagnostics()
        assert read_application(tmp_path / name, tmp_path, found_diagnostics) is None
        (line,) = [without_id(d.headline()) for d in found_diagnostics]
        assert line.startswith("microros-gen: error: cannot read the application file")
        assert reason in line
