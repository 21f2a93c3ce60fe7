# SPDX-License-Identifier: Apache-2.0
"""Who is taken for gone: one that is, after its time-out; not one whose line loses what it says."""

from __future__ import annotations

import random

import pytest

from microros_gen.agent.limits import Limits
from microros_gen.agent.liveliness import stretch
from microros_gen.agent.wire.constants import INFO_ACTIVITY, OBJECT_CLIENT
from microros_gen.agent.wire.session_messages import GetInfo
from tests.support.agent.dialogue import entities, message
from tests.support.agent.fakes import Bench
from tests.support.agent.newcomers import hello

STEP_S = 0.05
SIGN_OF_LIFE = message(GetInfo(1, OBJECT_CLIENT, INFO_ACTIVITY), stream=0)


def quiet(timeout_ms: int, **limits: int) -> Bench:
    """Return the bench of a client with its own time-out, which speaks when it is asked."""
    bench = Bench(Limits(**limits))
    bench.say(hello(1, timeout_ms=timeout_ms))
    for create in entities():
        bench.say(message(create, stream=0))
    return bench


def live(bench: Bench, seconds: float, loss: float, chance: random.Random) -> int:
    """Answer requests if request and answer arrive; return how often the client timed out."""
    (client,) = bench.agent.clients
    dropped = 0
    for _ in range(round(seconds / STEP_S)):
        was_asleep = client.asleep
        probes = bench.wait(STEP_S, STEP_S)
        dropped += client.asleep and not was_asleep
        if client.asleep:
            bench.say(SIGN_OF_LIFE)
        for _ in probes:
            if chance.random() >= loss and chance.random() >= loss:
                bench.say(SIGN_OF_LIFE)
    return dropped


@pytest.mark.system
@pytest.mark.parametrize("timeout_ms", [2_000, 10_000])
def test_a_line_that_loses_a_third_is_not_dead(timeout_ms: int) -> None:
    """An hour: with a time-out that ignores the quality of the line it would time out a dozen times."""
    bench = quiet(timeout_ms)
    chance = random.Random(timeout_ms)
    live(bench, 20 * timeout_ms / 1_000, 0.3, chance)  # it has to be known first
    assert live(bench, 3_600, 0.3, chance) <= 1


def test_on_a_lossless_line_the_time_out_stays_as_set() -> None:
    bench = quiet(2_000)
    assert live(bench, 60, 0.0, random.Random(1)) == 0
    (client,) = bench.agent.clients
    received_at = client.last_received
    while not client.asleep:
        bench.wait(STEP_S, STEP_S)
    assert bench.now - received_at == pytest.approx(2.0, abs=0.11)


@pytest.mark.parametrize("loss", [0.3, 0.6])
def test_one_that_has_gone_is_noticed_on_a_bad_line_too(loss: float) -> None:
    bench = quiet(2_000)
    live(bench, 200, loss, random.Random(2))
    (client,) = bench.agent.clients
    bench.say(SIGN_OF_LIFE)
    received_at = client.last_received
    while not client.asleep:
        bench.wait(STEP_S, STEP_S)
    assert 2.0 < bench.now - received_at <= 4.2


def test_a_line_that_got_better_is_trusted_again() -> None:
    bench = quiet(2_000)
    chance = random.Random(3)
    live(bench, 200, 0.5, chance)
    (client,) = bench.agent.clients
    assert client.loss > 0.3
    live(bench, 120, 0.0, chance)
    assert client.loss < 0.05


def test_the_time_out_grows_with_the_losses_and_at_most_doubles() -> None:
    assert stretch(0.0) == stretch(0.1) == 1.0
    assert 1.3 < stretch(0.51) < 2.0, "a third lost each way"
    assert stretch(0.9) == stretch(1.0) == 2.0


def test_where_places_are_rare_all_are_asked_in_time() -> None:
    """One with a time-out of a day is not asked before half of it, unless somebody may need its place."""
    bench = quiet(86_400_000)
    assert bench.wait(60) == []
    full = quiet(86_400_000, clients=1, client_timeout_s=10)
    assert full.wait(6)
