# SPDX-License-Identifier: Apache-2.0
"""What a user is told: places in sources, diagnostics and their printed form."""

from microros_gen.diagnostics.diagnostic import (
    Diagnostic,
    Diagnostics,
    Severity,
    UserError,
    nearest,
    nearest_package,
)
from microros_gen.diagnostics.internal import TRACEBACK, internal_error, reads
from microros_gen.diagnostics.source import Source, Span

__all__ = [
    "TRACEBACK",
    "Diagnostic",
    "Diagnostics",
    "Severity",
    "Source",
    "Span",
    "UserError",
    "internal_error",
    "nearest",
    "nearest_package",
    "reads",
]
