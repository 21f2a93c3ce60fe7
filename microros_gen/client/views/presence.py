# SPDX-License-Identifier: Apache-2.0
"""What the selected components say of themselves in the manifest, in `build` and in `resolve`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from microros_gen.client.plan.project import Project
from microros_gen.client.plan.values import Values


def manifest_entries(project: Project) -> dict[str, Any]:
    """Return `values` and `size` of each component that has any, by its name: plain data for JSON."""
    values = project.values
    found: dict[str, Any] = {}
    for chosen in project.selection.components:
        presence = chosen.component.presence
        entries = {e.name: _entry(e.value, values) for e in presence.manifest if values.holds(e.when)}
        uses = {u.variable: values.text(u.use) for u in presence.memory if values.holds(u.when)}
        own = {**({"values": entries} if entries else {}), **({"size": uses} if uses else {})}
        if own:
            found[chosen.component.name] = own
    return found


def report_rows(project: Project) -> Iterator[tuple[str, str, str]]:
    """Yield name, value and reason of each line that `build` and `resolve` print for a component."""
    values = project.values
    for chosen in project.selection.components:
        for row in chosen.component.presence.reports:
            if values.holds(row.when):
                yield row.name, values.text(row.value), values.text(row.why)


def _entry(value: int | str, values: Values) -> object:
    return _plain(values.value(value)) if isinstance(value, str) else value


def _plain(value: object) -> object:
    """Return a value of the plan as JSON has it: data classes as mappings, anything else but numbers as text."""
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: _plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, dict):
        return {str(name): _plain(part) for name, part in value.items()}
    if isinstance(value, (tuple, list)):
        return [_plain(part) for part in value]
    return value if value is None or isinstance(value, (bool, int, float)) else str(value)
