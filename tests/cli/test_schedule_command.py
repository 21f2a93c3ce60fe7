# SPDX-License-Identifier: Apache-2.0
"""`schedule`: the deadlines of what was generated as a table, as JSON and as a time line; what it says without them."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

from tests.support.command_line import Runner

NODES = """\
version: 1
profiles: [pure_sender]
components: [+executor]
nodes: [{name: arm, publishers: [{topic: p, type: std_msgs/msg/Int32}], executors: [{name: motor}, {name: log}]}]
"""
TASKS = """\
tasks:
  - {name: control, executor: motor, rate: 1 kHz, deadline: 800 us, criticality: high, time: 200 us, lock: 20 us}
  - {name: log, executor: log, period: 50 ms, time: 3 ms, lock: 30 us, criticality: low}
  - {name: session, session: true, interval: 2 ms, time: 100 us, lock: 60 us}
"""
SVG = "{http://www.w3.org/2000/svg}"


def generated(run: Runner, folder: Path, text: str) -> str:
    (folder / "microros.yaml").write_text(text, encoding="utf-8")
    done = run("generate", "-o", "out")
    assert done.status == 0, done.err
    return done.out


def test_a_missed_deadline_ends_every_command_that_plans(run: Runner, folder: Path) -> None:
    (folder / "microros.yaml").write_text(NODES + TASKS, encoding="utf-8")
    for command in (("generate", "-o", "out"), ("build", "-o", "out"), ("resolve",)):
        done = run(*command)
        assert done.status == 2
        assert done.err.startswith(
            "microros.yaml:8:5: error: the task 'session' may end 3900 us after its release is due, and its deadline"
            " is 2000 us (time 100; control 4 x 200; log 1 x 3000)."
        )


def test_the_table_json_and_picture_are_those_of_the_analysis(run: Runner, folder: Path) -> None:
    out = generated(run, folder, NODES + TASKS.replace("true, interval: 2 ms", "true, interval: 5 ms"))
    assert "schedule   every deadline is met, control with the least slack: 540 us (tasks)\n" in out
    assert (
        run("schedule", "out").out
        == """\
TASK     BAND     PRIORITY  T      C     B   R     D      SLACK  C FROM  B FROM    BLOCKED BY
control  high     1         1000   200   60  260   800    540    time    declared  session holds library for 60 us
log      low      2         50000  3000  60  3860  50000  46140  time    declared  session holds library for 60 us
session  session  3         5000   100   0   3900  5000   1100   time
"""
    )
    data = json.loads(run("schedule", "out", "--format", "json").out)
    manifest = json.loads((folder / "out" / "manifest.json").read_text(encoding="utf-8"))
    assert data == {"version": 1, "tasks": manifest["features"]["tasks"]["values"]["schedule"], "notes": []}
    assert [(row["task"], row["slack"]) for row in data["tasks"]] == [
        ("control", 540),
        ("log", 46_140),
        ("session", 1100),
    ]
    for arguments, title in (((), "control"), (("--task", "log"), "log")):
        assert run("schedule", "out", "--format", "svg", *arguments, "-o", "line.svg").out == ""
        root = ElementTree.parse(folder / "line.svg").getroot()
        assert root.findtext(f"{SVG}title") == f"Worst phasing of {title}"


def test_a_bound_that_posix_threads_do_not_have_is_said_once_with_its_place(
    run: Runner, folder: Path
) -> None:
    text = NODES + TASKS.replace("lock: 20 us", "lock: auto").replace("lock: 30 us", "lock: auto")
    text = text.replace("true, interval: 2 ms", "true, interval: 5 ms").replace(
        "deadline: 800 us", "deadline: 900 us"
    )
    text = text.replace("time: 3 ms", "time: 300 us")
    (folder / "microros.yaml").write_text(text, encoding="utf-8")
    line = text.splitlines()[5]
    column = line.index("auto") + 1
    warning = (
        f"microros.yaml:6:{column}: warning: how long a task holds the lock has no bound on the target host: the C"
        " library is a shared one, and no number of cycles bounds an instruction beside a kernel and caches; until"
        " then all of the time of 'control', 'log' counts. Write what you measured, `lock: 40 us`, or build for a"
        " board: `target: {name: cortex-m4f, rtos: freertos}` [MG-9874]\n"
        f"  {line}\n  {' ' * (column - 1)}^~~~\n"
    )
    done = run("generate", "-o", "out")
    assert (done.status, done.err) == (0, warning)
    shown = run("schedule", "out", "--format", "json")
    assert (shown.status, shown.err) == (0, warning)
    (note,) = json.loads(shown.out)["notes"]
    assert note["id"] == "MG-9874"
    assert note["place"] == {
        "file": "microros.yaml",
        "line": 6,
        "column": column,
        "end_column": column + 4,
        "text": line,
    }
    pasted = text.replace("lock: auto", "lock: 40 us")
    (folder / "microros.yaml").write_text(pasted, encoding="utf-8")
    assert run("generate", "-o", "out").err == ""
    assert run("schedule", "out").err == "", "what was declared is what the analysis used"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "error: out has no tasks. Declare them in microros.yaml"),
        (
            TASKS.replace(", time: 200 us, lock: 20 us", "").replace("interval: 2 ms, ", ""),
            "error: the deadlines of out were not analyzed: control has no time, session has no interval.",
        ),
    ],
)
def test_without_an_analysis_it_says_what_is_missing(
    run: Runner, folder: Path, text: str, words: str
) -> None:
    generated(run, folder, NODES + text)
    done = run("schedule", "out")
    assert (done.status, done.out) == (2, "")
    assert words in done.err


def test_wrong_use(run: Runner, folder: Path) -> None:
    assert run("schedule", "out").status == 2
    generated(run, folder, NODES + TASKS.replace("true, interval: 2 ms", "true, interval: 5 ms"))
    unused = run("schedule", "out", "--task", "log")
    assert (unused.status, "--task chooses the time line" in unused.err) == (2, True)
    unknown = run("schedule", "out", "--format", "svg", "--task", "lgo")
    assert (unknown.status, "no task 'lgo'. Did you mean 'log'?" in unknown.err) == (2, True)
    manifest = folder / "out" / "manifest.json"
    for text in ("[]", "{", manifest.read_text(encoding="utf-8").replace('"band": "low"', '"band": "wide"')):
        manifest.write_text(text, encoding="utf-8")
        done = run("schedule", "out")
        assert done.status == 2
        assert "was not written by this version of microros-gen. Generate the folder again" in done.err
