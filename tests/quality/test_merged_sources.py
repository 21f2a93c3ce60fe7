# SPDX-License-Identifier: Apache-2.0
"""Files that the tests compile as one translation unit: none changes what another means."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.support.runtime.harness import Tree, compile_units, link, quick
from tests.support.runtime.merged import merged, text_of


def files(folder: Path, *texts: str) -> list[Path]:
    paths = [folder / f"{number}.c" for number in range(len(texts))]
    for path, text in zip(paths, texts, strict=True):
        path.write_text(text, encoding="utf-8")
    return paths


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("static int count(void)\n{ return 1; }\n", "static int count(void)\n{ return 2; }\n"),
        ("static int count;\n", "int next(int count) { return count; }\n"),
        ("int next(int count) { return count; }\n", "static const int count[2] = {1, 2};\n"),
        ("#define COUNT 1\n", "int next(void) { return COUNT; }\n"),
        ("enum { FEW, MANY = 2 };\n", "int next(void) { return MANY; }\n"),
        ("typedef struct place {\n  int x;\n} place_t;\n", "place_t next(void);\n"),
        ("struct place {\n  int x;\n};\n", "struct place;\n"),
        ("typedef unsigned count_t;\n", "extern count_t next;\n"),
        ("#define _GNU_SOURCE\n", "int other;\n"),
        ("#pragma pack(1)\n", "int other;\n"),
        ("int other;\n", "#undef NULL\n"),
    ],
)
def test_what_a_file_declares_for_itself_is_no_word_of_another(
    tmp_path: Path, first: str, second: str
) -> None:
    paths = files(tmp_path, first, second)
    assert sorted(merged(paths)) == [(paths[0],), (paths[1],)]


def test_the_others_share_a_unit(tmp_path: Path) -> None:
    paths = files(
        tmp_path,
        "static int count(void)\n{ return 1; }\n",
        '/* count */ const char * other(void) { return "count"; }\n',
        "int count(void);\n",
        "int third;\n",
    )
    assert merged(paths) == ((paths[0], paths[1], paths[3]), (paths[2],))
    assert text_of(paths[:2]) == f'#include "{paths[0].resolve()}"\n#include "{paths[1].resolve()}"\n'


def test_a_source_that_another_includes_is_part_of_what_a_build_is_made_from(tmp_path: Path) -> None:
    """A unit that includes a source of a port was not compiled again when that changed."""
    tree = Tree(tmp_path / "tree", ())
    tree.include.mkdir(parents=True)
    unit = tmp_path / "unit.c"
    unit.write_text('#include "middle.c"\nint main(void) { return 5 - number; }\n')
    (tmp_path / "middle.c").write_text('#include "port.c" /* of the tree */\n')
    codes = []
    for number in (5, 2, 5):
        (tree.include / "port.c").write_text(f"static const int number = {number};\n")
        objects = compile_units(tree, [(unit,)], *quick())
        codes.append(subprocess.run([link(objects, *quick(), tmp_path / "unit")], check=False).returncode)
    assert codes == [0, 3, 0]
