# SPDX-License-Identifier: Apache-2.0
"""What a device diagnoses of itself: which statuses an application has, sizes, reports, mistakes, and C units."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.components.diagnosis.plan import DiagnosisPlan
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.modes.published import published_of
from microros_gen.modes.verification import read_applications
from tests.support.components.rendered import UNITS, planned, rendered, run
from tests.support.slices import first

BARE = "version: 1\nprofiles: [pure_sender]\n"
NODES = "nodes: [{name: device, namespace: /arm, timers: [{name: tick, period: 1 s}]}, {name: other}]\n"
CHECKS = """\
diagnosis:
  period: 2 s
  hardware_id: board-7
  deadline: 50 ms
  timers: true
  callbacks: [{name: tick, limit: 3 ms}, {name: other}]
  checks:
    - {name: heat, above: {warn: 80, error: 90}, timeout: 5 s, mode: SAFE}
    - {name: battery, unit: mV, below: {error: -5}, node: other}
"""
MODES = """\
version: 1
profiles: [managed_service]
components: [+node_modes, +timers, +diagnosis]
nodes:
  - name: device
    timers: [{name: tick, period: 1 s}]
    parameters: [{name: speed, type: double, default: 0.5}]
    modes: {SAFE: {speed: 0.25}}
  - {name: other}
"""


def slice_of(found: compiler.Planned) -> DiagnosisPlan:
    part = found.project.runtime.features.of("diagnosis")
    assert isinstance(part, DiagnosisPlan)
    return part


def names(found: compiler.Planned) -> list[str]:
    return [status.name for status in slice_of(found).statuses]


def test_statuses_follow_from_what_is_selected(tmp_path: Path) -> None:
    alone = planned(tmp_path, f"{BARE}components: [+diagnosis]\nnodes: [{{name: device}}]\n")
    assert names(alone) == ["device: errors", "device: session"]
    part = slice_of(alone)
    assert (part.period_ms, part.times, part.missing) == (
        1000,
        False,
        "CPU share, stack, reset cause, supply voltage",
    )
    more = planned(tmp_path, f"{BARE}components: [+diagnosis, +timers, +executor]\nlogging: console\n{NODES}")
    assert names(more) == [
        f"arm/device: {name}" for name in ("executor", "timers", "errors", "log", "session")
    ]
    assert slice_of(more).missing == "stack, reset cause, supply voltage"


def test_a_board_has_its_stack(tmp_path: Path) -> None:
    text = f"{BARE}components: [+diagnosis, +timers, +executor]\ntarget: qemu-mps2-an386\n{NODES}"
    found = planned(tmp_path, text)
    assert names(found)[:4] == [f"arm/device: {name}" for name in ("executor", "timers", "stack", "reset")]
    assert slice_of(found).missing == "supply voltage"
    rows = {row.capability.name: row.provider for row in found.project.provisions.rows}
    assert rows["stack_peak"] == rows["reset_cause"] == "port_bare"
    assert rows["microseconds"] == "port_cortex_m"
    assert "supply_voltage" not in rows


def test_what_the_application_measures(tmp_path: Path) -> None:
    target = tmp_path / "mine.yaml"
    target.write_text("target: mine\nextends: qemu-mps2-an386\nprovides: [supply_voltage, reset_cause]\n")
    text = f"{BARE}components: [+diagnosis]\ntarget: {target}\nnodes: [{{name: device, namespace: /arm}}]\n"
    found = planned(tmp_path, text + "diagnosis: {supply: {warn: 4750, error: 4500}}\n")
    assert names(found)[-1] == "arm/device: supply"
    part = slice_of(found)
    assert part.missing == "CPU share"
    (check,) = [check for check in part.checks if check.group == "supply"]
    assert (check.key, check.warn, check.error, check.above) == ("supply_mv", 4750, 4500, False)
    declared = {row.capability.name for row in found.project.provisions.of_application}
    assert {"supply_voltage", "reset_cause"} <= declared


def test_several_tasks_are_not_measured(tmp_path: Path) -> None:
    """Their waits cannot be told apart: the share is left out rather than wrong."""
    part = slice_of(
        planned(tmp_path, f"{BARE}components: [+diagnosis, +timers, +executor, +multithread]\n{NODES}")
    )
    assert (part.times, part.cpu) == (False, False)
    assert "CPU share" in part.missing


def test_nothing_is_there_without_it(tmp_path: Path) -> None:
    """Neither a member of the client nor a call of the hooks."""
    out = rendered(tmp_path, f"{BARE}components: [+timers, +executor]\n{NODES}")
    files = [*(out / "src").rglob("*.c"), *(out / "include" / "microros").glob("*.h")]
    text = "".join(path.read_text() for path in files)
    assert "diagnosis" not in text
    assert "rcl_timer_watch" in text


MISTAKES = {
    "period": ("period: 2 s", "period: 10 ms", "MG-3110", "Write period: 1 s"),
    "order": ("error: 90", "error: 70", "MG-3111", "Exchange them"),
    "twice": ("name: battery", "name: heat", "MG-3112", "Give each a different name"),
    "no side": (", below: {error: -5}", "", "MG-3113", "Write either above"),
    "two sides": ("below: {error: -5}", "below: {error: -5}, above: {error: 5}", "MG-3113", "Write either"),
    "node": ("node: other", "node: othr", "MG-3114", "Did you mean 'other'?"),
    "no error": ("{warn: 80, error: 90}", "{warn: 80}", "MG-3115", "Add `error`"),
    "mode": ("mode: SAFE", "mode: SAFER", "MG-3116", "Did you mean 'SAFE'?"),
    "key": ("period: 2 s", "perod: 2 s", "MG-1002", "Did you mean 'period'?"),
    "name of the library": ("name: heat", "name: session", "MG-7099", "Choose another name"),
    "callback twice": ("name: other}]", "name: tick}]", "MG-3300", "Give each a different name"),
    "limit": ("limit: 3 ms", "limit: 61 s", "MG-3110", "Write limit: 2 ms"),
    "supply": ("period: 2 s", "supply: {warn: 4750}", "MG-7097", "Define port_supply_mv"),
}
"""What is replaced, by what, and the id and hint of what is reported."""


@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistakes_have_place_and_hint(tmp_path: Path, mistake: str) -> None:
    old, new, identifier, hint = MISTAKES[mistake]
    assert CHECKS.count(old) == 1
    with pytest.raises(UserError) as error:
        planned(tmp_path, MODES + CHECKS.replace(old, new))
    found = [d for d in error.value.diagnostics if d.id == identifier]
    assert found, str(error.value)
    assert found[0].span is not None
    assert hint in (found[0].hint or "")


def test_a_deadline_needs_an_executor(tmp_path: Path) -> None:
    text = f"{BARE}components: [+diagnosis]\nnodes: [{{name: device}}]\ndiagnosis: {{deadline: 5 ms}}\n"
    with pytest.raises(UserError, match="no executor is selected"):
        planned(tmp_path, text)


def test_callbacks_need_an_executor(tmp_path: Path) -> None:
    text = f"{BARE}components: [+diagnosis]\nnodes: [{{name: n}}]\ndiagnosis: {{callbacks: [{{name: a}}]}}\n"
    with pytest.raises(UserError) as error:
        planned(tmp_path, text)
    assert [d.id for d in error.value.diagnostics] == ["MG-3301"]


def test_the_key_needs_the_component(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="needs the component 'diagnosis', which nothing selects"):
        planned(tmp_path, f"{BARE}nodes: [{{name: device}}]\ndiagnosis: {{}}\n")


def test_a_message_that_does_not_fit_is_refused(tmp_path: Path) -> None:
    text = (
        f"{BARE}components: [+diagnosis]\ntransport: {{type: serial, mtu: 160}}\nnodes: [{{name: device}}]\n"
    )
    with pytest.raises(UserError, match="a status of the diagnosis takes"):
        planned(tmp_path, text)


MANY_TASKS = 30
"""As many as an application can have."""


def many_tasks() -> str:
    executors = ", ".join(f"{{name: e{i}}}" for i in range(MANY_TASKS))
    tasks = "".join(f"  - {{name: t{i}, executor: e{i}, period: 20 ms}}\n" for i in range(MANY_TASKS))
    nodes = f"nodes: [{{name: device, executors: [{executors}]}}]\n"
    return f"{BARE}components: [+executor, +diagnosis]\n{nodes}tasks:\n{tasks}"


def test_all_tasks_that_an_application_can_have_are_reported(tmp_path: Path) -> None:
    found = names(planned(tmp_path, many_tasks()))
    assert {f"device: task t{i}" for i in range(MANY_TASKS)} < set(found)
    assert 32 < len(found) <= 64


@pytest.mark.parametrize(
    ("application", "message", "line", "hint"),
    [
        (
            f"{BARE}components: [+diagnosis]\nnodes: [{{name: device}}]\ndiagnosis:\n  checks:\n"
            + "".join(f"    - {{name: c{i}, above: {{warn: 1}}}}\n" for i in range(70)),
            "a device has 72 statuses, 64 at most",
            6,
            "Remove 8 of its checks, callbacks or tasks",
        ),
        (
            f"{BARE}components: [+timers, +diagnosis]\ntransport: {{type: udp, mtu: 16000}}\n"
            "diagnosis: {timers: true}\n"
            f"nodes: [{{name: device, timers: ["
            + ", ".join(f"{{name: t{i}, period: {i + 1} ms}}" for i in range(250))
            + "]}]\n",
            "a device has 263 counters, 255 at most",
            5,
            "Remove `timers: true`",
        ),
    ],
    ids=["checks", "timers"],
)
def test_more_than_there_are_numbers_for(
    tmp_path: Path, application: str, message: str, line: int, hint: str
) -> None:
    with pytest.raises(UserError) as error:
        planned(tmp_path, application)
    (found,) = error.value.diagnostics
    assert (found.id, found.message, found.hint) == ("MG-7095", message, hint)
    assert found.span is not None
    assert found.span.line == line


def test_a_mistake_without_settings_is_shown_where_the_component_is_selected(tmp_path: Path) -> None:
    text = f"{BARE}components: [+diagnosis]\ntransport: {{type: serial, mtu: 160}}\nnodes: [{{name: n}}]\n"
    with pytest.raises(UserError) as error:
        planned(tmp_path, text)
    (found,) = error.value.diagnostics
    assert found.id == "MG-7098"
    assert found.span is not None
    assert found.span.line == 3


@pytest.mark.system
def test_limits_ages_requests_and_times(tmp_path: Path) -> None:
    """Every limit from both sides, both clocks over their wraps."""
    out = rendered(tmp_path, MODES + CHECKS)
    parts = ("check", "judge", "times")
    sources = [out / "src" / "diagnosis" / f"rcl_diagnosis_{part}.c" for part in parts]
    sources += [out / "src" / "diagnosis" / "rclc_diagnosis.c", tmp_path / "tables.c"]
    text = (out / "src" / "diagnosis" / "rcl_diagnosis_declared.c").read_text()
    begin = text.index("const rcl_diagnosis_check_t")
    (tmp_path / "tables.c").write_text(
        '#include "microros/rcl_diagnosis.h"\n#include "microros/error.h"\n'
        + text[begin : text.index("};", begin) + 2]
        + '\nconst char microros_error_diagnosis[] = "";\n'
        + "int32_t microros_error_named(int32_t result, microros_error_t error, const char * name)\n"
        + "{ (void)error; (void)name; return result; }\n"
    )
    flags = (
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-fsanitize=address,undefined",
        "-fno-sanitize-recover=all",
    )
    program = tmp_path / "unit"
    run("gcc", *flags, f"-I{out / 'include'}", UNITS / "unit_diagnosis.c", *sources, "-o", program)
    assert run(program) == "ok\n"


@pytest.mark.system
@pytest.mark.parametrize("compiler_name", ["gcc", "clang"])
@pytest.mark.parametrize("flags", first([(), ("-m32",)]), ids=["64", "32"])
def test_it_compiles_without_a_warning(tmp_path: Path, compiler_name: str, flags: tuple[str, ...]) -> None:
    out = rendered(tmp_path, f"{MODES}logging: rosout\n{CHECKS}")
    warnings = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow", "-Werror")
    sources = [*(out / "src" / "diagnosis").glob("*.c"), *(out / "src" / "node_modes").glob("*.c")]
    for source in sources:
        command = [compiler_name, "-std=c99", *warnings, *flags, f"-I{out / 'include'}", "-fsyntax-only"]
        done = subprocess.run([*command, source], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr


def test_a_name_that_several_nodes_have(tmp_path: Path) -> None:
    text = (
        f"{BARE}components: [+diagnosis]\nnodes: [{{name: motor, namespace: /left}}, "
        "{name: motor, namespace: /right}]\n"
        "diagnosis: {checks: [{name: heat, node: motor, above: {warn: 1}}]}\n"
    )
    with pytest.raises(UserError) as error:
        planned(tmp_path, text)
    assert [(d.id, d.hint) for d in error.value.diagnostics] == [
        ("MG-3117", "Write one of /left/motor, /right/motor")
    ]


TIMERS = """\
version: 1
profiles: [pure_sender]
components: [+diagnosis, +timers, +executor]
nodes:
  - name: device
    timers: [{name: fast, period: 10 ms}, {name: twin, period: 10 ms}, {name: slow, period: 1 s}]
"""


def test_each_timer_is_reported_where_that_is_wanted(tmp_path: Path) -> None:
    """By name, in a message that has room for it; with the node where several have timers."""
    usual = slice_of(planned(tmp_path, TIMERS))
    assert [row.key for row in usual.rows if row.group == "timers"] == ["overruns", "latest_us"]
    each = slice_of(planned(tmp_path, f"{TIMERS}diagnosis: {{timers: true}}\n"))
    assert [row.key for row in each.rows if row.group == "timers"][2:] == ["fast_us", "twin_us", "slow_us"]
    more = f"{TIMERS}  - {{name: other, timers: [{{name: fast, period: 3 us}}]}}\n"
    both = slice_of(planned(tmp_path, f"{more}diagnosis: {{timers: true}}\n"))
    assert [row.key for row in both.rows if row.group == "timers"][2::3] == [
        "device/fast_us",
        "other/fast_us",
    ]
    assert both.tables[-1].endswith(
        "{INT64_C(10000000), INT64_C(10000000), INT64_C(1000000000), INT64_C(3000)};"
    )


def test_a_report_of_many_timers_has_room(tmp_path: Path) -> None:
    """More values than other statuses have, with longer keys."""
    timers = ", ".join(f"{{name: a_timer_with_a_long_name_{i}, period: {i + 1} ms}}" for i in range(12))
    base = "version: 1\nprofiles: [pure_sender]\ncomponents: [+diagnosis, +timers]\n"
    found = planned(
        tmp_path, f"{base}nodes: [{{name: n, timers: [{timers}]}}]\ndiagnosis: {{timers: true}}\n"
    )
    part = slice_of(found)
    assert part.timer_count == 12
    assert part.size > 12 * len("a_timer_with_a_long_name_0_us")


def test_without_declared_timers_none_is_reported(tmp_path: Path) -> None:
    text = f"{BARE}components: [+diagnosis, +timers]\nnodes: [{{name: n}}]\ndiagnosis: {{timers: true}}\n"
    with pytest.raises(UserError) as error:
        planned(tmp_path, text)
    assert [d.id for d in error.value.diagnostics] == ["MG-7189"]


def test_lateness_of_each_timer(tmp_path: Path) -> None:
    """Found by its period, those of one period by their order; gcc with sanitizers."""
    out = rendered(tmp_path, f"{TIMERS}diagnosis: {{timers: true}}\n")
    (table,) = slice_of(planned(tmp_path, f"{TIMERS}diagnosis: {{timers: true}}\n")).tables
    (tmp_path / "tables.c").write_text(f'#include "microros/rcl_diagnosis.h"\n{table}\n')
    sources = [
        UNITS / "unit_diagnosis_timers.c",
        out / "src" / "diagnosis" / "rcl_diagnosis_timers.c",
        out / "src" / "support" / "microros_time_math.c",
        tmp_path / "tables.c",
    ]
    flags = (
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Wpedantic",
        "-Wconversion",
        "-Werror",
        "-fsanitize=address,undefined",
    )
    program = tmp_path / "unit"
    run("gcc", *flags, f"-I{out / 'include'}", *sources, "-o", program)
    assert run(program) == "ok\n"


RESETS = {0x0: "POWER", 0x1: "PIN", 0x2: "WATCHDOG", 0x4: "SOFTWARE", 0x5: "SOFTWARE", 0x6: "WATCHDOG"}
RESETS |= {0x8: "FAULT", 0xA: "FAULT", 0x10000: "UNKNOWN", 0x104: "FAULT"}
"""Reasons of the nRF51 and what they mean; bit 8 is none of them, but means a kept fault."""


def test_reset_causes_of_the_microbit(tmp_path: Path) -> None:
    """The file of the board's image, with a variable in place of the register: it is read once, and cleared."""
    base = f"{BARE}components: [+diagnosis]\ntarget: qemu-microbit\nnodes: [{{name: n}}]\n"
    out = rendered(tmp_path, base)
    source = (out / "src" / "port_microbit" / "port_microbit_reset_cause.c").read_text()
    register = "(volatile uint32_t *)RESET_REASONS"
    assert source.count(register) == 1
    assert "#define RESET_REASONS 0x40000400u\n" in source
    (tmp_path / "reset.c").write_text(
        "static volatile unsigned cell, fault;\n"
        + source.replace(register, "&cell").replace(
            '#include "microros/port_bare.h"\n',
            "#include <stdio.h>\n"
            "#include <stdlib.h>\n#include <stdbool.h>\n"
            "static bool port_bare_fault_is_kept(void) { return fault != 0; }\n",
        )
        + "int main(int n, char ** v)\n{\n  cell = (unsigned)strtoul(v[n - 1], NULL, 0);\n"
        "  fault = cell >> 8 & 1u;\n  cell &= ~0x100u;\n  port_reset_t first = port_reset_cause();\n"
        "  cell = 2;\n  fault = 0;\n  if (port_reset_cause() != first) { return 1; }\n"
        '  printf("%d", (int)first);\n  return 0;\n}\n'
    )
    header = (out / "include" / "microros" / "port_diagnosis.h").read_text()
    names = re.findall(r"\bPORT_RESET_([A-Z_]+)\b", header)
    program = tmp_path / "reset"
    run("gcc", "-std=c99", "-Wall", "-Werror", f"-I{out / 'include'}", tmp_path / "reset.c", "-o", program)
    found = {reasons: names[int(run(program, hex(reasons)))] for reasons in RESETS}
    assert found == RESETS


COUNTING = """\
component: mine
summary: Counters of each element of what is no list
layer: middleware
status: ready
needs: [session]
xrce: []
sends: []
receives: []
objects: []
sources: []
counters: [{each: streams.mtu, group: "mine {name}", name: count, value: "0"}]
"""
CALLBACKS = """\
version: 1
profiles: [pure_sender]
components: [+diagnosis, +timers, +executor, +subscribe]
nodes:
  - name: device
    timers: [{name: tick, period: 10 ms}]
    subscriptions: [{topic: arm/command, type: std_msgs/msg/Int32}]
diagnosis: {callbacks: [{name: tick, limit: 2 ms}, {name: command}, {name: other}]}
"""


def test_callbacks_have_a_status_each(tmp_path: Path) -> None:
    """Overruns where there is a limit; also where several tasks run executors; nothing where none is declared."""
    found = planned(tmp_path, CALLBACKS)
    assert names(found)[-3:] == [f"device: callback {name}" for name in ("tick", "command", "other")]
    part = slice_of(found)
    rows = {status.name: part.rows[status.first_row :][: status.row_count] for status in part.statuses}
    tick, command = rows["device: callback tick"], rows["device: callback command"]
    assert [(row.key, row.warns) for row in tick] == [
        ("runs", False),
        ("last_us", False),
        ("longest_us", False),
        ("overruns", True),
    ]
    assert [row.key for row in command] == ["runs", "last_us", "longest_us"]
    threads = slice_of(planned(tmp_path, CALLBACKS.replace("+diagnosis", "+diagnosis, +multithread")))
    assert (threads.times, threads.measures_time) == (False, True)
    out = rendered(tmp_path, CALLBACKS.partition("diagnosis: {")[0])
    assert not (out / "src" / "diagnosis" / "rclc_diagnosis_callbacks.c").exists()
    assert "static inline rcl_ret_t rclc_handle_call" in (
        out / "include" / "microros" / "rclc_handle_call.h"
    ).read_text("utf-8")


TASKS = """\
components: [+diagnosis, +executor]
nodes: [{name: device, executors: [{name: fast}, {name: slow}]}]
tasks: [{name: control, executor: fast, rate: 50 Hz}, {name: session, executor: slow}]
"""


PERIOD = "diagnosis: {period: 1 s}\n"


def test_tasks_have_a_status_each(tmp_path: Path) -> None:
    """That of the session is the last one; its name differs from the declared ones."""
    part = slice_of(planned(tmp_path, BARE + TASKS))
    rows = {status.name: part.rows[status.first_row :][: status.row_count] for status in part.statuses}
    assert [*rows][-3:] == [f"device: task {name}" for name in ("control", "session", "line_and_session")]
    assert [row.key for row in rows["device: task session"] if row.warns] == ["overruns", "missed", "failed"]
    assert {re.sub(r"\d", "#", row.value) for row in rows["device: task session"]} == {
        re.sub(r"\d", "#", row.value) for row in rows["device: task control"]
    }
    assert all("1" in row.value for row in rows["device: task session"])
    plain = planned(tmp_path, BARE + TASKS.partition("tasks:")[0])
    assert not [name for name in names(plain) if "task" in name]


def test_rules_of_a_model_file_can_name_the_status_of_a_task(tmp_path: Path) -> None:
    statuses = {name.removeprefix("device: ") for name in names(planned(tmp_path, BARE + TASKS + PERIOD))}
    (application,) = read_applications([tmp_path / "microros.yaml"], Diagnostics())
    published = published_of(application, 0)
    assert published is not None
    assert statuses <= {*published}


def test_a_counter_of_no_list_is_refused(tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "component.yaml").write_text(COUNTING, encoding="utf-8")
    with pytest.raises(UserError, match=r"names 'streams\.mtu', which is not a list of the plan with names"):
        planned(tmp_path, f"{BARE}components: [{folder}, +diagnosis]\nnodes: [{{name: device}}]\n")


def test_the_example_watches_what_is_named_like_a_callback(tmp_path: Path) -> None:
    (example,) = (rendered(tmp_path, CALLBACKS) / "examples").glob("*/main.c")
    watched = re.findall(
        r"rclc_diagnosis_watch\(\(uint8_t\)RCLC_CALLBACK_(\w+), &(\w+)\)", example.read_text()
    )
    assert watched == [("TICK", "timer_0"), ("COMMAND", "subscription_0")]


@pytest.mark.parametrize("lock", ["", ", +multithread"], ids=["one task", "several"])
def test_times_of_callbacks(tmp_path: Path, lock: str) -> None:
    """Limits from both sides, a wrap of the clock, callbacks within callbacks, removed handles; sanitizers.

    With several tasks the lock is held whenever the clock is read, and never while a callback runs.
    """
    text = CALLBACKS.replace("+diagnosis", f"+diagnosis{lock}")
    out = rendered(tmp_path, text)
    tables = slice_of(planned(tmp_path, text)).tables
    (tmp_path / "tables.c").write_text("\n".join(('#include "microros/rclc_diagnosis_times.h"', *tables, "")))
    sources = [
        UNITS / "unit_diagnosis_callbacks.c",
        out / "src" / "diagnosis" / "rclc_diagnosis_callbacks.c",
        tmp_path / "tables.c",
    ]
    flags = ("-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror")
    checks = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    program = tmp_path / "unit"
    run("gcc", *flags, *checks, f"-I{out / 'include'}", *sources, "-o", program)
    assert run(program) == "ok\n"


@pytest.mark.parametrize("application", [BARE + TASKS, many_tasks()], ids=["some", "many"])
def test_what_is_read_and_sent_of_many_tasks(tmp_path: Path, application: str) -> None:
    """When the node opens, what can be a warning, but no stack: the lock is held. A report has each status once."""
    out = rendered(tmp_path, application)
    part = slice_of(planned(tmp_path, application))
    rows = part.rows
    text = (out / "src" / "diagnosis" / "rcl_diagnosis_declared.c").read_text()
    tables = (text.index(f"const rcl_diagnosis_{kind}_t") for kind in ("status", "row"))
    parts = "\n".join(text[begin : text.index("};", begin) + 2] for begin in tables)
    (tmp_path / "tables.c").write_text(f'#include "microros/rcl_diagnosis.h"\n{parts}\n')
    sources = [
        UNITS / "unit_diagnosis_open.c",
        out / "src" / "diagnosis" / "rcl_diagnosis.c",
        tmp_path / "tables.c",
    ]
    unused = ("-ffunction-sections", "-Wl,--gc-sections")  # what only a report calls
    program = tmp_path / "unit"
    run("gcc", "-std=c99", "-Wall", *unused, f"-I{out / 'include'}", *sources, "-o", program)
    lines = [line.split() for line in run(program).splitlines()]
    assert lines[: len(rows)] == [[row.key, "2" if row.warns else "0"] for row in rows]
    assert lines[len(rows) :] == [["sent", str(i)] for i in range(part.status_count)]
    assert sum(row.key == "stack_peak" for row in rows) > 1
