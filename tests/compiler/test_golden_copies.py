# SPDX-License-Identifier: Apache-2.0
"""What is generated for the applications of tests/golden is what their golden copies hold.

After an intended change: `make golden`, and read the difference before it is committed.
"""

from __future__ import annotations

import difflib
import shutil
from pathlib import Path

import pytest

from tests.support.golden import GOLDEN, HASHES, Copies, applications, held_files, make_copies
from tests.support.paths import TESTS

MOST_FILES = 400
"""In all folders of golden copies: a change of one component should be a difference that somebody reads."""


@pytest.fixture(scope="module")
def copies() -> Copies:
    return make_copies()


def difference(name: str, held: bytes | None, rendered: bytes | None) -> str:
    """Return a unified diff; empty: they are the same."""
    old, new = (
        (content or b"").decode("utf-8", "replace").splitlines(keepends=True) for content in (held, rendered)
    )
    return "".join(difflib.unified_diff(old, new, f"golden/{name}", f"generated/{name}"))


@pytest.mark.parametrize("application", applications())
def test_what_is_rendered_is_what_the_golden_copy_holds(application: str, copies: Copies) -> None:
    held, prefix = held_files(), f"{application}/"
    names = sorted(name for name in held.keys() | copies.files if name.startswith(prefix))
    assert names, "nothing is rendered for this application alone: it shows nothing"
    assert "".join(difference(name, held.get(name), copies.files.get(name)) for name in names) == ""


def test_what_is_copied_has_the_recorded_hashes(copies: Copies) -> None:
    assert difference(HASHES, held_files().get(HASHES), copies.files[HASHES]) == ""


def test_no_folder_is_left_of_an_application_that_is_gone() -> None:
    assert {path.name for path in GOLDEN.iterdir() if path.is_dir()} == set(applications())


def test_golden_copies_stay_few() -> None:
    files = [path for path in TESTS.rglob("golden/**/*") if path.is_file()]
    assert len(files) <= MOST_FILES


def test_a_change_of_a_rendered_and_of_a_copied_file_is_seen(copies: Copies, tmp_path: Path) -> None:
    folder = tmp_path / "golden"
    folder.mkdir()
    for path in GOLDEN.glob("*.yaml"):
        shutil.copy(path, folder)
    assert copies.write(folder) == len(copies.files)
    assert copies.write(folder) == 0
    for name, content in copies.files.items():
        changed = content.replace(b"bool", b"int", 1) if name != HASHES else content.replace(b"a", b"b", 1)
        (folder / name).write_bytes(changed)
    (folder / "sender" / "surplus.c").write_text("int surplus;\n")
    assert any(difference(n, held_files(folder)[n], copies.files[n]) for n in copies.files if n != HASHES)
    assert difference(HASHES, held_files(folder)[HASHES], copies.files[HASHES])
    assert copies.write(folder) > 1
    assert held_files(folder) == dict(copies.files)
