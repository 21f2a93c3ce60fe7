# SPDX-License-Identifier: Apache-2.0
"""docs/explanation/typesupport.md: every line of its tables on types holds, and what it names is there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from microros_gen.application.model import LimitRule
from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.interfaces.msg.parser import parse_msg
from microros_gen.interfaces.omg_idl.parser import parse_idl
from microros_gen.interfaces.types import Message, Primitive, StringType, TypeName
from microros_gen.typesupport.plan.size import WireSizes
from microros_gen.typesupport.plan.types import LARGEST_BODY
from microros_gen.typesupport.views.struct import declaration
from tests.support.ids import without_id
from tests.support.typesupport.build import COMPONENTS, generate

pytestmark = pytest.mark.builds

ROOT = COMPONENTS.parents[1]
PAGE = (ROOT / "docs" / "explanation" / "typesupport.md").read_text(encoding="utf-8")
NAME = TypeName("pkg", "msg", "Type")


def table(heading: str, column: str) -> list[list[str]]:
    """Return the rows of the table below `heading` whose first column is `column`."""
    lines = PAGE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0].splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith(f"| {column} |")) + 2
    rows = []
    for line in lines[start:]:
        if not line.startswith("|"):
            break
        rows.append([cell.strip() for cell in line.strip("|").split("|")])
    return rows


TYPES = table("Interface type → C → wire", ".msg, .srv, .action")


def read(written: str, idl: bool) -> Message:
    diagnostics = Diagnostics()
    if idl:
        text = f"module pkg {{ module msg {{ struct Type {{ {written} a; }}; }}; }};"
        (found,) = parse_idl(Source("Type.idl", text), "pkg", "msg", diagnostics)
    else:
        read_msg = parse_msg(Source("Type.msg", f"{written} a"), NAME, diagnostics)
        assert read_msg is not None
        found = read_msg
    assert isinstance(found, Message)
    return found


@pytest.mark.parametrize("row", TYPES, ids=lambda row: " ".join(row[:2]))
def test_each_type_is_the_one_in_c_and_on_the_wire(row: list[str]) -> None:
    msg, idl, c_type, wire = row
    for written, is_idl in ((msg, False), (idl, True)):
        if not written:
            continue
        (field,) = read(written.strip("`"), is_idl).fields
        assert f"`{declaration(field).removesuffix(' a')}`" == c_type
        if isinstance(field.type, (Primitive, StringType)):
            message = Message(NAME, (field,))
            size = WireSizes({NAME: message}).smallest(NAME)
            nul = 1 if wire.endswith("; a NUL") else 0
            assert size == int(re.match(r"\d+", wire).group()) + nul  # type: ignore[union-attr]


def test_every_type_has_a_line() -> None:
    written = {cell.strip("`") for row in TYPES for cell in row[:2]}
    assert {p.value for p in Primitive if p.in_msg} <= written
    read_as = {read(row[1].strip("`"), True).fields[0].type for row in TYPES if row[1]}
    assert set(Primitive) - read_as == {Primitive.CHAR, Primitive.LONG_DOUBLE}


def test_what_the_page_names_exists() -> None:
    """Files of the repository, functions and macros of the C."""
    for path in re.findall(r"`((?:plan|model|templates|components|tests)/[\w/.]+)`", PAGE):
        assert (ROOT / path).exists() or (ROOT / "microros_gen" / path).exists(), path
    headers = "".join(p.read_text() for p in sorted((ROOT / "microros_gen").rglob("*.[hj]*")) if p.is_file())
    for name in set(re.findall(r"`(CDR_\w+|MICROROS_\w+|cdr_\w+|rmw_\w+)`", PAGE)):
        assert re.search(rf"\b{name}\b", headers), name
    assert f"{LARGEST_BODY:,} bytes" in PAGE


@pytest.mark.parametrize(
    ("member", "rule", "expected"),
    [
        ("string<=3 a", LimitRule(("a/msg/A", "a"), string=4), "above its bound 3"),
        ("int8[<=3] a", LimitRule(("a/msg/A", "a"), sequence=4), "above its bound 3"),
        ("string a 'four'", LimitRule(("*",), string=3), "needs a string limit of 4"),
        ("int8[] a [1, 2]", LimitRule(("*",), sequence=1), "needs a sequence limit of 2"),
        ("float64[] a", LimitRule(("*",), sequence=2**28), "a message has at most 2147483632 bytes"),
    ],
)
def test_the_generator_refuses_limits_that_cannot_be(
    member: str, rule: LimitRule, expected: str, tmp_path: Path
) -> None:
    (tmp_path / "a/msg").mkdir(parents=True)
    (tmp_path / "a/msg/A.msg").write_text(f"{member}\n")
    with pytest.raises(UserError) as raised:
        generate(["a"], (rule,), tmp_path / "out", [tmp_path])
    assert any(expected in str(without_id(d.headline())) for d in raised.value.diagnostics)
