# SPDX-License-Identifier: Apache-2.0
"""The level of /rosout, the bytes of lines that wait to be sent, and what a line of it has room for."""

from __future__ import annotations

from microros_gen.application.log_decl import LogWriter
from microros_gen.application.model import Application, LimitRule
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.components.logging.plan import level_number, name_size, writer_of
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

TYPE = TypeName("rcl_interfaces", "msg", "Log")
SIZE = 1024
"""Bytes of the lines that wait where the application file gives no `size`."""
_HEADER = 2
"""Bytes in front of a line that waits: its size."""
_TEXTS = {"name": 32, "msg": 128, "file": 48, "function": 32}
"""Bytes of the texts of a line where the application has no limits for them."""


@dataclass(frozen=True, kw_only=True)
class RosoutPlan:
    """Sizes are bytes; those of texts without the NUL."""

    level: int
    size: int
    name: int
    text: int
    file: int
    function: int


def plan(context: PlanContext, diagnostics: Diagnostics) -> RosoutPlan:
    """Return the sizes; at least one line has room."""
    writer = writer_of(context.application, "rosout") or LogWriter("rosout")
    refuse_own_limits(context, "logging_rosout", diagnostics)
    planned = context.types[TYPE]
    fields = planned.limits.fields if planned.limits is not None else ()
    bounds = {
        member.name: bound.string or 0
        for member, bound in zip(planned.message.fields, fields, strict=True)
        if bound is not None
    }
    size = SIZE if writer.size is None else writer.size
    least = _HEADER + planned.max_encoded_size
    if size < least:
        diagnostics.error(
            f"the log writer 'rosout' has room for {size} bytes, and a line takes up to {least}",
            writer.span,
            f"Write `size: {least}` or more, or lower the limits of rcl_interfaces/msg/Log",
            id="MG-7041",
        )
    return RosoutPlan(
        level=level_number(writer),
        size=max(size, least),
        name=bounds["name"],
        text=bounds["msg"],
        file=bounds["file"],
        function=bounds["function"],
    )


def record(part: RosoutPlan) -> object:
    """Return what the plan id is made of."""
    return [part.level, part.size, part.name, part.text, part.file, part.function]


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the bounds of the texts of a line."""
    configured = {rule.path for rule in application.limits}
    if (str(TYPE),) in configured:
        return ()
    texts = {**_TEXTS, "name": max(_TEXTS["name"], name_size(application) - 1)}
    rules = (LimitRule((str(TYPE), member), bound, None) for member, bound in texts.items())
    return tuple(rule for rule in rules if rule.path not in configured)
