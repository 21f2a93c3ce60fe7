# SPDX-License-Identifier: Apache-2.0
"""Times and choices of a mode manager."""

from __future__ import annotations

from microros_gen.mode_manager.reports import REPEAT_S
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Settings:
    """Times in seconds. `reconfigured` are nodes that take parameters only while they are inactive."""

    call_s: float = 5.0
    """A response that takes longer is late."""
    system_s: float = 60.0
    """A subsystem of another manager has its target by then."""
    attempts: int = 3
    """How often a command is sent before its part counts as failed, and how often in `window_s` a part that others
    reconfigured is commanded again."""
    pause_s: float = 0.5
    window_s: float = 10.0
    poll_s: float = 5.0
    """Parts are asked so often whether what is known of them is true."""
    grace_s: float = 1.0
    """Events of an own command arrive at most so much later than its response."""
    start_s: float = 5.0
    """Parts that are unknown after this time are absent."""
    adopt_s: float = 60.0
    """Parts may appear so long after the start, and the modes of their systems are taken over."""
    recover_s: float = 60.0
    """A system returns from a degraded mode at most `attempts` times in this time."""
    rest_s: float = 60.0
    """Rules that were applied before a system has rested for so long do not count as parts of an oscillation."""
    repeat_s: float = REPEAT_S
    """A status on /diagnostics is repeated within this time."""
    reconfigured: frozenset[str] = frozenset()
