# SPDX-License-Identifier: Apache-2.0
"""`make misra FILES=…`, and what the addon is spared: configurations and headers that it has read."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import pytest

from tests.support.paths import ROOT
from tests.support.quality.corpus import Tree, Unit
from tests.support.quality.covering import known_headers
from tests.support.quality.misra_addon import leave_out, without_repetitions
from tests.support.quality.misra_files import pattern_of
from tests.tools.misra import check_files

COMPONENTS = ROOT / "microros_gen" / "components"


def configuration(name: str, address: str, macros: tuple[str, ...], token: str) -> str:
    token = f'<token id="{address}" str="{token}"/>'
    uses = "".join(f'<macro name="{macro}"/>\n' for macro in macros)
    return (
        f'<dump cfg="{name}">\n<macro-usage>\n{uses}</macro-usage>\n<tokenlist>\n{token}\n'
        f'</tokenlist>\n<variables><var id="{address}"/></variables>\n</dump>\n'
    )


def test_configurations_with_the_same_tokens_are_read_once() -> None:
    first = configuration("", "0x55a0c0ffee10", ("A", "B"), "int")
    again = configuration("A=0", "0x7f00c0ffee20", ("B", "A"), "int")
    other = configuration("B", "0x55a0c0ffee10", ("A", "B"), "long")
    assert (
        without_repetitions(f"<dumps>\n{first}{again}{other}</dumps>\n") == f"<dumps>\n{first}{other}</dumps>"
    )


def test_a_header_is_left_to_the_first_file_that_includes_it(tmp_path: Path) -> None:
    """Unless it has a condition and the plan is another one; what is read in every configuration reads them all."""
    for tree, plan in (("one", "1"), ("two", "2")):
        (tmp_path / tree / "include").mkdir(parents=True)
        texts = {"microros_config.h": plan, "same.h": "int a;\n", "other.h": "#if A > 0\nint b;\n#endif\n"}
        for name, text in texts.items():
            (tmp_path / tree / "include" / name).write_text(text)
        (tmp_path / tree / "a.c").write_text("#include <same.h>\n#include <other.h>\n")
    every = [
        Unit(Tree(tree, tmp_path / tree, ("a.c",)), "a.c", f"{number}", is_first)
        for number, (tree, is_first) in enumerate((("one", False), ("two", False), ("one", True)))
    ]
    assert known_headers(every) == [["include/other.h", "include/same.h"], ["include/same.h"], []]


@dataclass
class _Token:
    file: str


@dataclass
class _Configuration:
    tokenlist: list[_Token] = field(default_factory=list)


def test_the_rules_do_not_go_through_what_is_known() -> None:
    read = _Configuration([_Token("include/a.h"), _Token("src/a.c"), _Token("include/b.h")])
    leave_out(read, frozenset({"include/a.h"}))
    assert [token.file for token in read.tokenlist] == ["src/a.c", "include/b.h"]


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("microros_gen/components/read/src/xrce_read.c", "src/read/xrce_read.c"),
        ("microros_gen/components/session/src/xrce_routes.c.j2", "src/session/xrce_routes.c"),
        ("microros_gen/components/cdr/include/microros/cdr.h", "include/microros/cdr.h"),
        ("microros_gen/templates/types/storage.c.j2", "src/quality_msgs/tree__storage.c"),
    ],
)
def test_a_file_is_found_in_trees(path: str, name: str) -> None:
    assert (ROOT / path).is_file()
    assert pattern_of(ROOT / path).match(name)


def test_what_is_in_no_tree_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert check_files([ROOT / "README.md"], tmp_path, 1) == 2
    assert "neither below microros_gen/components" in capsys.readouterr().err
