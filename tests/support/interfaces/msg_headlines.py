# SPDX-License-Identifier: Apache-2.0
"""What the reader of .msg files says of texts, as lines; run in two environments."""

from __future__ import annotations

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.interfaces.msg.parser import parse_msg
from microros_gen.interfaces.types import TypeName
from tests.support.ids import without_id


def headlines(texts: list[str]) -> list[str]:
    """Return for each text whether it is taken, and every diagnostic."""
    found = []
    for text in texts:
        diagnostics = Diagnostics()
        message = parse_msg(Source("Foo.msg", text), TypeName("pkg_a", "msg", "Foo"), diagnostics)
        found.append(f"{text!r} {message is not None}")
        found.extend(without_id(diagnostic.headline()) for diagnostic in diagnostics)
    return found
