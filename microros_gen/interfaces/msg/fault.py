# SPDX-License-Identifier: Apache-2.0
"""Faults of names and values, before the reader of a file knows their place."""

from __future__ import annotations

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Fault:
    """An error of a name or value: message, hint and id of its diagnostic."""

    message: str
    hint: str | None
    id: str


@dataclass(frozen=True)
class Caveat:
    """A warning about a name or value: message, hint and id of its diagnostic."""

    message: str
    hint: str
    id: str
