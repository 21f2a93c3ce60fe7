# SPDX-License-Identifier: Apache-2.0
"""What a device reports of itself, as the application file declares it below `diagnosis:`."""

from __future__ import annotations

from microros_gen.diagnostics import Span
from microros_gen.records import dataclass

KEY = "diagnosis"
"""Its key in the application file."""


@dataclass(frozen=True)
class LevelLimits:
    """From where on a value is a warning or an error; None: never."""

    warn: int | None = None
    error: int | None = None
    span: Span | None = None


@dataclass(frozen=True)
class CheckDecl:
    """A value that the application sets. `above`: values above the limits are faults, else those below.

    `node` is its position among the nodes. `timeout_ms`: how long a value holds; 0: forever. `mode`: what an error
    requests; empty: nothing.
    """

    name: str
    limits: LevelLimits
    above: bool = True
    unit: str = ""
    node: int = 0
    hysteresis: int = 0
    timeout_ms: int = 0
    mode: str = ""
    span: Span | None = None


@dataclass(frozen=True)
class CallbackDecl:
    """A callback whose times are reported; `limit_us`: longer ones are overruns, 0: none are."""

    name: str
    limit_us: int = 0
    span: Span | None = None


@dataclass(frozen=True)
class DiagnosisDecl:
    """Everything below `diagnosis:`; `deadline_us` of the callbacks of a round, 0: none.

    `timers`: the longest lateness of each declared timer is reported as well.
    """

    period_ms: int = 1000
    hardware_id: str = ""
    deadline_us: int = 0
    timers: bool = False
    stack: LevelLimits = LevelLimits(warn=90)
    cpu: LevelLimits = LevelLimits(warn=95)
    supply: LevelLimits = LevelLimits()
    checks: tuple[CheckDecl, ...] = ()
    callbacks: tuple[CallbackDecl, ...] = ()
    span: Span | None = None
    hardware_span: Span | None = None
    deadline_span: Span | None = None
    timers_span: Span | None = None
    callbacks_span: Span | None = None
