# SPDX-License-Identifier: Apache-2.0
"""Which of many values of a parameter `make test` tries; `make system` tries the others, too."""

from __future__ import annotations

from collections.abc import Collection, Iterable

import pytest
from _pytest.mark import ParameterSet


def first(values: Iterable[object], count: int = 1) -> list[object]:
    """Return parameters of a test: the first `count` values as they are, the others for `make system`."""
    return [
        value if number < count else pytest.param(value, marks=pytest.mark.system)
        for number, value in enumerate(values)
    ]


def only(chosen: Collection[str], names: Iterable[str]) -> list[str | ParameterSet]:
    """Return parameters of a test: the `chosen` names as they are, the others for `make system`."""
    return [name if name in chosen else pytest.param(name, marks=pytest.mark.system) for name in names]
