# SPDX-License-Identifier: Apache-2.0
"""A mode of a node as the application file declares it."""

from __future__ import annotations

from microros_gen.diagnostics import Span
from microros_gen.records import dataclass

DEFAULT_MODE = "__DEFAULT__"
"""The mode in which a node begins; every other mode inherits from it."""

Value = bool | int | float | str | tuple[bool | int | float | str, ...]


@dataclass(frozen=True)
class ModeValue:
    """A parameter in a mode. `parent` is not empty: the system that the node is in gives the value, which is None."""

    parameter: str
    value: Value | None
    span: Span
    name_span: Span
    parent: str = ""


@dataclass(frozen=True)
class ModeDecl:
    """A mode with what it says itself; what it inherits is not among `values`."""

    name: str
    values: tuple[ModeValue, ...] = ()
    span: Span | None = None

    def value(self, parameter: str) -> ModeValue | None:
        """Return what it says of a parameter; None: nothing."""
        return next((value for value in self.values if value.parameter == parameter), None)
