# SPDX-License-Identifier: Apache-2.0
"""Whether quick_calls.c was compiled with the core. Where it was not, its users do the same in Python."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType
from typing import Final

quick: ModuleType | None
try:
    from microros_gen.agent import quick_calls
except ImportError:
    quick = None
else:
    quick = quick_calls

quick_receive: Final[Callable[[int], bytes | None] | None] = None if quick is None else quick.receive
"""Function that returns the next datagram of a socket (its descriptor); None without one. Raises OSError."""
