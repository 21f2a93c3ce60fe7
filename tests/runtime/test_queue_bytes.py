# SPDX-License-Identifier: Apache-2.0
"""Queues whose samples share bytes (`queue_bytes`): which samples fit, are requested, are dropped and move."""

from __future__ import annotations

import random
import struct

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import QueuePlan, SubscriptionPlan
from tests.support.plans import DECLARED, INT32, READER, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.harness import STRING
from tests.support.runtime.places import Places, text

LARGEST, BYTES, FAST_BYTES, SLOTS = 400, 800, 700, 10
PLAN = changed(
    DECLARED,
    entities__subscriptions__declared=(
        SubscriptionPlan(0, 0, "/arm/go", "rt/arm/go", STRING, True),
        SubscriptionPlan(1, 0, "/arm/fast", "rt/arm/fast", STRING, False),
        SubscriptionPlan(2, 0, "/arm/number", "rt/arm/number", INT32, True),
    ),
    entities__subscriptions__max=3,
    input__queues=(QueuePlan(SLOTS, LARGEST, BYTES), QueuePlan(SLOTS, 300, FAST_BYTES), QueuePlan(3, 16)),
    input__size=320,
    input__reliable_slots=2,
    input__reliable_slot_size=320,
    input__arrives_in_fragments=True,
)
SLEEPLESS = changed(
    PLAN,
    input__arrives_in_fragments=False,
    input__queues=(QueuePlan(SLOTS, 200, 400), *PLAN.input.queues[1:]),
)
"""Every sample comes whole."""
OPENED = ("String go reliable", "String fast best_effort", "Int32 number reliable")
GO, FAST, NUMBER = range(3)
FIRST = PLAN.entities.publisher_places


def share(size: int) -> int:
    """Return what a text takes of a queue."""
    return len(text(size, "x")) + 3 & ~3


def offered(places: Places, index: int, *samples: tuple[int, str]) -> None:
    places.send(places.agent.offer(FIRST + index, *(text(size, letter) for size, letter in samples)))


def asked(places: Places, index: int) -> list[int]:
    """Return how many samples each READ_DATA of a subscription has asked for."""
    reader = (((FIRST + index) << 4) | 6).to_bytes(2, "big")
    return [r.samples for r in places.agent.reads if r.reader == reader]


def test_a_reliable_one_asks_for_what_fits_whatever_the_sizes_are(bench: Bench) -> None:
    """Two of the largest fit an empty queue; small ones leave room for more of them."""
    places = Places(bench, PLAN, OPENED)
    assert asked(places, GO) == [2]
    assert asked(places, NUMBER) == [3], "a queue without the key"
    offered(places, GO, *((20, letter) for letter in "abcdefghijkl"))
    places.client.spin(30)
    assert 10 * share(20) + LARGEST < BYTES
    assert sum(asked(places, GO)) == SLOTS, "no more samples than `queue`"
    assert places.take(GO) == "a" * 20
    places.client.spin(6)
    assert asked(places, GO)[-1] == 1
    assert [places.take(GO) for _ in range(12)] == [letter * 20 for letter in "bcdefghijkl"] + [None]
    assert places.counted(GO) == (0, 0)


def test_as_many_of_the_largest_fit_after_any_sequence(bench: Bench) -> None:
    """The end of the queue is never too near: waiting samples move, also while fragments of the next one arrive."""
    places = Places(bench, PLAN, OPENED)
    offered(places, GO, (20, "s"), (395, "a"))
    places.client.spin(12)
    assert places.take(GO) == "s" * 20
    places.client.spin(6)
    assert asked(places, GO)[-1] == 1, "one is here, and another one of the largest has room"
    chunks = places.agent.offer(FIRST + GO, text(395, "b"))
    assert len(chunks) > 4
    places.send(chunks[:3])
    places.client.spin(2)
    assert places.take(GO) == "a" * 395
    assert places.take(GO) is None, "the last one is not whole yet"
    places.send(chunks[3:])
    places.client.spin(6)
    assert places.take(GO) == "b" * 395
    offered(places, GO, (395, "c"), (395, "d"), (1, "e"))
    places.client.spin(24)
    assert [places.take(GO), places.take(GO)] == ["c" * 395, "d" * 395]
    places.client.spin(6)
    assert places.take(GO) == "e"
    assert places.counted(GO) == (0, 0)


@pytest.mark.parametrize("seed", range(3))
def test_a_best_effort_one_drops_its_oldest_and_no_more(bench: Bench, seed: int) -> None:
    """Against a model of a queue that holds what the sizes add up to."""
    chance = random.Random(seed)
    places = Places(bench, PLAN, OPENED)
    waiting: list[str] = []
    dropped = 0
    for number in range(400):
        size = chance.choice((1, 10, 60, 290, chance.randrange(1, 296)))
        waiting.append(chr(ord("a") + number % 26) * size)
        while len(waiting) > SLOTS or sum(share(len(sample)) for sample in waiting) > FAST_BYTES:
            waiting.pop(0)
            dropped += 1
        offered(places, FAST, (size, waiting[-1][0]))
        places.client.spin(1, 1)
        for _ in range(chance.choice((0, 0, 0, 0, 1, 1, 1, 20))):
            assert places.take(FAST) == (waiting.pop(0) if waiting else None)
    assert places.counted(FAST) == (dropped, 0)
    assert dropped > 50


@pytest.mark.parametrize("plan", [PLAN, SLEEPLESS], ids=["fragments", "whole"])
@pytest.mark.parametrize("seed", range(2))
def test_nothing_is_lost_under_loss_and_disorder(bench: Bench, plan: RuntimePlan, seed: int) -> None:
    """Reliable samples, each once and in order; nothing that was acknowledged had no room."""
    chance = random.Random(seed)
    places = Places(bench, plan, OPENED)
    places.agent.mtu = 64 if plan.input.arrives_in_fragments else 320
    places.agent.drop = lambda datagram: chance.random() < 0.1
    places.agent.drop_answer = lambda answer: chance.random() < 0.1
    longest = plan.input.queues[GO].slot_size - 6
    sent: list[list[str]] = [[], []]
    found: list[list[str]] = [[], []]
    for number in range(4000):
        which = chance.randrange(2)
        if len(sent[which]) < 40 and chance.random() < 0.4:
            size = chance.choice((1, 7, 40, longest, chance.randrange(1, longest)))
            sent[which].append(str(number) if which else chr(ord("a") + number % 26) * size)
            body = struct.pack("<i", number) if which else text(size, sent[which][-1][0])
            places.send(places.agent.offer(FIRST + (NUMBER if which else GO), body))
        places.send(places.agent.tick())
        if chance.random() < 0.3 and len(places.client.queued) > 1:
            chance.shuffle(places.client.queued)
        places.client.spin(1, 20)
        which = chance.randrange(2)
        taken = places.take(NUMBER if which else GO) if chance.random() < 0.5 else None
        found[which] += [taken] if taken is not None else []
        if len(found[0]) == len(found[1]) == 40:
            break
    assert found == sent
    assert [places.counted(index) for index in (GO, NUMBER)] == [(0, 0)] * 2


def test_what_waits_stays_over_a_new_session(bench: Bench) -> None:
    """A partly received sample is never delivered."""
    places = Places(bench, PLAN, OPENED)
    offered(places, GO, (30, "a"))
    places.client.spin(4)
    places.send(places.agent.offer(FIRST + GO, text(390, "b"))[:3])
    places.client.spin(1)
    places.agent.restart()
    places.client.spin(40, 50)
    assert places.client.statistics()["reconnects"] == 1
    assert asked(places, GO)[-1] == 1, "one waits"
    offered(places, GO, (380, "c"))
    places.client.spin(12)
    assert [places.take(GO) for _ in range(3)] == ["a" * 30, "c" * 380, None]
    assert places.counted(GO) == (0, 0)


def test_unrequested_samples_are_dropped_and_lose_nothing(bench: Bench) -> None:
    """An agent that sends more than was granted: what was acknowledged before stays."""
    places = Places(bench, PLAN, OPENED)
    offered(places, GO, (395, "a"), (395, "b"))
    places.client.spin(20)
    places.send([places.message(places.data(GO, text(200, "c")))])
    places.client.spin(2)
    assert [places.take(GO) for _ in range(3)] == ["a" * 395, "b" * 395, None]
    assert places.counted(GO) == (1, 0)


def test_a_larger_sample_than_the_largest_is_refused(bench: Bench) -> None:
    """Also where the bytes of the queue would hold it."""
    places = Places(bench, PLAN, OPENED)
    offered(places, FAST, (300, "a"))
    places.client.spin(1)
    result = places.client.call("read_text 1 1000")
    assert (result.code, result.error) == (
        1,
        "/arm/fast: received 305 bytes, 300 fit: raise limits of std_msgs/msg/String in microros.yaml",
    )
    assert places.counted(FAST) == (0, 1)


def test_a_place_of_a_pool_knows_the_largest_of_its_type(bench: Bench) -> None:
    """An Int32 takes four bytes, a String of this program up to 16; both places could hold one of 40."""
    plan = changed(READER, input__queues=(QueuePlan(8, 40, 40), QueuePlan(8, 40, 40)))
    places = Places(bench, plan, ("Int32 number reliable", "String text reliable"))
    assert [r.samples for r in places.agent.reads] == [8, 2]
    places.send(places.agent.numbers(plan.entities.publisher_places, *range(20)))
    found = []
    for _ in range(12):
        places.client.spin(3)
        while (value := places.take(0)) is not None:
            found.append(int(value))
    assert found == list(range(20))
    places.send(places.agent.offer(plan.entities.publisher_places, bytes(36)))
    places.client.spin(2)
    result = places.client.call("read_take 0")
    assert (result.code, result.error) == (
        1,
        "/number: received 36 bytes, 4 fit: raise limits of std_msgs/msg/Int32 in microros.yaml",
    )
