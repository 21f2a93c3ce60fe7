# SPDX-License-Identifier: Apache-2.0
"""Functions of rmw_microros/init_options.h that components contribute: declared, or a name that says what to change."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable

from microros_gen.client.plan.values import Values
from microros_gen.records import dataclass
from microros_gen.selection.component import Component
from microros_gen.selection.contribution import InitOption

_WIDTH = 104
"""Characters of a line of a header."""


@dataclass(frozen=True)
class DeclaredOption:
    """A function that the library has; both are C text."""

    comment: str
    declaration: str


@dataclass(frozen=True)
class MissingOption:
    """A function that the library does not have, and why: the end of the name that a call gets instead."""

    function: str
    reason: str


@dataclass(frozen=True)
class InitOptions:
    """The functions of the header, each list in the order of their names."""

    declared: tuple[DeclaredOption, ...]
    missing: tuple[MissingOption, ...]


def init_options(
    selected: Iterable[Component], unselected: Iterable[Component], values: Values
) -> InitOptions:
    """Return the functions of the `selected` components; those of `unselected` ones are missing."""
    own = [option for component in selected for option in component.contributes.init_options]
    others = [option for component in unselected for option in component.contributes.init_options]
    missing = [MissingOption(o.function, o.unmet) for o in own if not values.holds(o.when)]
    missing += [MissingOption(o.function, o.absent) for o in others]
    declared = sorted((o for o in own if values.holds(o.when)), key=lambda o: o.function)
    return InitOptions(
        tuple(map(_declared, declared)), tuple(sorted(missing, key=lambda option: option.function))
    )


def _declared(option: InitOption) -> DeclaredOption:
    in_one_line = f"rmw_ret_t {option.function}({option.arguments});"
    in_two_lines = f"rmw_ret_t {option.function}(\n  {option.arguments});"
    return DeclaredOption(
        _comment(option.comment), in_one_line if len(in_one_line) <= _WIDTH else in_two_lines
    )


def _comment(text: str) -> str:
    """Return a comment of C: in one line, or in several."""
    if len(text) + len("/*  */") <= _WIDTH:
        return f"/* {text} */"
    lines = textwrap.wrap(text, _WIDTH - len(" * "))
    return "\n".join(("/*", *(f" * {line}" for line in lines), " */"))
