# SPDX-License-Identifier: Apache-2.0
"""Where log messages go, as the application file declares it below `logging:`."""

from __future__ import annotations

from microros_gen.diagnostics import Span
from microros_gen.records import dataclass

LOG_LEVELS = ("debug", "info", "warn", "error", "fatal")
BUFFERED_LOG_WRITERS = ("rosout", "ring", "console")
"""Writers that keep lines."""


@dataclass(frozen=True)
class LogWriter:
    """Where log messages of `level` and above go: `to` is console, callback, rosout or ring.

    `size`: bytes of the lines that a writer keeps; None: the usual ones.
    """

    to: str
    level: str = "info"
    size: int | None = None
    span: Span | None = None
