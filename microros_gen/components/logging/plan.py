# SPDX-License-Identifier: Apache-2.0
"""The writers of log messages and their levels, and the lowest of these, below which the image has no messages."""

from __future__ import annotations

from microros_gen.application.log_decl import LOG_LEVELS, LogWriter
from microros_gen.application.model import Application, logger_name
from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

TEXT_SIZE = 192
"""Bytes of a line of the console with its level, time and name; on the stack."""
LOGGERS = 4
"""Loggers that can have a separate level."""
NAME_SIZE = 32
"""Bytes of the name of such a logger with its NUL, where no declared node has a longer one."""
_LINE = TypeName("rcl_interfaces", "msg", "Log")
_NO_WRITER = 60
"""Above all levels."""
_STEP = 10
"""Between the numbers of two levels in ROS 2, which begin with it."""


@dataclass(frozen=True, kw_only=True)
class LoggingPlan:
    """Levels as numbers of ROS 2; `min_severity` is the lowest one counted from 0, as rcutils has it for macros."""

    level: int
    console_level: int
    callback_level: int
    rosout: bool
    text: str
    text_size: int = TEXT_SIZE
    loggers: int = LOGGERS
    name_size: int
    longest: int

    @property
    def min_severity(self) -> int:
        """RCUTILS_LOG_MIN_SEVERITY of the build."""
        return self.level // _STEP - 1

    @property
    def has_rosout(self) -> int:
        """Return 1 where messages go to /rosout, for C."""
        return int(self.rosout)

    @property
    def console(self) -> bool:
        """Whether lines go to the console."""
        return self.console_level != _NO_WRITER

    @property
    def callback(self) -> bool:
        """Whether the application's output handler is one of the writers."""
        return self.callback_level != _NO_WRITER


def writer_of(application: Application, to: str) -> LogWriter | None:
    """Return the application's writer of that name."""
    return next((writer for writer in application.logging if writer.to == to), None)


def name_size(application: Application) -> int:
    """Return the bytes of the name of a logger with its NUL."""
    names = (logger_name(node.namespace, node.name) for node in application.nodes)
    own = application.pools.get("logger_name_size", NAME_SIZE)
    return max(own, *(1 + len(name) for name in names), 0)


def loggers(application: Application) -> int:
    """Return how many loggers can have a separate level, and how many subloggers there can be."""
    return application.pools.get("loggers", LOGGERS)


def _longest(context: PlanContext) -> int:
    """Return the characters of the longest text that a writer formats."""
    planned = context.types.get(_LINE)
    fields = planned.limits.fields if planned is not None and planned.limits is not None else ()
    return max(TEXT_SIZE, *(bound.string or 0 for bound in fields if bound is not None), 0)


def level_number(writer: LogWriter) -> int:
    """Return the lowest level of a writer as a number of ROS 2."""
    return _STEP * (1 + LOG_LEVELS.index(writer.level))


def plan(context: PlanContext, diagnostics: Diagnostics) -> LoggingPlan:
    """Return what the application file says; without that the console where it is selected, else the callback."""
    writers = context.application.logging
    for to in ("ring", "rosout", "console"):
        if context.selection.has(f"logging_{to}") and writer_of(context.application, to) is None:
            writers = (LogWriter(to), *writers)
    writers = writers or (LogWriter("callback"),)
    levels = {writer.to: level_number(writer) for writer in writers}
    if "console" in levels and context.target.stdio is not None and context.target.stdio.to == "none":
        diagnostics.warning(
            f"the log writer 'console' writes nowhere: the target {context.target.name} has no standard output",
            next((writer.span for writer in writers if writer.to == "console"), None),
            "Give the target file `stdio: {to: uart, …}` or `{to: semihosting}`, or write `logging: callback`",
            id="MG-7040",
        )
    return LoggingPlan(
        level=min(levels.values()),
        console_level=levels.get("console", _NO_WRITER),
        callback_level=levels.get("callback", _NO_WRITER),
        rosout="rosout" in levels,
        loggers=loggers(context.application),
        name_size=name_size(context.application),
        longest=_longest(context),
        text=", ".join(f"{writer.to} from {writer.level}" for writer in writers),
    )


def record(part: LoggingPlan) -> object:
    """Return what the plan id is made of."""
    return {
        "levels": [part.level, part.console_level, part.callback_level],
        "loggers": [part.loggers, part.name_size],
    }
