# SPDX-License-Identifier: Apache-2.0
"""The ring in which lines of the console wait for an interrupt of their UART, on boards without an operating system."""

from __future__ import annotations

from microros_gen.application.model import Application
from microros_gen.platform.target import Target

DEFAULT_SIZE = 512
"""Bytes of the ring where the application file gives no `size`."""
_WRITER = "console"


def console_size(application: Application, target: Target) -> int:
    """Return the bytes of the ring; 0: lines do not wait in one."""
    if not target.sends_console:
        return 0
    sizes = (writer.size for writer in application.logging if writer.to == _WRITER)
    size = next(sizes, None)
    return DEFAULT_SIZE if size is None else max(size, 1)


def console_waits(target: Target) -> bool:
    """Whether a line of the console waits until the platform has taken each byte."""
    if target.hosted or target.sends_console or _WRITER in target.own_capabilities:
        return False
    provisions = (p for part in target.parts for p in part.component.provides if p.capability == _WRITER)
    provision = next(provisions, None)
    return provision is not None and any(ask.capability == "stdio_put" for ask in provision.asks)
