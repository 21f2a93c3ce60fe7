# SPDX-License-Identifier: Apache-2.0
"""Log lines of a board that an emulator has: it prints them, where the target file says nothing of standard output."""

from __future__ import annotations

from dataclasses import replace

from microros_gen.platform.target import Stdio, Target
from microros_gen.selection.model import Selection

_SEMIHOSTING = ("-semihosting-config", "enable=on,target=native")
"""QEMU accepts requests of the image to its debugger, and has the text on its standard error."""
_OTHERS = frozenset({"console", "console_send", "stdio_put"})
"""What an application may provide for the console instead."""


def with_emulated_console(target: Target, selection: Selection, prints: bool = False) -> Target:
    """Return a target whose emulator prints the lines of the console, where one is asked for and nothing else does.

    `prints`: something else than the selected components prints to standard output.
    """
    requested = (ask.capability for chosen in selection.components for ask in chosen.component.asks)
    if "console" not in requested and not prints:
        return target
    if target.emulator is None or target.stdio is not None or _OTHERS & set(target.provides):
        return target
    emulator = replace(target.emulator, arguments=(*target.emulator.arguments, *_SEMIHOSTING))
    return replace(target, emulator=emulator, stdio=Stdio("semihosting"))
