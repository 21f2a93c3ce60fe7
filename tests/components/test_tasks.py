# SPDX-License-Identifier: Apache-2.0
"""Tasks of the application file: priorities, releases, wake-ups; what is wrong in it; what a report says."""

from __future__ import annotations

import json
import socket
import subprocess
import threading
from pathlib import Path

import pytest

from microros_gen.components.tasks.plan import TasksPlan
from microros_gen.diagnostics import UserError
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
  - {name: tells, executor: c, period: 1 ms, overrun: call}
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
SENT, RECEIVED = 40, 20
THREAD_SANITIZER = ("-std=gnu99", "-g", "-O0", "-fsanitize=thread", f"-I{UNITS}")


def serve(agent: ReadingAgent, served: socket.socket) -> None:
    """Answer datagrams until the socket is closed; offer a sample with each of the first messages of the device."""
    offered = 0
    while True:
        try:
            datagram, peer = served.recvfrom(2048)
        except OSError:
            return
        answers = agent.receive(datagram)
        if agent.reads and offered < RECEIVED:
            answers += agent.numbers(1, offered)
            offered += 1
        for answer in [*answers, *(agent.tick() if agent.unacknowledged else [])]:
            served.sendto(answer, peer)


def tasks(folder: Path, text: str) -> TasksPlan:
    part = planned(folder, HEAD + NODES + OTHER + text).project.runtime.features.of("tasks")
    assert isinstance(part, TasksPlan)
    return part


def test_releases_keep_to_their_grid(tmp_path: Path) -> None:
    out = rendered(tmp_path, HEAD + NODES + OTHER + PERIODS)
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


@pytest.mark.system
@pytest.mark.parametrize("flags", [SANITIZE, THREAD_SANITIZER], ids=["memory", "threads"])
def test_tasks_do_not_race(tmp_path: Path, flags: tuple[str, ...]) -> None:
    out = rendered(tmp_path, HEAD + NODES + OTHER + THREADS)
    sources = sorted((out / "src").rglob("*.c"))
    objects = compile_merged(Tree(out, ()), sources, [UNITS / "task_threads.c"], SANITIZER, flags)
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
        "executor": 1,
        "period_us": 0,
        "interval_us": 0,
        "deadline_us": 0,
        "criticality": "middle",
        "time_us": 0,
        "overrun": "skip",
        "stack": 300_008,
        "priority": 3,
        "level": 1,
    }


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
        ("{name: t, executor: a, rate: 300 Hz}", "'rate' of the task 't' is 300 Hz: the period is no number"),
        ("{name: t, executor: a, rate: 1 Hz, period: 1 s}", "the task 't' has rate and period"),
        ("{name: t, executor: a, period: 1 s, interval: 1 s}", "the task 't' has period and interval"),
        ("{name: t, executor: a, overrun: call}", "'overrun' of the task 't' has no effect"),
        ("{name: t, executor: a, period: 1 ms, deadline: 2 ms}", "is later than its next release"),
        (
            "{name: t, executor: a, period: 1 ms, time: 2 ms}",
            "runs 2000 us, longer than its deadline of 1000 us",
        ),
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
