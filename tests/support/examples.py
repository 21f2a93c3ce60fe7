# SPDX-License-Identifier: Apache-2.0
"""How many examples Hypothesis draws: a fifth in `make test`, all of them in `make system`."""

from __future__ import annotations

import os

EXAMPLES = "MICROROS_TEST_EXAMPLES"
"""`all`: each test draws the examples that it names, as in `make system`."""
LEAST = 25


def examples(full: int) -> int:
    """Return how many examples a test draws that names `full` of them."""
    if os.environ.get(EXAMPLES) == "all":
        return full
    return min(full, max(LEAST, full // 5))
