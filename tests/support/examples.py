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


def examples(full: int, least: int = LEAST) -> int:
    """Return how many examples a test draws that names `full` of them, at least `least` where it names as many."""
    wanted = os.environ.get(EXAMPLES)
    if wanted == "all":
        return full
    return min(full, max(least, full // 5)) if wanted != "few" else min(full, max(LEAST_FEW, full // 30))


def some(items: Sequence[Item], every: int = 4) -> Sequence[Item]:
    """Return one of `every` items, the first included; all of them where a test draws all examples."""
    return items if os.environ.get(EXAMPLES) == "all" else items[::every]
