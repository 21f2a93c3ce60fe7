# SPDX-License-Identifier: Apache-2.0
"""Reads the parameter files that the nodes of an application name, and checks modes by what the nodes then declare."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from microros_gen.application.model import Application, NodeDecl
from microros_gen.application.modes import check_modes
from microros_gen.application.nodes import with_declarations
from microros_gen.application.parameter_file import parse_parameter_file
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.files import read_text, reason_of


def parameter_paths(application: Application, near: Path) -> Iterator[Path]:
    """Yield the parameter files of the nodes; `near` is the folder of the application file."""
    for node in application.nodes:
        if node.parameter_file is not None:
            yield near / node.parameter_file.name


def with_parameter_files(
    application: Application, near: Path, diagnostics: Diagnostics
) -> tuple[Application, tuple[Source, ...]]:
    """Return the application with what its parameter files declare, and these files as they were read.

    Values in modes that a parameter does not accept are errors at their places.
    """
    read = [(node, _source(node, near, diagnostics)) for node in application.nodes]
    nodes = tuple(_with_file(node, source, diagnostics) for node, source in read)
    for node, (_, source) in zip(nodes, read, strict=True):
        if source is not None or node.parameter_file is None:
            check_modes(node, diagnostics)
    return replace(application, nodes=nodes), tuple(source for _, source in read if source is not None)


def _with_file(node: NodeDecl, source: Source | None, diagnostics: Diagnostics) -> NodeDecl:
    if source is None:
        return node
    return with_declarations(node, parse_parameter_file(source, diagnostics), diagnostics)


def _source(node: NodeDecl, near: Path, diagnostics: Diagnostics) -> Source | None:
    """Read the file that a node names; None where it names none, or it cannot be read."""
    if node.parameter_file is None:
        return None
    path = near / node.parameter_file.name
    try:
        return Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        message = f"cannot read the parameter file '{path}': {reason_of(error)}"
        hint = "Its path is relative to the folder of this file"
        diagnostics.error(message, node.parameter_file.span, hint, id="MG-3073")
        return None
