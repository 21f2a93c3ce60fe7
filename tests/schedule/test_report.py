# SPDX-License-Identifier: Apache-2.0
"""The analysis as a table, as data, as a picture and as diagnostics."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ElementTree
from fractions import Fraction

import pytest

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.schedule.check import check_deadlines
from microros_gen.schedule.report import HEAD, schedule_data, schedule_of, schedule_rows
from microros_gen.schedule.response import analyze
from microros_gen.schedule.task import HIGH, LONGEST_US, Section, Task, time_of_instructions
from microros_gen.schedule.timeline import draw

LOCK = (Section("session", 40),)
TASKS = [
    Task("log", 100_000, 2000, criticality="low", sections=LOCK, sporadic=True),
    Task("control", 1000, 200, criticality=HIGH, deadline_us=500, sections=(Section("session", 20),)),
    Task("session", 5000, 300, session=True, sections=LOCK, blocking_us=5),
]
SVG = "{http://www.w3.org/2000/svg}"


def messages(tasks: list[Task], places: dict[str, Span] | None = None) -> list[str]:
    diagnostics = Diagnostics()
    check_deadlines(tasks, places or {}, diagnostics)
    return [d.headline() for d in diagnostics]


def test_a_row_for_each_task_the_highest_priority_first() -> None:
    rows = list(schedule_rows(analyze(TASKS)))
    assert rows == [
        (
            "control",
            "high",
            "1",
            "1000",
            "200",
            "40",
            "240",
            "500",
            "260",
            "time",
            "declared",
            "session holds session for 40 us",
        ),
        (
            *("session", "session", "2", "5000", "300", "45", "545", "5000", "4455", "time", "declared"),
            "log holds session for 40 us, other code for 5 us",
        ),
        ("log", "low", "3", "100000", "2000", "0", "2900", "100000", "97100", "time", "", ""),
    ]
    assert {len(row) for row in rows} == {len(HEAD)}


def test_the_data_has_the_names_of_the_table_in_lower_case() -> None:
    data = json.loads(json.dumps(schedule_data(analyze(TASKS))))
    assert {name.lower().replace(" ", "_") for name in HEAD} <= set(data[0])
    assert data[1] == {
        "task": "session",
        "band": "session",
        "priority": 2,
        "t": 5000,
        "c": 300,
        "c_from": "time",
        "instructions_per_us": None,
        "j": 0,
        "b": 45,
        "b_from": "declared",
        "r": 545,
        "d": 5000,
        "slack": 4455,
        "meets": True,
        "overloaded": False,
        "blocked_by": [{"task": "log", "lock": "session", "time": 40, "from": "declared"}],
        "delayed_by": [{"task": "control", "times": 1, "time": 200}],
    }


def test_the_data_is_the_whole_analysis() -> None:
    """What is read from it prints, and draws, the same."""
    counted = Task("a", 10, 6, instructions_per_us=Fraction(5, 3))
    for tasks in (TASKS, [counted, Task("b", 10, 6, deadline_us=20, jitter_us=3)]):
        responses = analyze(tasks)
        data = schedule_data(responses)
        read = schedule_of(json.loads(json.dumps(data)))
        assert schedule_data(read) == data
        assert list(schedule_rows(read)) == list(schedule_rows(responses))
        assert draw(read, tasks[0].name) == draw(responses, tasks[0].name)


@pytest.mark.parametrize(
    "change", [{"band": "upper"}, {"t": 0}, {"c": "1"}, {"blocked_by": None}, {"instructions_per_us": "1/"}]
)
def test_other_data_is_refused(change: dict[str, object]) -> None:
    (first, *_) = schedule_data(analyze(TASKS))
    with pytest.raises((TypeError, ValueError)):
        schedule_of([{**first, **change}])


def test_a_response_without_bound_is_a_dash_and_null() -> None:
    responses = analyze([Task("a", 10, 6), Task("b", 10, 6, deadline_us=20)])
    assert list(schedule_rows(responses))[1][6:9] == ("-", "20", "-")
    assert (schedule_data(responses)[1]["r"], schedule_data(responses)[1]["overloaded"]) == (None, True)


def test_the_picture_has_a_bar_where_a_task_runs_and_a_mark_for_each_deadline() -> None:
    root = ElementTree.fromstring(draw(analyze(TASKS), "control"))
    bars = [(bar.get("class"), bar.findtext(f"{SVG}title")) for bar in root.iter(f"{SVG}rect")]
    assert bars[:3] == [
        ("blocks", "session 0 to 40 us"),
        ("run", "control 40 to 240 us"),
        ("run", "session 240 to 540 us"),
    ]
    assert [path.get("class") for path in root.iter(f"{SVG}path")].count("due") == 1
    texts = [text.text for text in root.iter(f"{SVG}text")]
    assert texts[:3] == ["control", "session", "log"]
    assert texts[3:6] == ["0 us", "100 us", "200 us"]
    assert texts[-1] == "1 ms"


def test_a_deadline_that_is_missed_is_marked() -> None:
    late = draw(analyze([Task("fast", 10, 4), Task("slow", 40, 9, deadline_us=15)]), "slow")
    assert re.findall(r'class="(late|due)"', late) == ["due"] * 4 + ["late"]


def test_a_missed_deadline_is_refused_with_the_numbers_that_would_do() -> None:
    source = Source("microros.yaml", "tasks:\n  - slow\n")
    tasks = [Task("fast", 10, 4), Task("slow", 40, 9, deadline_us=15)]
    assert messages(tasks, {"slow": Span(source, 2, 5)}) == [
        "microros.yaml:2:5: error: the task 'slow' may end 17 us after its release is due, and its deadline is 15 us"
        " (time 9; fast 2 x 4). Write `deadline: 17 us` or more, or `time: 7 us` or less [MG-7142]"
    ]


def test_a_task_that_no_clock_releases_gets_another_interval() -> None:
    tasks = [Task("fast", 10, 4), Task("slow", 15, 9, sporadic=True)]
    assert "Write `interval: 17 us` or more" in messages(tasks)[0]


def test_what_blocks_and_jitter_are_named() -> None:
    late = Task("late", 100, 10, deadline_us=20, jitter_us=3, sections=(Section("session", 1),))
    below = Task("below", 1000, 50, sections=(Section("session", 30),))
    (message,) = messages([late, below])
    assert "may end 43 us after its release is due" in message
    assert "(time 10; jitter 3; blocking 30: below holds session for 30 us)" in message
    assert message.endswith("Write `deadline: 43 us` or more, or `lock: 7 us` of 'below' or less [MG-7142]")


def test_the_parts_of_a_response_add_up_where_earlier_releases_delay_it() -> None:
    tasks = [
        Task("control", 1000, 250),
        Task("session", 1000, 300, deadline_us=1001),
        Task("worker", 8949, 4000, sporadic=True),
    ]
    (message,) = messages(tasks)
    assert "may end 8957 us" in message
    parts = (
        "(time 8 x 4000; control 72 x 250; session 72 x 300; less 7 x 8949, as 7 earlier releases delay it)"
    )
    assert parts in message
    assert 8 * 4000 + 72 * 250 + 72 * 300 - 7 * 8949 == 8957


def test_an_overload_is_refused_with_its_share() -> None:
    assert messages([Task("a", 10, 6), Task("b", 12, 6)]) == [
        "microros-gen: error: the task 'b' and the 1 above it take 110.0 % of the processor's time."
        " Write `period: 18 us` or more, or `time: 4 us` or less [MG-7140]"
    ]
    alone = messages([Task("a", 10, 11)])
    assert alone[0].startswith("microros-gen: error: the task 'a' takes 110.0 % of the processor's time")


def test_tasks_that_leave_next_to_nothing_are_refused() -> None:
    period = 999_999
    tasks = [
        Task("a", 1_000_000, 500_000),
        Task("b", period, period // 2, deadline_us=LONGEST_US, blocking_us=100_000),
    ]
    (message,) = messages(tasks)
    assert "no bound was found for the response of the task 'b'" in message
    assert message.endswith("[MG-7141]")


def test_where_no_number_is_enough_the_hint_says_so() -> None:
    tasks = [Task(name, 10, 10, criticality=HIGH, deadline_us=25) for name in ("first", "second")]
    first, second = messages([*tasks, Task("third", 10, 1)])
    hint = "No number of one task is enough: give several tasks less time or longer periods [MG-7140]"
    assert first.endswith(hint)
    assert second.endswith("Correct 'second' first [MG-7140]")


def test_the_time_of_instructions_is_rounded_up() -> None:
    rate = Fraction(25, 17)
    assert [time_of_instructions(count, rate) for count in (1, 25, 26, 1000)] == [1, 17, 18, 680]


def test_what_would_do_is_a_number_of_instructions_where_the_task_has_one() -> None:
    """The number fits, and the next microsecond does not."""
    rate = Fraction(3, 2)
    tasks = [
        Task("fast", 1000, 400, instructions_per_us=rate),
        Task("slow", 2000, 700, deadline_us=1000, instructions_per_us=rate),
    ]
    (message,) = messages(tasks)
    assert message.endswith("Write `deadline: 1500 us` or more, or `instructions: 900` or less [MG-7142]")
    fits, late = (Task("slow", 2000, us, deadline_us=1000) for us in (time_of_instructions(900, rate), 601))
    assert messages([tasks[0], fits]) == []
    assert messages([tasks[0], late]) != []
