# SPDX-License-Identifier: Apache-2.0
"""Proves the properties of a model, or shows what contradicts them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from microros_gen.application.find import read_application
from microros_gen.application.model import Application, NodeDecl
from microros_gen.application.parameter_find import with_parameter_files
from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics
from microros_gen.modes.behavior import settle_all
from microros_gen.modes.leaf_parameters import check_parameters
from microros_gen.modes.leaflets import parts_of
from microros_gen.modes.model import Model
from microros_gen.modes.properties import (
    check_commands,
    check_inference,
    check_start_orders,
)
from microros_gen.modes.reachability import check_reachable
from microros_gen.modes.reader import parse_model, read_source
from microros_gen.modes.report import Report
from microros_gen.modes.stability import MOST_COMBINATIONS, check_stability

_UNKNOWN_PART = "MG-8806"
"""A part that neither the model file nor an application file has."""


def check(path: Path, applications: Sequence[Path] = (), most: int = MOST_COMBINATIONS) -> Report:
    """Return what is proven of the model of a file, and everything that is wrong with it.

    `applications` are application files whose nodes declare the parameters that modes set; nodes with modes there are
    parts of the model, which need not repeat them. `most` bounds the different combinations of failures that are kept
    of a system; if they are more, its stability is not proven.
    """
    diagnostics = Diagnostics()
    source = read_source(path, diagnostics)
    declared = read_applications(applications, diagnostics)
    nodes = [node for application in declared for node in application.nodes]
    has_nodes = not diagnostics.has_errors()
    found = Diagnostics()
    model = (
        parse_model(source, found, parts_of(declared) if has_nodes else {}) if source is not None else None
    )
    if has_nodes or all(diagnostic.id != _UNKNOWN_PART for diagnostic in found):
        diagnostics.extend(found)  # otherwise the application files may have what is missing
    if model is None or diagnostics.has_errors():
        return Report(str(path), (), tuple(diagnostics))
    return check_model(model, nodes, most)


def check_model(model: Model, nodes: Sequence[NodeDecl] = (), most: int = MOST_COMBINATIONS) -> Report:
    """Return what is proven of a model; `nodes` are those of application files."""
    diagnostics = Diagnostics()
    settled = settle_all(model, most)
    properties = (
        check_parameters(model, nodes, diagnostics),
        check_start_orders(model),
        check_inference(model, diagnostics),
        check_reachable(model, settled, most, diagnostics),
        check_stability(model, settled, most, diagnostics),
        check_commands(model),
    )
    return Report(model.source.name, properties, tuple(diagnostics))


def read_applications(paths: Sequence[Path], diagnostics: Diagnostics) -> tuple[Application, ...]:
    """Return the applications of files with all parameters that their nodes declare; those with errors are left out."""
    found = []
    for path in paths:
        source = read_application(path, Path(), diagnostics)
        application = parse_application(source, diagnostics) if source is not None else None
        if application is not None:
            found.append(with_parameter_files(application, path.parent, diagnostics)[0])
    return tuple(found)
