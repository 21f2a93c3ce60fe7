# SPDX-License-Identifier: Apache-2.0
"""How many loggers one request has, and the bounds of its texts."""

from __future__ import annotations

from microros_gen.application.model import Application, LimitRule
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.components.logging.plan import LOGGERS, loggers, name_size
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

REASON_SIZE = 64
"""Bytes of the reason for a level that was not set, with its NUL."""


@dataclass(frozen=True, kw_only=True)
class LoggerServicesPlan:
    """`most` loggers of a request; the reason's size is bytes."""

    most: int = LOGGERS
    reason_size: int = REASON_SIZE


def plan(context: PlanContext, diagnostics: Diagnostics) -> LoggerServicesPlan:
    """Return the sizes: as many as can have a level, or what the application's limits say."""
    refuse_own_limits(context, "logger_services", diagnostics)
    lists = [context.types[TypeName(_PACKAGE, "srv", name)].limits for name in _REQUESTS]
    found = [
        field.sequence or 0
        for part in lists
        if part is not None
        for field in part.fields
        if field is not None
    ]
    return LoggerServicesPlan(most=max(found))


def record(part: LoggerServicesPlan) -> object:
    """Return what the plan id is made of."""
    return [part.most, part.reason_size]


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the bounds of requests and responses."""
    size, most = name_size(application), loggers(application)
    rules = (
        _rule("srv/GetLoggerLevels_Request", "names", size - 1, most),
        _rule("srv/GetLoggerLevels_Response", "levels", None, most),
        _rule("srv/SetLoggerLevels_Request", "levels", None, most),
        _rule("srv/SetLoggerLevels_Response", "results", None, most),
        _rule("msg/LoggerLevel", "name", size - 1),
        _rule("msg/SetLoggerLevelsResult", "reason", REASON_SIZE - 1),
    )
    configured = {rule.path for rule in application.limits}
    return tuple(rule for rule in rules if rule.path not in configured)


_PACKAGE = "rcl_interfaces"
_REQUESTS = ("GetLoggerLevels_Request", "SetLoggerLevels_Request")


def _rule(name: str, member: str, string: int | None, sequence: int | None = None) -> LimitRule:
    return LimitRule((f"{_PACKAGE}/{name}", member), string, sequence)
