# SPDX-License-Identifier: Apache-2.0
"""The level of the lines that survive a reset, and the bytes that they take."""

from __future__ import annotations

from microros_gen.application.log_decl import LogWriter
from microros_gen.client.plan.features import PlanContext
from microros_gen.components.logging.plan import level_number, writer_of
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

SIZE = 1024
"""Bytes of the lines where the application file gives no `size`."""
LARGEST = 32768
"""Bytes: a place and a number of bytes share a word of 32 bits."""
_HEADER = 4
"""Bytes in front of a line: its size and its checksum."""


@dataclass(frozen=True, kw_only=True)
class RingPlan:
    """`size`: bytes of the lines with their headers."""

    level: int
    size: int


def plan(context: PlanContext, diagnostics: Diagnostics) -> RingPlan:
    """Return the size; at least one line has room."""
    writer = writer_of(context.application, "ring") or LogWriter("ring")
    least = _HEADER + context.types[TypeName("rcl_interfaces", "msg", "Log")].max_encoded_size
    size = max(SIZE, least) if writer.size is None else writer.size
    if not least <= size <= LARGEST:
        diagnostics.error(
            f"the log writer 'ring' has {size} bytes; 'size' must be {least} (the largest line) to {LARGEST}",
            writer.span,
            f"Write `size: {max(SIZE, least)}`, or lower the limits of rcl_interfaces/msg/Log",
            id="MG-7042",
        )
    if context.target.ram is None:
        diagnostics.warning(
            f"lines of the log writer 'ring' are lost at a reset: {context.target.name} has no linker script"
            " of the tool",
            writer.span,
            "Link .bss.microros_log_kept to memory that start-up code does not clear, or remove `ring`",
            id="MG-7043",
        )
    return RingPlan(level=level_number(writer), size=size)


def record(part: RingPlan) -> object:
    """Return what the plan id is made of."""
    return [part.level, part.size]
