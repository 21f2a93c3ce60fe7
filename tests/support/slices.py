# SPDX-License-Identifier: Apache-2.0
"""Which of many values of a parameter `make test` tries; `make system` tries the others, too."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

import pytest
from _pytest.mark import ParameterSet


def first(values: Iterable[object], count: int = 1) -> list[object]:
    """Return parameters of a test: the first `count` values as they are, the others for `make system`."""
    return [value if number < count else _later(value) for number, value in enumerate(values)]


def spread(values: Iterable[object], every: int = 4) -> list[object]:
    """Return parameters of a test: one of `every` values as it is, the others for `make system`."""
    return [_later(value) if number % every else value for number, value in enumerate(values)]


def spread_rows(rows: Iterable[tuple[object, ...]], every: int = 4) -> list[object]:
    """Return the same for a test of several parameters."""
    return [_later(*row) if number % every else row for number, row in enumerate(rows)]


def only(chosen: Collection[str], names: Iterable[str]) -> list[str | ParameterSet]:
    """Return parameters of a test: the `chosen` names as they are, the others for `make system`."""
    return [name if name in chosen else pytest.param(name, marks=pytest.mark.variant) for name in names]


def _later(*values: object) -> ParameterSet:
    return pytest.param(*values, marks=pytest.mark.variant)


def beyond(
    values: Mapping[str, object] | Collection[str], long: Collection[str], later: Collection[str] = ()
) -> list[ParameterSet]:
    """Return names, or rows of name and value: those of `long` for long runs, as what differs little from others.

    Those of `later` are for `make system`.
    """

    def marks(name: object) -> list[pytest.MarkDecorator]:
        return [pytest.mark.long] if name in long else [pytest.mark.variant] if name in later else []

    rows = values.items() if isinstance(values, Mapping) else [(name,) for name in values]
    return [pytest.param(*row, marks=marks(row[0]), id=row[0]) for row in rows]
