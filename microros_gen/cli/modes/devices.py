# SPDX-License-Identifier: Apache-2.0
"""A model with the nodes of application files: they have modes, and services for them on the device."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.modes.leaflets import parts_of
from microros_gen.modes.model import Model
from microros_gen.modes.reader import parse_model, read_source
from microros_gen.modes.verification import read_nodes


def read_system(path: Path, applications: Sequence[Path]) -> tuple[Model, frozenset[str]]:
    """Return the model of a file with the nodes of application files that have modes, and the names of these nodes.

    Raises UserError with all that is wrong with the files; the model is read only when the application files are right.
    """
    diagnostics = Diagnostics()
    source = read_source(path, diagnostics)
    nodes = [node for application in applications for node in read_nodes(application, diagnostics)]
    diagnostics.check()
    devices = parts_of(nodes)
    model = parse_model(source, diagnostics, devices) if source is not None else None
    diagnostics.check()
    assert model is not None
    return model, frozenset(devices)


def refuse_templates(model: Model, names: Iterable[str]) -> None:
    """Raise UserError for values of a parent in modes of nodes with mode services: they get the name of a mode."""
    found = [
        Diagnostic(
            f"'{name}' has mode services: the manager cannot give it '{parameter}' of its parent",
            value.span,
            "Write its value in each mode",
            id="MG-8880",
        )
        for name in sorted(names)
        for mode in model.parts[name].modes.values()
        for parameter, value in mode.parameters.items()
        if value.parent
    ]
    if found:
        raise UserError(_without_twins(found))


def _without_twins(found: Iterable[Diagnostic]) -> list[Diagnostic]:
    """Return each place once: modes inherit values of __DEFAULT__ with their places."""
    return list({d.span: d for d in found}.values())
