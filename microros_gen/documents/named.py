# SPDX-License-Identifier: Apache-2.0
"""Names that a user wrote, with their places and what can be wrong with them."""

from __future__ import annotations

from microros_gen.diagnostics import Span
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Named:
    """A name that the user wrote, and where."""

    name: str
    span: Span | None = None


@dataclass(frozen=True)
class NameFault:
    """What is wrong with a name, at which character (from 0), and what to do."""

    message: str
    index: int
    hint: str
    id: str
