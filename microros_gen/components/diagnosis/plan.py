# SPDX-License-Identifier: Apache-2.0
"""The statuses of a device: which there are, their counters and checks as C, and the size of the largest message."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from microros_gen.application.diagnosis_decl import CallbackDecl, DiagnosisDecl, LevelLimits
from microros_gen.application.model import Application, LimitRule
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.client.plan.streams import WRITE_DATA_OVERHEAD
from microros_gen.client.plan.values import Values
from microros_gen.client.views.example_running import RunningView
from microros_gen.components.diagnosis.callbacks import CALLBACK, callback_rows, constant_of, example_watch
from microros_gen.components.diagnosis.tables import (
    CheckRow,
    CounterRow,
    Status,
    check_counts,
    largest,
    node_prefix,
    statuses_of,
)
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.selection.contribution import Counter

TYPE = TypeName("diagnostic_msgs", "msg", "DiagnosticArray")
READS_SLICES = True
"""Counters of components can be those of each element of their slices."""
_PORT = "microros/port_diagnosis.h"
_RESET = "microros/rcl_diagnosis_reset.h"
_OWN = "microros/rcl_diagnosis.h"
_RESETS = ("unknown", "power", "pin", "software", "watchdog", "brown-out", "fault")
"""Words of port_reset_t."""
_MOST_VALUES = 10
_LONGEST_GROUP = 32
_LONGEST_MESSAGE = 40
_LONGEST_KEY = 12
_OTHER_VALUES = 2
"""Of the status of timers, besides those of each timer."""
_NS_PER_US = 1000
_LONGEST_NUMBER = 11


@dataclass(frozen=True, kw_only=True)
class DiagnosisPlan:
    """What the device reports. `times`: rounds are measured, `cpu`: waits as well; `stack`, `reset`, `supply` likewise.

    `missing` are parts that nothing measures here, as a report names them. `periods` are those of the timers that are
    reported one by one, microseconds. `size`: bytes of the largest message.
    """

    period_ms: int
    deadline_us: int
    hardware_id: str
    times: bool
    cpu: bool
    stack: bool
    reset: bool
    supply: bool
    requests: bool
    statuses: tuple[Status, ...]
    rows: tuple[CounterRow, ...]
    checks: tuple[CheckRow, ...]
    declared: tuple[str, ...]
    periods: tuple[int, ...]
    callbacks: tuple[CallbackDecl, ...]
    missing: str
    size: int

    @property
    def status_count(self) -> int:
        """Return the number of statuses."""
        return len(self.statuses)

    @property
    def row_count(self) -> int:
        """Return the number of counters."""
        return len(self.rows)

    @property
    def check_count(self) -> int:
        """Return the number of checks, those of the application first."""
        return len(self.checks)

    @property
    def declared_count(self) -> int:
        """Return the number of checks of the application."""
        return len(self.declared)

    @property
    def timer_count(self) -> int:
        """Return the number of timers that are reported one by one."""
        return len(self.periods)

    @property
    def callback_count(self) -> int:
        """Return the number of callbacks whose times are reported one by one."""
        return len(self.callbacks)

    @property
    def measures_time(self) -> bool:
        """Return whether anything is measured in microseconds."""
        return self.times or bool(self.callbacks)

    @property
    def shown(self) -> str:
        """Return what a report says: the period and the names of all statuses."""
        names = ", ".join(status.name.partition(": ")[2] for status in self.statuses)
        return f"every {self.period_ms} ms: {names}"

    @property
    def row_headers(self) -> tuple[str, ...]:
        """Return the headers of what the expressions call, sorted."""
        found = {row.header for row in self.rows if row.header}
        return tuple(sorted(found | ({_PORT} if self.supply or self.stack else set()) - {_OWN}))

    @property
    def tables(self) -> tuple[str, ...]:
        """Return the lists of words, of periods, and of limits of callbacks, as C."""
        words = ", ".join(f'"{word}"' for word in _RESETS)
        resets = f"static const char * const diagnosis_resets[] = {{{words}}};"
        numbers = ", ".join(f"INT64_C({period * _NS_PER_US})" for period in self.periods)
        periods = f"const int64_t rcl_diagnosis_periods[] = {{{numbers}}};"
        times = ", ".join(f"{callback.limit_us}u" for callback in self.callbacks)
        limits_us = f"const uint32_t rcl_diagnosis_limits_us[] = {{{times}}};"
        return (
            *((resets,) if self.reset else ()),
            *((periods,) if self.periods else ()),
            *((limits_us,) if self.callbacks else ()),
        )

    @property
    def checks_table(self) -> tuple[str, ...]:
        """Return the table of checks as lines of C; without any there is an entry that nothing names."""
        rows = [f"  {check.entry}," for check in self.checks] or ["  {0},"]
        return ("const rcl_diagnosis_check_t rcl_diagnosis_checks[] = {", *rows, "};")

    @property
    def measures(self) -> tuple[str, ...]:
        """Return the statements that set the checks of what the library measures."""
        return tuple(line for i, check in enumerate(self.checks) for line in check.measured(i))

    @property
    def constants(self) -> tuple[str, ...]:
        """Return the positions of the application's checks and callbacks as lines of C."""
        checks = (f"  DIAGNOSIS_{name.upper()} = {i}," for i, name in enumerate(self.declared))
        times = (f"  {constant_of(callback)} = {i}," for i, callback in enumerate(self.callbacks))
        return (
            *(("", "enum {", *checks, "};") if self.declared else ()),
            *(("", "enum {", *times, "};") if self.callbacks else ()),
        )

    @property
    def example_function(self) -> tuple[str, ...]:
        """Return a function of the example as lines of C, which sets each check to its last good value."""
        if not self.declared:
            return ()
        calls: list[str] = []
        for name, check in zip(self.declared, self.checks, strict=False):
            call = f"rclc_diagnosis_set((uint8_t)DIAGNOSIS_{name.upper()}, {check.good})"
            calls += [f"  if ({call} != RCL_RET_OK) {{", "    rcl_reset_error();", "  }"]
        return (
            "/* Sets the checks, here to limits that are still good: replace them by what the device measures. */",
            "static void set_checks(void)",
            "{",
            *calls,
            "}",
            "",
        )

    def example_watch(self, running: RunningView | None) -> Iterator[str]:
        """Yield statements of the example, which watch the entities that are named like a declared callback."""
        yield from example_watch(self.callbacks, running)

    @property
    def example_turn(self) -> tuple[str, ...]:
        """Return its call."""
        return ("set_checks();",) if self.declared else ()


def plan(context: PlanContext, diagnostics: Diagnostics) -> DiagnosisPlan:
    """Return the statuses; what nothing measures, and messages that do not fit, are reported."""
    application = context.application
    declared = application.diagnosis or DiagnosisDecl()
    refuse_own_limits(context, "diagnosis", diagnostics)
    times = context.selection.has("executor") and not context.runtime.session.multithread
    cpu = times and context.runtime.transport.has_handle
    has = {name: _offered(context, name) for name in ("stack_peak", "reset_cause", "supply_voltage")}
    supply = has["supply_voltage"]
    _check_measured(context, declared, times, supply, diagnostics)
    if declared.callbacks and not context.selection.has("executor"):
        message = "'callbacks' of a diagnosis is for callbacks of executors, and no executor is selected"
        hint = "Add +executor to components, or remove it"
        diagnostics.error(message, declared.callbacks_span, hint, id="MG-3301")
    timers = _timers(application) if declared.timers else ()
    if declared.timers and not timers:
        message = "'timers' of a diagnosis is for declared timers, and no node has one"
        hint = "Add to a node: `timers: [{name: tick, period: 100 ms}]`"
        diagnostics.error(message, declared.timers_span, hint, id="MG-7189")
    rows = [
        *_own_rows(context, times, has, [name for name, _ in timers]),
        *_contributed(context),
        *callback_rows(declared.callbacks),
    ]
    checks = [*_own_checks(declared, cpu, has["stack_peak"], supply)]
    statuses, rows_in_order, checks_in_order = statuses_of(application, declared, rows, checks, diagnostics)
    check_counts(statuses, rows, declared.timers, _place(context, declared), diagnostics)
    size = largest(statuses, rows_in_order, checks_in_order, declared.hardware_id, _RESETS)
    _check_size(context, size, declared, diagnostics)
    missing = [
        *(() if cpu else ("CPU share",)),
        *(() if has["stack_peak"] else ("stack",)),
        *(() if has["reset_cause"] else ("reset cause",)),
        *(() if supply else ("supply voltage",)),
    ]
    return DiagnosisPlan(
        period_ms=declared.period_ms,
        deadline_us=declared.deadline_us if times else 0,
        hardware_id=declared.hardware_id,
        times=times,
        cpu=cpu,
        stack=has["stack_peak"],
        reset=has["reset_cause"],
        supply=supply,
        requests=any(check.mode for check in declared.checks),
        statuses=statuses,
        rows=rows_in_order,
        checks=checks_in_order,
        declared=tuple(check.name for check in declared.checks),
        periods=tuple(period for _, period in timers),
        callbacks=declared.callbacks,
        missing=", ".join(missing),
        size=size,
    )


def _offered(context: PlanContext, capability: str) -> bool:
    """Return whether a part of the platform or the application provides an optional capability.

    Conditions of its files on the board are not looked at: the board is planned later.
    """
    values = Values(context.runtime, context.selection, target=context.target)
    provisions = (p for part in context.target.parts for p in part.component.provides)
    return capability in context.target.own_capabilities or any(
        values.holds(tuple(w for w in file.when if not w[0].startswith("board.")))
        for provision in provisions
        if provision.capability == capability
        for file in provision.sources
    )


def _check_measured(
    context: PlanContext, declared: DiagnosisDecl, times: bool, supply: bool, diagnostics: Diagnostics
) -> None:
    """Report settings for what is not measured in this application."""
    if declared.deadline_us and not times:
        why = "several tasks run it" if context.selection.has("executor") else "no executor is selected"
        message = f"'deadline' of a diagnosis is for callbacks of one executor, and {why}"
        diagnostics.error(message, declared.deadline_span, "Remove it", id="MG-7096")
    if declared.supply.span is not None and not supply:
        message = f"the target {context.target.name} measures no supply voltage"
        hint = "Define port_supply_mv and write `provides: [supply_voltage]` into the target file"
        diagnostics.error(message, declared.supply.span, hint, id="MG-7097")


def _place(context: PlanContext, declared: DiagnosisDecl) -> Span | None:
    """Return the place of the settings, or of what selects the component; None: a profile does."""
    changes = (change.span for change in context.application.components if change.name == "diagnosis")
    return declared.span or next(changes, None)


def _check_size(context: PlanContext, size: int, declared: DiagnosisDecl, diagnostics: Diagnostics) -> None:
    room = min(context.types[TYPE].max_encoded_size, context.runtime.streams.mtu - WRITE_DATA_OVERHEAD)
    if size > room:
        message = f"a status of the diagnosis takes {size} bytes, and a message has room for {room}"
        hint = "Raise transport.mtu or the limits of diagnostic_msgs/msg/DiagnosticArray, or shorten texts"
        diagnostics.error(message, _place(context, declared), hint, id="MG-7098")


def _timers(application: Application) -> tuple[tuple[str, int], ...]:
    """Return the name of each declared timer in a report, with its node where several have timers, and its period."""
    nodes = [node for node in application.nodes if node.timers]
    return tuple(
        (timer.name if len(nodes) == 1 else f"{node.name}/{timer.name}", timer.period_us)
        for node in nodes
        for timer in node.timers
    )


def _own_rows(
    context: PlanContext, times: bool, has: dict[str, bool], timers: Sequence[str]
) -> Iterator[CounterRow]:
    """Yield the counters of this component itself."""
    if times:
        yield CounterRow("executor", "rounds", "rcl_diagnosis_rounds()")
        yield CounterRow("executor", "longest_us", "rcl_diagnosis_longest_us()")
        yield CounterRow("executor", "missed", "rcl_diagnosis_missed()", warns=True)
    if context.selection.has("timers"):
        yield CounterRow("timers", "overruns", "rcl_diagnosis_overruns()", warns=True)
        yield CounterRow("timers", "latest_us", "rcl_diagnosis_latest_us()")
        for index, name in enumerate(timers):
            yield CounterRow("timers", f"{name}_us", f"rcl_diagnosis_timer_us({index})")
    if has["stack_peak"]:
        yield CounterRow("stack", "peak", "port_stack_peak()", header=_PORT)
        yield CounterRow("stack", "size", "port_stack_size()", header=_PORT)
    if has["reset_cause"]:
        yield CounterRow("reset", "cause", "rcl_diagnosis_reset()", words="diagnosis_resets", header=_RESET)
    yield CounterRow("errors", "count", "rcl_diagnosis_errors()")


def _contributed(context: PlanContext) -> Iterator[CounterRow]:
    """Yield the counters that the selected components contribute."""
    values = Values(context.runtime, context.selection, target=context.target)
    counters: Iterator[Counter] = (
        counter
        for chosen in context.selection.components
        for counter in chosen.component.contributes.counters
    )
    for counter in counters:
        if values.holds(counter.when):
            yield from _rows_of(counter, values)


def _rows_of(counter: Counter, values: Values) -> Iterator[CounterRow]:
    """Yield a counter, or one for each element of a list of the plan."""
    for index, name in enumerate(values.names(counter.each) if counter.each else ("",)):
        group, value = (
            text.replace("{name}", name).replace("{index}", str(index))
            for text in (counter.group, counter.value)
        )
        yield CounterRow(group, counter.name, value, counter.warns, header=counter.header)


def _own_checks(declared: DiagnosisDecl, cpu: bool, stack: bool, supply: bool) -> Iterator[CheckRow]:
    """Yield the checks of what the library measures."""
    if cpu:
        yield _measure("executor", "cpu_percent", declared.cpu, "rcl_diagnosis_busy()")
    if stack:
        percent = "(int32_t)(port_stack_peak() * 100u / port_stack_size())"
        yield _measure("stack", "used_percent", declared.stack, percent)
    if supply:
        yield _measure("supply", "supply_mv", declared.supply, "(int32_t)port_supply_mv()", above=False)


def _measure(group: str, key: str, limits: LevelLimits, value: str, above: bool = True) -> CheckRow:
    return CheckRow(group, key, limits.warn, limits.error, above=above, value=value)


def record(part: DiagnosisPlan) -> object:
    """Return what the plan id is made of: an application is compiled with the positions of its checks."""
    return {
        "times": [part.period_ms, part.deadline_us],
        "hardware": part.hardware_id,
        "statuses": [status.entry for status in part.statuses],
        "rows": [[row.entry, row.value] for row in part.rows],
        "checks": [check.entry for check in part.checks],
        "declared": list(part.declared),
        "periods": list(part.periods),
        "callbacks": [[callback.name, callback.limit_us] for callback in part.callbacks],
    }


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the limits of a message with one status, for those without limits in the application file."""
    declared = application.diagnosis or DiagnosisDecl()
    texts = [text for check in declared.checks for text in (check.name, check.unit, check.mode)]
    longest = max(_LONGEST_NUMBER, *(len(text.encode()) for text in texts), 0)
    timers = _timers(application) if declared.timers else ()
    values = max(_MOST_VALUES, _OTHER_VALUES + len(timers))
    key = max([_LONGEST_KEY, *(len(f"{name}_us") for name, _ in timers)])
    nodes = max((len(node_prefix(node)) for node in application.nodes), default=0)
    groups = (len(f"{CALLBACK}{callback.name}") for callback in declared.callbacks)
    name = nodes + max(_LONGEST_GROUP, longest, *groups)
    bounds: tuple[tuple[tuple[str, ...], int | None, int | None], ...] = (
        (("header", "frame_id"), 1, None),
        (("status",), None, 1),
        (("status", "name"), name, None),
        (("status", "message"), _LONGEST_MESSAGE, None),
        (("status", "hardware_id"), len(declared.hardware_id.encode()), None),
        (("status", "values"), None, values),
        (("status", "values", "key"), key, None),
        (("status", "values", "value"), longest, None),
    )
    rules = (LimitRule((str(TYPE), *path), text, count) for path, text, count in bounds)
    configured = {rule.path for rule in application.limits}
    return tuple(rule for rule in rules if rule.path not in configured)
