# SPDX-License-Identifier: Apache-2.0
"""A model with the nodes of application files: they have modes, and services for them on the device."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from microros_gen.diagnostics import Diagnostics
from microros_gen.modes.leaflets import parts_of
from microros_gen.modes.model import Model
from microros_gen.modes.reader import parse_model, read_source
from microros_gen.modes.verification import read_applications


def read_system(path: Path, applications: Sequence[Path]) -> tuple[Model, frozenset[str]]:
    """Return the model of a file with the nodes of application files that have modes, and the names of these nodes.

    Raises UserError with all that is wrong with the files; the model is read only when the application files are right.
    """
    diagnostics = Diagnostics()
    source = read_source(path, diagnostics)
    declared = read_applications(applications, diagnostics)
    diagnostics.check()
    devices = parts_of(declared)
    model = parse_model(source, diagnostics, devices) if source is not None else None
    diagnostics.check()
    assert model is not None
    return model, frozenset(devices)
