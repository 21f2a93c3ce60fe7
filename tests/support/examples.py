# SPDX-License-Identifier: Apache-2.0
"""How many examples a test draws: a fifth in `make test`, fewer in `make quick`, all of them in `make system`.

For tests that Hypothesis draws for, and those with the marker `examples`.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TypeVar

Item = TypeVar("Item")

EXAMPLES = "MICROROS_TEST_EXAMPLES"
"""`all`: each test draws the examples that it names, as in `make system`; `few`: a thirtieth, as in `make quick`."""
LEAST, LEAST_FEW = 25, 5


def examples(full: int, least: int | None = None, part: int = 5) -> int:
    """Return how many examples a test draws that names `full` of them; never fewer than `least` where it names some.

    `part`: what `make test` draws is one of so many; more than 5 for examples that take seconds.
    """
    wanted = os.environ.get(EXAMPLES)
    if wanted == "all":
        return full
    share, smallest = (full // 30, LEAST_FEW) if wanted == "few" else (full // part, LEAST)
    return min(full, max(smallest if least is None else least, share))


def some(items: Sequence[Item], every: int = 4) -> Sequence[Item]:
    """Return one of `every` items, the first included; all of them where a test draws all examples."""
    return items if draws_all() else items[::every]


def draws_all() -> bool:
    """Return whether a test draws all examples, as in `make system`."""
    return os.environ.get(EXAMPLES) == "all"
