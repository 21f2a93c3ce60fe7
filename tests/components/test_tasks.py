# SPDX-License-Identifier: Apache-2.0
"""Tasks of the application file: priorities, releases, wake-ups; what is wrong in it; what a report says."""

from __future__ import annotations

import json
import socket
import subprocess
import threading
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from microros_gen import compiler
from microros_gen.application.task_decl import CRITICALITIES, TaskDecl
from microros_gen.components.tasks.analysis import gaps, task_of
from microros_gen.components.tasks.plan import TasksPlan, priorities_of
from microros_gen.diagnostics import UserError
from microros_gen.documents.named import Named
from microros_gen.schedule.priorities import by_priority
from tests.support.components.rendered import SANITIZE, UNITS, planned, program_of, rendered, run
from tests.support.ids import without_id
from tests.support.patience import seconds
from tests.support.runtime.harness import SANITIZER, Tree, compile_merged, link, quick
from tests.support.runtime.reading_agent import ReadingAgent

HEAD = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +timers]
limits: {"*": {string: 20, sequence: 2}}
"""
NODES = """\
nodes:
  - name: device
    publishers: [{topic: count, type: std_msgs/msg/Int32, local: only}]
    subscriptions:
      - {topic: count, type: std_msgs/msg/Int32, local: only, queue: 60, qos: {depth: 60}}
      - {topic: other, type: std_msgs/msg/Int32, local: only}
    executors:
      - {name: a}
      - {name: b, handles: [count]}
      - {name: c, handles: [other]}
"""
OTHER = "  - {name: other, publishers: [{topic: other, type: std_msgs/msg/Int32, local: only}]}\n"
PERIODS = """\
tasks:
  - {name: skips, executor: a, rate: 1 kHz}
  - {name: catches, executor: b, period: 1 ms, overrun: catch_up}
  - {name: tells, executor: c, period: 1 ms, deadline: 600 us, overrun: call}
  - {name: reacts, executor: d, interval: 10 ms, deadline: 300 us, overrun: call}
"""
THREADS = """\
tasks:
  - {name: control, executor: a, rate: 250 Hz, criticality: high}
  - {name: worker, executor: b}
  - {name: idle, executor: c}
"""
EXAMPLE = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +timers]
session: {{key: 7}}
pools: {{history: 16}}
transport: {{type: udp, agent: "127.0.0.1:{port}"}}
nodes:
  - name: device
    publishers: [{{topic: count, type: std_msgs/msg/Int32}}]
    subscriptions: [{{topic: target, type: std_msgs/msg/Int32}}]
    timers: [{{name: beat, period: 20 ms}}]
    executors: [{{name: fast, handles: [beat]}}, {{name: slow, handles: [target]}}]
tasks:
  - {{name: control, executor: fast, rate: 100 Hz, overrun: call}}
  - {{name: worker, executor: slow, interval: 1 ms}}
"""
TIMES = """\
tasks:
  - {name: control, executor: a, rate: 1 kHz, deadline: 800 us, criticality: high, time: 200 us}
  - {name: worker, executor: b, interval: 5 ms, time: 2 ms, lock: 40 us}
  - {name: log, executor: c, interval: 50 ms, time: 3 ms, lock: 30 us, criticality: low}
  - {name: line, session: true, interval: 1 ms, time: 100 us, lock: 60 us}
"""
WAITS = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+executor, +timers]
session: {{key: 7}}
pools: {{guard_conditions: 2, wait_sets: 1, handles: 4}}
transport: {{type: udp, agent: "127.0.0.1:{port}"}}
nodes:
  - name: device
    subscriptions: [{{topic: target, type: std_msgs/msg/Int32, qos: {{depth: 1}}}}]
    timers: [{{name: beat, period: 100 s}}]
    executors: [{{name: reads, handles: [target]}}, {{name: waits, handles: [beat]}}]
tasks: [{{name: reader, executor: reads}}, {{name: waiter, executor: waits}}]
"""
SENT, RECEIVED = 40, 20
THREAD_SANITIZER = ("-std=gnu99", "-g", "-O0", "-fsanitize=thread", f"-I{UNITS}")


def serve(agent: ReadingAgent, served: socket.socket, received: int = RECEIVED) -> None:
    """Answer datagrams until the socket is closed; offer a sample with each of the first messages of the device."""
    offered = 0
    while True:
        try:
            datagram, peer = served.recvfrom(2048)
        except OSError:
            return
        answers = agent.receive(datagram)
        if agent.reads and offered < received:
            answers += agent.numbers(1, offered)
            offered += 1
        for answer in [*answers, *(agent.tick() if agent.unacknowledged else [])]:
            served.sendto(answer, peer)


def tasks(folder: Path, text: str) -> TasksPlan:
    part = planned(folder, HEAD + NODES + OTHER + text).project.runtime.features.of("tasks")
    assert isinstance(part, TasksPlan)
    return part


def test_releases_keep_to_their_grid(tmp_path: Path) -> None:
    nodes = NODES + "      - {name: d}\n"
    out = rendered(tmp_path, HEAD + nodes + OTHER + PERIODS)
    run(program_of(out, "task_periods.c", without=("port_posix_tasks.c",)))


def test_what_arrives_wakes_its_task(tmp_path: Path) -> None:
    out = rendered(tmp_path, HEAD + NODES + OTHER + THREADS)
    assert run(program_of(out, "task_threads.c", more=("-pthread",))).startswith("prioritized: ")


def test_the_example_exchanges_messages_with_an_agent(tmp_path: Path) -> None:
    """Each task sends from its timer; what the agent has for the subscription wakes the other one."""
    agent = ReadingAgent()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        threading.Thread(target=serve, args=(agent, served), daemon=True).start()
        out = rendered(tmp_path, EXAMPLE.format(port=served.getsockname()[1]))
        (main,) = out.glob("examples/*/main.c")
        compiler, flags = quick()
        flags = (*flags, "-std=gnu99", f"-DEXAMPLE_SAMPLES={SENT}")
        objects = compile_merged(Tree(out, ()), sorted((out / "src").rglob("*.c")), [main], compiler, flags)
        program = link(objects, compiler, (*flags, "-pthread"), out / "example")
        done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "".join(f"target: {value}\n" for value in range(RECEIVED))
    assert agent.values(0)[:SENT] == list(range(SENT))


def test_whatever_happens_ends_the_wait_of_a_task(tmp_path: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        agent = ReadingAgent()
        agent.numbers(1, *range(12))  # each is sent when the task has taken the one before
        threading.Thread(target=serve, args=(agent, served, 0), daemon=True).start()
        out = rendered(tmp_path, WAITS.format(port=served.getsockname()[1]))
        run(program_of(out, "task_waits.c", more=("-pthread",)))


def test_a_task_is_stopped_and_started_again_while_the_others_run(tmp_path: Path) -> None:
    run(program_of(rendered(tmp_path, HEAD + NODES + OTHER + THREADS), "task_restart.c", more=("-pthread",)))


@pytest.mark.system
@pytest.mark.parametrize(
    ("source", "flags"),
    [
        pytest.param("task_threads.c", THREAD_SANITIZER, id="threads-threads"),
        pytest.param("task_threads.c", SANITIZE, id="threads-memory", marks=pytest.mark.variant),
        pytest.param("task_restart.c", THREAD_SANITIZER, id="restart-threads"),
        pytest.param("task_restart.c", SANITIZE, id="restart-memory"),
    ],
)
def test_tasks_do_not_race(tmp_path: Path, source: str, flags: tuple[str, ...]) -> None:
    out = rendered(tmp_path, HEAD + NODES + OTHER + THREADS)
    sources = sorted((out / "src").rglob("*.c"))
    objects = compile_merged(Tree(out, ()), sources, [UNITS / source], SANITIZER, flags)
    program = link(objects, SANITIZER, (*flags, "-pthread"), out / "unit")
    done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(120), check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_priorities_go_by_criticality_then_by_deadline(tmp_path: Path) -> None:
    part = tasks(
        tmp_path,
        "tasks:\n"
        "  - {name: slow, executor: a, rate: 1 Hz}\n"
        "  - {name: soon, executor: b, interval: 1 s, deadline: 2 ms}\n"
        "  - {name: vital, executor: c, rate: 0.5 Hz, criticality: high, time: 3 ms}\n",
    )
    assert [(t.name, t.priority, t.level, t.deadline_us) for t in part.tasks] == [
        ("slow", 4, 1, 1_000_000),
        ("soon", 3, 2, 2_000),
        ("vital", 1, 4, 2_000_000),
        ("session", 2, 3, 0),  # directly above the task that it wakes
    ]
    assert part.shown == "vital (every 2000 ms), session (line), soon (events), slow (every 1000 ms)"


@pytest.mark.parametrize(
    ("settings", "priorities"),
    [
        # Without a task that handles release, nobody waits for the session.
        (("rate: 1 Hz", "rate: 2 Hz", "rate: 4 Hz", ""), [3, 2, 1, 4]),
        # Priorities of the file hold, the others take what is left.
        (("rate: 1 Hz, priority: 2", "rate: 2 Hz", "rate: 4 Hz", ""), [2, 3, 1, 4]),
        (("rate: 1 Hz", "rate: 2 Hz", "rate: 4 Hz", "priority: 1"), [4, 3, 2, 1]),
        (("rate: 1 Hz", "rate: 2 Hz", "rate: 4 Hz", "criticality: high"), [4, 3, 2, 1]),
        (("rate: 1 Hz", "rate: 2 Hz", "rate: 4 Hz", "deadline: 300 ms"), [4, 3, 1, 2]),
        # Tasks without a deadline are last in their band.
        (("rate: 1 Hz", "criticality: low", "criticality: middle", "criticality: high"), [2, 4, 3, 1]),
    ],
)
def test_each_task_has_its_own_priority(
    tmp_path: Path, settings: tuple[str, str, str, str], priorities: list[int]
) -> None:
    runs = ("executor: a", "executor: b", "executor: c", "session: true")
    lines = [
        f"  - {{name: t{i}, {what}, {setting}}}\n"
        for i, (what, setting) in enumerate(zip(runs, settings, strict=True))
    ]
    part = tasks(tmp_path, "tasks:\n" + "".join(lines))
    assert [task.priority for task in part.tasks] == priorities


def test_a_stack_is_at_least_that_of_the_operating_system(tmp_path: Path) -> None:
    text = "tasks: [{name: a, executor: a, stack: 2 KiB}, {name: b, executor: b, stack: 300001}]\n"
    part = tasks(tmp_path, text)
    assert part.stacks == "a 262144, b 300008, session 262144 bytes"
    manifest = json.loads((rendered(tmp_path, HEAD + NODES + OTHER + text) / "manifest.json").read_text())
    assert manifest["features"]["tasks"]["values"]["tasks"][1] == {
        "name": "b",
        "entry": "rclc_tasks_run_events",
        "executor": 1,
        "period_us": 0,
        "interval_us": 0,
        "deadline_us": 0,
        "criticality": "middle",
        "time_us": 0,
        "lock_us": 0,
        "lock_instructions": 0,
        "lock_auto": False,
        "overrun": "skip",
        "stack": 300_008,
        "stack_auto": False,
        "priority": 3,
        "level": 1,
    }


def test_a_stack_that_an_image_decides_is_said_to_be_unknown_before(tmp_path: Path) -> None:
    text = "tasks: [{name: a, executor: a, stack: auto}, {name: b, executor: b}]\n"
    warnings = [d.headline() for d in planned(tmp_path, HEAD + NODES + OTHER + text).warnings]
    assert [w for w in warnings if "MG-7146" in w] == [
        f"{tmp_path}/microros.yaml:16:39: warning: the stack that the task 'a' needs is not known yet: it has 262144"
        " bytes. Build the image, then run `microros-gen stacks OUT -o microros.stacks.yaml` [MG-7146]"
    ]
    (tmp_path / "microros.stacks.yaml").write_text("a: 300016\n", encoding="utf-8")
    done = planned(tmp_path, HEAD + NODES + OTHER + text)
    assert not [d for d in done.warnings if "MG-7146" in d.headline()]
    part = done.project.runtime.features.of("tasks")
    assert isinstance(part, TasksPlan)
    assert part.stacks == "a 300016, b 262144, session 262144 bytes"
    assert tmp_path / "microros.stacks.yaml" in compiler.read_paths(done)
    cmake = (rendered(tmp_path, HEAD + NODES + OTHER + text) / "CMakeLists.txt").read_text(encoding="utf-8")
    assert 'MICROROS_BUDGETS "stack of a 300016"' in cmake, "CMake compares them after each link"


def test_deadlines_that_are_met_are_in_the_report_and_the_manifest(tmp_path: Path) -> None:
    part = tasks(tmp_path, TIMES)
    assert part.analysis == "every deadline is met, control with the least slack: 540 us"
    values = json.loads((rendered(tmp_path, HEAD + NODES + OTHER + TIMES) / "manifest.json").read_text())
    rows = values["features"]["tasks"]["values"]["schedule"]
    names = ("task", "band", "priority", "t", "c", "b", "r", "d", "slack")
    assert [tuple(row[name] for name in names) for row in rows] == [
        ("control", "high", 1, 1000, 200, 60, 260, 800, 540),
        ("line", "session", 2, 1000, 100, 40, 340, 1000, 660),
        ("worker", "middle", 3, 5000, 2000, 30, 2930, 5000, 2070),
        ("log", "low", 4, 50_000, 3000, 0, 10_000, 50_000, 40_000),
    ]
    assert {t.name: t.priority for t in part.tasks} == {row["task"]: row["priority"] for row in rows}


def test_a_deadline_that_cannot_be_met_is_refused_with_what_would_do(tmp_path: Path) -> None:
    """Without `lock` a task may hold the library's lock as long as it runs."""
    with pytest.raises(UserError) as caught:
        tasks(tmp_path, TIMES.replace(", lock: 40 us", ""))
    assert (
        "microros.yaml:17:5: error: the task 'control' may end 2200 us after its release is due, and its deadline is"
        " 800 us (time 200; blocking 2000: worker holds library for 2000 us)."
    ) in without_id(str(caught.value))
    assert "Write `interval: 2700 us` or more, or `lock: 700 us` of 'worker' or less" in str(caught.value)
    assert "Write `time: 600 us` of 'worker' or less, or `lock: 600 us` of" in str(caught.value)
    tasks(tmp_path, TIMES.replace("lock: 40 us", "lock: 600 us"))
    with pytest.raises(UserError, match="the task 'control' may end 801 us"):
        tasks(tmp_path, TIMES.replace("lock: 40 us", "lock: 601 us"))


COUNTED = """\
target: counted
summary: a board whose instructions take 0.1 us
extends: cortex-m4
os: freertos
network: lwip
clock_hz: 1000000
cpu_hz: 25000000
cycles_per_instruction: 2.5
"""


def counted(folder: Path, text: str, board: str = COUNTED) -> TasksPlan:
    """Plan the tasks for a board of which the speed is known."""
    (folder / "counted.yaml").write_text(board, encoding="utf-8")
    return tasks(folder, f"target: counted.yaml\nsession: {{key: 1}}\n{text}")


def test_times_follow_from_instructions_and_the_target(tmp_path: Path) -> None:
    text = TIMES.replace("time: 200 us", "instructions: 1991")
    rows = {row["task"]: (row["c"], row["c_from"]) for row in counted(tmp_path, text).schedule}
    assert rows == {
        "control": (200, "instructions"),  # of the processor's clock, not of the timer's; rounded up
        "line": (100, "time"),
        "worker": (2000, "time"),
        "log": (3000, "time"),
    }
    part = counted(tmp_path, text.replace("lock: 40 us", "lock_instructions: 301"))
    assert [row["b"] for row in part.schedule] == [60, 31, 30, 0]
    with pytest.raises(UserError, match="or `lock_instructions: 6000` of 'worker' or less"):
        counted(tmp_path, text.replace("lock: 40 us", "lock_instructions: 6001"))
    slower = COUNTED.replace("2.5", "25")
    with pytest.raises(UserError, match="1991 instructions of the task 'control' take 1991 us"):
        counted(tmp_path, text, slower)


@pytest.mark.parametrize(
    ("board", "setting", "words"),
    [
        (
            COUNTED.replace("cycles_per_instruction: 2.5\n", ""),
            "instructions: 100",
            "19:5: error: the target counted does not say how long an instruction of the task 'control' takes",
        ),
        (
            COUNTED,
            "instructions: 8001",
            "8001 instructions of the task 'control' take 801 us on counted, longer than its deadline of 800 us."
            " Write instructions: 8000 or less",
        ),
        (
            COUNTED,
            "instructions: 1000, lock: 101 us",
            "the task 'control' holds the lock for 101 us, longer than it runs. Write lock: 100 us or less",
        ),
        (
            COUNTED,
            "time: 100 us, lock_instructions: 1001",
            "the task 'control' holds the lock for 101 us, longer than it runs. Write lock_instructions: 1000 or less",
        ),
    ],
)
def test_instructions_that_cannot_be_are_refused(
    tmp_path: Path, board: str, setting: str, words: str
) -> None:
    with pytest.raises(UserError) as caught:
        counted(tmp_path, TIMES.replace("time: 200 us", setting), board)
    assert words in without_id(str(caught.value))


def test_tasks_of_which_something_is_not_said_are_named(tmp_path: Path) -> None:
    text = TIMES.replace("interval: 5 ms, time: 2 ms, lock: 40 us", "time: 2 ms").replace("time: 200 us", "")
    part = tasks(tmp_path, text)
    assert part.analysis == "not analyzed: control has no time, worker has no interval"
    assert part.schedule == []
    assert tasks(tmp_path, THREADS).gaps[-1] == "session has no time and no interval"


def test_what_is_analyzed_alone_does_not_change_the_library(tmp_path: Path) -> None:
    text = TIMES.replace("time: 3 ms, lock: 30 us", "time: 4 ms, lock: 50 us")
    first, second = (
        planned(tmp_path, HEAD + NODES + OTHER + each).project.runtime.plan_id for each in (TIMES, text)
    )
    assert first == second


def test_the_analysis_has_the_priorities_of_the_generated_tasks() -> None:
    random, kinds = Random(3), set()
    for _ in range(300):
        count = random.randint(1, 6)
        decls = [
            TaskDecl(
                f"t{i}",
                None if i == count else Named(f"e{i}"),
                period_us=0 if i == count else (period := random.choice([0, 1000, 2000, 3000])),
                interval_us=1000 if i == count or not period else 0,
                deadline_us=random.choice([0, 0, 500, 900]),
                criticality=random.choice(["", *CRITICALITIES]),
                time_us=random.randint(1, 900),
            )
            for i in range(count + 1)
        ]
        fixed = random.randrange(count + 1)
        decls[fixed] = replace(decls[fixed], priority=random.choice([0, random.randint(1, count + 1)]))
        assert gaps(decls) == ()
        order = by_priority([task_of(decl) for decl in decls])
        places = {task.name: place for place, task in enumerate(order, start=1)}
        assert [places[decl.name] for decl in decls] == list(priorities_of(decls)), decls
        kinds |= {task.band for task in order}
    assert kinds == {"session", *CRITICALITIES}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{name: t}", "16:3: error: the task 't' has nothing to run"),
        ("{name: t, executor: a, session: true}", "the task 't' has a session and an executor"),
        ("{name: t, session: true, rate: 1 Hz}", "'rate' has no effect for the task of the session"),
        ("{name: t, executor: aa}", "no node has an executor 'aa'. Did you mean 'a'?"),
        (
            "{name: t, executor: a, period: 1001 s}",
            "'period' of the task 't' is 1001 s; it must be 1 us to 1000 s",
        ),
        (
            "{name: t, executor: a, rate: 300 Hz}",
            "'rate' of the task 't' is 300 Hz: the period is no whole number of microseconds from 1 us to 1000 s. "
            "Write `period: 3333 us` instead",
        ),
        ("{name: t, executor: a, rate: 3 Hz}", "Write `period: 333333 us` instead"),
        ("{name: t, executor: a, rate: 0.0001 Hz}", "Write `period: 1000000000 us` instead"),
        ("{name: t, executor: a, rate: 0 Hz}", "must be a rate above 0 such as 100 Hz or 1 kHz"),
        ("{name: t, executor: a, rate: 1 Hz, period: 1 s}", "the task 't' has rate and period"),
        ("{name: t, executor: a, period: 1 s, interval: 1 s}", "the task 't' has period and interval"),
        (
            "{name: t, executor: a, overrun: call}",
            "'overrun' of the task 't' has no effect: it has no deadline",
        ),
        ("{name: t, executor: a, overrun: catch_up, deadline: 1 s}", "nothing is missed without a period"),
        ("{name: t, executor: a, period: 1 ms, deadline: 2 ms}", "is later than its next release"),
        (
            "{name: t, executor: a, period: 1 ms, time: 2 ms}",
            "runs 2000 us, longer than its deadline of 1000 us",
        ),
        (
            "{name: t, executor: a, period: 1 ms, time: 1 us, instructions: 9}",
            "the task 't' has time and instructions",
        ),
        (
            "{name: t, executor: a, period: 1 ms, time: 1 us, lock: 1 us, lock_instructions: 9}",
            "the task 't' has lock and lock_instructions",
        ),
        (
            "{name: t, executor: a, lock_instructions: 9}",
            "'lock_instructions' of the task 't' has no effect without",
        ),
        ("{name: t, executor: a, lock: 2 ms}", "'lock' of the task 't' has no effect without 'time'"),
        (
            "{name: t, executor: a, period: 1 ms, time: 200 us, lock: 300 us}",
            "the task 't' holds the lock for 300 us, longer than it runs. Write lock: 200 us or less",
        ),
        ("{name: t, session: true, overrun: call}", "'overrun' has no effect for the task of the session"),
        ("{name: t, executor: a}\n- {name: T, executor: b}", "duplicate task 't'; the first is in line 16"),
        ("{name: t, executor: a}\n- {name: u, executor: a}", "two tasks run the executor 'a': 't' and 'u'"),
        ("{name: t, session: true}\n- {name: u, session: true}", "two tasks run the session: 't' and 'u'"),
        ("{name: t, session: true}", "no task runs an executor"),
        ("{name: t, executor: a, priority: 3}", "the priority of the task 't' is 3, and 2 tasks have 1 to 2"),
        (
            "{name: t, executor: a, priority: 2}\n- {name: u, executor: b, priority: 2}",
            "the tasks 't' and 'u' have the priority 2",
        ),
    ],
)
def test_what_is_wrong_is_refused_with_its_place(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, f"{HEAD}{NODES}tasks:\n- {text}\n")
    assert words in without_id(str(caught.value))


def test_a_task_without_anything_to_run_does_not_count_as_the_session(tmp_path: Path) -> None:
    with pytest.raises(UserError) as raised:
        planned(tmp_path, f"{HEAD}{NODES}tasks:\n- {{name: t}}\n- {{name: s, session: true}}\n")
    assert "has nothing to run" in str(raised.value)
    assert "two tasks run the session" not in str(raised.value)


def test_an_executor_of_several_nodes_needs_the_name_of_its_node(tmp_path: Path) -> None:
    nodes = "nodes: [{name: x, executors: [{name: a}]}, {name: y, executors: [{name: a}]}]\n"
    with pytest.raises(UserError, match=r"several nodes have an executor 'a'\. Write one of /x/a, /y/a"):
        planned(tmp_path, f"{HEAD}{nodes}tasks: [{{name: t, executor: a}}]\n")
    part = planned(tmp_path, f"{HEAD}{nodes}tasks: [{{name: t, executor: y/a}}]\n").project.runtime
    assert [task.executor for task in part.features.of("tasks").tasks] == [1, None]  # type: ignore[attr-defined]


def test_there_are_at_most_30_tasks(tmp_path: Path) -> None:
    names = [f"t{i}" for i in range(31)]
    nodes = f"nodes: [{{name: x, executors: [{', '.join(f'{{name: {n}}}' for n in names)}]}}]\n"
    each = "".join(f"- {{name: {name}, executor: {name}}}\n" for name in names)
    with pytest.raises(UserError, match="the application has 31 tasks; it may have 30"):
        planned(tmp_path, f"{HEAD}{nodes}tasks:\n{each}")


def test_a_target_without_tasks_refuses_them_by_its_name(tmp_path: Path) -> None:
    text = "target: {name: qemu-mps2-an385}\ntasks: [{name: t, executor: a}]\n"
    with pytest.raises(UserError) as caught:
        planned(tmp_path, HEAD + NODES + OTHER + text)
    words = "the target qemu-mps2-an385 has no tasks: its operating system is port_bare. Remove `tasks:`"
    assert words in str(caught.value)


def test_the_component_without_tasks_is_refused(tmp_path: Path) -> None:
    text = HEAD.replace("+timers", "+timers, +tasks") + NODES
    with pytest.raises(UserError, match="the component 'tasks' is for the tasks that the application file"):
        planned(tmp_path, text)


def test_the_time_of_a_hold_follows_from_what_was_found_in_the_image(tmp_path: Path) -> None:
    text = TIMES.replace("time: 200 us", "instructions: 1991").replace("lock: 40 us", "lock: auto")
    locks = tmp_path / "microros.locks.yaml"
    with pytest.raises(UserError, match="blocking 2000: worker holds library for 2000 us"):
        counted(tmp_path, text)  # all of its time, until an image was measured
    locks.write_text("worker: 301\n", encoding="utf-8")
    part = counted(tmp_path, text)
    assert [(row["b"], row["b_from"]) for row in part.schedule] == [
        (60, "declared"),
        (31, "call graph"),
        (30, "declared"),
        (0, ""),
    ]
    locks.write_text("worker: 20001\n", encoding="utf-8")  # longer than a run can be
    with pytest.raises(UserError, match="worker holds library for 2000 us"):
        counted(tmp_path, text)
