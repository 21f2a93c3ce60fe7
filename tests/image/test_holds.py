# SPDX-License-Identifier: Apache-2.0
"""How long a lock is held, on functions of a few instructions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import pytest

from microros_gen.image.flow import Flow, Step
from microros_gen.image.holds import Holds, Rules
from microros_gen.image.lock_holds import TaskHold
from microros_gen.image.paths import Length

NAMES = {
    1: "port_lock",
    2: "port_unlock",
    100: "run",
    200: "helper",
    300: "other",
    400: "port_send",
    500: "asks",
}


def flow(address: int, *codes: str) -> Flow:
    """Return a function: `x` an instruction, `L`, `U`, `h`, `o`, `p`, `a` calls, `?n`, `!n` and `~n` jumps by n places
    (`!`: if the call before returned zero), `r` the return."""
    calls = {"L": 1, "U": 2, "h": 200, "o": 300, "p": 400, "a": 500}
    steps = {}
    for at, code in enumerate(codes):
        here, on = address + at, (address + at + 1,)
        if code == "r":
            steps[here] = Step(here, returns=True)
        elif code[0] in "?!~":
            to = here + int(code[1:])
            steps[here] = Step(
                here, (to,) if code[0] == "~" else (to, *on), tested=500 if code[0] == "!" else None
            )
        else:
            steps[here] = Step(here, on, call=calls.get(code))
    return Flow(NAMES[address], address, steps, {})


def held(
    flows: list[Flow], zero: frozenset[int] = frozenset(), rounds: int = 3
) -> Mapping[str, tuple[int, ...]]:
    """Return the holds below `run` by the function that takes the lock: how long, and how much is open."""
    rules = Rules(
        rounds=lambda *_: Length(rounds),
        through=lambda _: None,
        bytes=lambda *_: None,
        of_port=lambda _, length: Length(50) if length.open else length,
        zero=zero,
    )
    found = Holds({f.address: f for f in flows}, NAMES, rules).below(100)
    assert all(not hold.length.open for hold in found), found
    names = dict.fromkeys(hold.function for hold in found)
    return {name: tuple(h.length.count for h in found if h.function == name) for name in names}


def test_a_hold_is_the_longest_path_between_the_calls() -> None:
    assert held([flow(100, "x", "L", "x", "?3", "x", "x", "x", "U", "x", "r")]) == {"run": (6,)}


def test_what_is_called_counts_and_so_does_a_loop_around_it() -> None:
    helper = flow(200, "x", "x", "r")
    assert held([flow(100, "L", "h", "U", "r"), helper]) == {"run": (5,)}
    assert held([flow(100, "L", "h", "?-1", "U", "r"), helper]) == {"run": (4 * 5 + 1,)}


def test_the_holder_may_take_the_lock_again() -> None:
    assert held([flow(100, "L", "x", "h", "x", "U", "r"), flow(200, "L", "x", "U", "r")]) == {"run": (8,)}


def test_a_function_that_rests_ends_one_hold_and_begins_another() -> None:
    """As microros_pause does: the hold of the caller goes on after it, for as long as that keeps the lock."""
    rests = flow(200, "x", "x", "U", "x", "L", "x", "r")
    assert held([flow(100, "L", "x", "h", "x", "x", "x", "U", "r"), rests]) == {"run": (6, 5)}
    loop = flow(100, "L", "x", "h", "?-2", "x", "U", "r")
    assert held([loop, rests], rounds=1000) == {"run": (8, 5)}, "no round of the loop keeps the lock"


def test_a_lock_that_a_function_takes_is_held_by_its_caller() -> None:
    assert held(
        [flow(100, "x", "h", "x", "x", "o", "r"), flow(200, "L", "x", "r"), flow(300, "x", "U", "r")]
    ) == {"run": (7,)}


def test_a_function_of_the_port_without_a_bound_has_the_number_of_the_rule() -> None:
    assert held([flow(100, "L", "p", "U", "r")]) == {"run": (52,)}
    assert held([flow(100, "L", "p", "U", "r"), flow(400, "x", "r")]) == {"run": (4,)}


def test_what_a_function_never_returns_is_no_path() -> None:
    code = [flow(100, "L", "a", "!6", "x", "x", "x", "x", "x", "U", "r"), flow(500, "x", "r")]
    assert held(code) == {"run": (10,)}
    assert held(code, zero=frozenset({500})) == {"run": (5,)}


def test_what_has_no_bound_is_named() -> None:
    rules = Rules(
        lambda *_: Length(1, frozenset({"loop"})), lambda _: None, lambda *_: None, lambda _, length: length
    )
    for code, why in (
        (("L", "o", "U", "r"), "other: its code is not in the image"),
        (("L", "x", "?-1", "U", "r"), "loop"),
        (("L", "h", "U", "r"), "helper: recursion"),
    ):
        flows = {f.address: f for f in (flow(100, *code), flow(200, "x", "h", "r"))}
        (hold,) = Holds(flows, NAMES, rules).below(100)
        assert hold.length.open == {why}


@pytest.mark.parametrize(
    ("task", "through", "why"),
    [
        (
            {100: Step(100, (101,), through=True), 101: Step(101, returns=True)},
            None,
            "a call through a pointer",
        ),
        ({100: Step(100, (101,), through=True), 101: Step(101, returns=True)}, {200}, ""),
        ({100: Step(100, lost=True), 101: Step(101, returns=True)}, None, "a jump"),
        ({100: Step(100, (101,), call=400), 101: Step(101, returns=True)}, None, ""),
        ({100: Step(100, (101,), call=300), 101: Step(101, returns=True)}, None, "a call through a pointer"),
        (
            {
                100: Step(100, (101,), call=1),
                101: Step(101, (102,), call=2),
                102: Step(102, (103,), through=True),
                103: Step(103, returns=True),
            },
            None,
            "a call through a pointer",
        ),
    ],
    ids=["unknown", "known", "jump", "of the port", "in what is called", "after the lock"],
)
def test_what_is_called_without_the_lock_may_take_it(
    task: Mapping[int, Step], through: set[int] | None, why: str
) -> None:
    """A task whose path is lost outside the lock has no bound, as what it calls there may hold it for long."""
    calls = {0: Step(0, (1,), through=True), 1: Step(1, returns=True)}
    port, other = (
        {to + at: replace(calls[at], address=to + at, next=(to + 1,) * (at == 0)) for at in calls}
        for to in (400, 300)
    )
    flows = {
        100: Flow("run", 100, dict(task), {}),
        200: flow(200, "L", *"x" * 100, "U", "r"),
        300: Flow("other", 300, other, {}),
        400: Flow("port_send", 400, port, {}),
    }
    targets = None if through is None else frozenset(through)
    rules = Rules(lambda *_: Length(1), lambda _: targets, lambda *_: None, lambda _, length: length)
    holds = Holds(flows, NAMES, rules)
    found = TaskHold("run", holds.below(100), True, 0, unseen=holds.unseen(100))
    assert [each.partition(": ")[2].rpartition(" at ")[0] for each in found.open] == [why] * bool(why)
    taken = 101 if through else 0
    assert found.instructions == (None if why else taken)
