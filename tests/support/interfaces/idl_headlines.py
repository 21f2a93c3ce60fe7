# SPDX-License-Identifier: Apache-2.0
"""What the reader of .idl files says of texts, as lines; run in two environments."""

from __future__ import annotations

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.interfaces.omg_idl.parser import parse_idl
from tests.support.ids import without_id


def headlines(texts: list[str]) -> list[str]:
    """Return for each text whether it is taken, and every diagnostic."""
    found = []
    for text in texts:
        diagnostics = Diagnostics()
        declarations = parse_idl(Source("Foo.idl", text), "pkg_a", "msg", diagnostics)
        found.append(f"{text!r} {len(declarations)}")
        found.extend(without_id(diagnostic.headline()) for diagnostic in diagnostics)
    return found
