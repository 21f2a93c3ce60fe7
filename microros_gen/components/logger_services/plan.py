# SPDX-License-Identifier: Apache-2.0
"""How many loggers one request has, and the bounds of its texts."""

from __future__ import annotations

from microros_gen.application.model import Application, LimitRule
from microros_gen.client.plan.features import Given, refuse_own_limits
from microros_gen.components.logging.plan import LOGGERS, NAME_SIZE
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

REASON_SIZE = 64
"""Bytes of the reason for a level that was not set, with its NUL."""


@dataclass(frozen=True, kw_only=True)
class LoggerServicesPlan:
    """`most` loggers of a request; the reason's size is bytes."""

    most: int = LOGGERS
    reason_size: int = REASON_SIZE


def plan(given: Given, diagnostics: Diagnostics) -> LoggerServicesPlan:
    """Return the sizes: as many as can have a level."""
    refuse_own_limits(given, "logger_services", diagnostics)
    return LoggerServicesPlan()


def record(part: LoggerServicesPlan) -> object:
    """Return what the plan id is made of."""
    return [part.most, part.reason_size]


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the bounds of requests and responses; those of the application would not fit the library's memory."""
    return (
        *(_rule(f"srv/{name}", part) for name, part in _LISTS),
        LimitRule(("rcl_interfaces/srv/GetLoggerLevels_Request", "names"), NAME_SIZE - 1, LOGGERS),
        LimitRule(("rcl_interfaces/msg/LoggerLevel", "name"), NAME_SIZE - 1, None),
        LimitRule(("rcl_interfaces/msg/SetLoggerLevelsResult", "reason"), REASON_SIZE - 1, None),
    )


_LISTS = (
    ("GetLoggerLevels_Response", "levels"),
    ("SetLoggerLevels_Request", "levels"),
    ("SetLoggerLevels_Response", "results"),
)


def _rule(name: str, member: str) -> LimitRule:
    return LimitRule((f"rcl_interfaces/{name}", member), None, LOGGERS)
