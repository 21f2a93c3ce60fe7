# SPDX-License-Identifier: Apache-2.0
"""What a check found: the properties with their results, and the diagnostics; as text and as data for JSON."""

from __future__ import annotations

from typing import Any

from microros_gen.diagnostics import Diagnostic, Severity
from microros_gen.diagnostics.data import diagnostic_data
from microros_gen.records import dataclass

PROVEN, REFUTED, OPEN = "proven", "refuted", "not proven"
_STATUS = {PROVEN: 0, OPEN: 1, REFUTED: 2}


@dataclass(frozen=True)
class Property:
    """A property of a model: its name, proven, refuted or not proven, and what was examined."""

    name: str
    result: str
    detail: str = ""


@dataclass(frozen=True)
class Report:
    """The result of a check of the file `model`; without properties where the file cannot be read as a model."""

    model: str
    properties: tuple[Property, ...]
    diagnostics: tuple[Diagnostic, ...]

    @property
    def result(self) -> str:
        """Return refuted when anything is wrong, not proven when something stayed open, else proven."""
        if any(d.severity is Severity.ERROR for d in self.diagnostics):
            return REFUTED
        return OPEN if any(p.result == OPEN for p in self.properties) else PROVEN

    @property
    def exit_status(self) -> int:
        """Return 0 proven, 1 not proven, 2 refuted."""
        return _STATUS[self.result]

    def text(self) -> str:
        """Return a line for each property."""
        width = max((len(p.name) for p in self.properties), default=0)
        lines = [f"{p.name:<{width}}  {p.result:<10}  {p.detail}".rstrip() for p in self.properties]
        return "".join(f"{line}\n" for line in lines)

    def data(self) -> dict[str, Any]:
        """Return the report as data for JSON."""
        return {
            "version": 1,
            "model": self.model,
            "result": self.result,
            "properties": [{"name": p.name, "result": p.result, "detail": p.detail} for p in self.properties],
            "findings": [finding_data(d) for d in self.diagnostics],
        }


def finding_data(diagnostic: Diagnostic) -> dict[str, Any]:
    """Return a diagnostic as data for JSON; `trace` has the lines of its counterexample."""
    return {**diagnostic_data(diagnostic), "trace": [line.strip() for line in diagnostic.block]}
