# SPDX-License-Identifier: Apache-2.0
"""What does not change is read once in a process of the tests: the files of components."""

from __future__ import annotations

from collections.abc import Callable

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.selection import find_components
from microros_gen.selection.component import Component
from microros_gen.selection.component_file import parse_component

Parse = Callable[[Source, Diagnostics], Component | None]


def once(parse: Parse) -> Parse:
    """Return `parse` with the components kept by name and content of their files, unless it had something to report."""
    kept: dict[Source, Component] = {}

    def parse_once(source: Source, diagnostics: Diagnostics, /) -> Component | None:
        if source in kept and not diagnostics.has_errors():
            return kept[source]
        before = len(list(diagnostics))
        component = parse(source, diagnostics)
        if component is not None and len(list(diagnostics)) == before:
            kept[source] = component
        return component

    return parse_once


def share_components() -> None:
    """Let each command that a test runs in this process find the components that another one has read.

    The catalogue takes half of the time of a small `generate`, and the suite runs some thousand of them.
    """
    vars(find_components)[parse_component.__name__] = once(parse_component)
