# SPDX-License-Identifier: Apache-2.0
"""Where large samples wait at depth 1: in the slot where their fragments are put together, or in the input buffer."""

from __future__ import annotations

import random
import struct

import pytest

from microros_gen.client.plan.runtime_entities import QueuePlan
from tests.support.plans import POOL, READER, changed
from tests.support.runtime.bench import Bench
from tests.support.runtime.places import Places, text
from tests.support.runtime.reading_agent import ReadingAgent

FIRST = POOL.entities.publishers.max
FRAGMENTS = changed(
    READER,
    entities__subscriptions__max=3,
    input__queues=(QueuePlan(1, 400), QueuePlan(1, 300), QueuePlan(3, 16)),
    input__arrives_in_fragments=True,
)
LENT = changed(
    READER,
    input__size=440,
    input__queues=(QueuePlan(1, 400), QueuePlan(3, 16)),
    input__reader=0,
    input__free=64,
)


THREE = ("String go reliable", "String other reliable", "Int32 number reliable")
TWO = ("String go best_effort", "Int32 number reliable")


def test_a_sample_waits_where_its_fragments_arrived(bench: Bench) -> None:
    """The queue has one slot and there is no second buffer; the agent holds back the next sample meanwhile."""
    places = Places(bench, FRAGMENTS, THREE)
    places.send(places.agent.offer(FIRST, text(300, "a"), text(390, "b")))
    places.client.spin(5)
    assert [r.samples for r in places.agent.reads] == [1, 1, 3]
    places.send(places.agent.numbers(FIRST + 2, 7))
    places.send(places.agent.offer(FIRST + 1, text(250, "c")))
    places.client.spin(5)
    assert places.take(1) == "c" * 250, "another subscription's samples go past the one that waits"
    assert places.take(2) == "7"
    assert places.take(0) == "a" * 300
    places.client.spin(5)
    assert places.take(0) == "b" * 390
    assert [places.counted(i) for i in range(3)] == [(0, 0)] * 3


@pytest.mark.parametrize("seed", range(4))
def test_large_and_small_ones_under_loss_and_disorder(bench: Bench, seed: int) -> None:
    chance = random.Random(seed)
    places = Places(bench, FRAGMENTS, THREE)
    places.agent.drop = lambda datagram: chance.random() < 0.2
    places.agent.drop_answer = lambda answer: chance.random() < 0.2
    sent: list[list[str]] = [[], [], []]
    found: list[list[str]] = [[], [], []]
    for number in range(2500):
        index = chance.randrange(3)
        if len(sent[index]) < 15 and chance.random() < 0.3:
            letter, size = chr(ord("a") + number % 26), chance.randrange(1, 290)
            body = text(size, letter) if index < 2 else struct.pack("<i", number)
            sent[index].append(letter * size if index < 2 else str(number))
            places.send(places.agent.offer(FIRST + index, body))
        places.send(places.agent.tick())
        if chance.random() < 0.3 and len(places.client.queued) > 1:
            chance.shuffle(places.client.queued)
        if chance.random() < 0.1 and places.client.queued:
            places.client.queued.append(places.client.queued[0])
        places.client.spin(1, 20)
        index = chance.randrange(3)
        taken = places.take(index) if chance.random() < 0.5 else None
        found[index] += [taken] if taken is not None else []
        if sum(map(len, found)) == 45:
            break
    assert found == sent
    assert [places.counted(i) for i in range(3)] == [(0, 0)] * 3


def test_fragments_of_a_subscription_that_is_closed_meanwhile(bench: Bench) -> None:
    places = Places(bench, FRAGMENTS, THREE)
    chunks = places.agent.offer(FIRST, text(300, "a"))
    places.send(chunks[:3])
    places.client.spin(2)
    places.client.ok("read_fini 0 0")
    places.client.ok("read_init 0 0 String go best_effort")
    places.client.spin(4)
    places.send(places.agent.offer(FIRST, text(20, "b")))
    places.send(chunks[3:])
    places.client.spin(2)
    assert places.take(0) == "b" * 20
    assert places.take(0) is None
    assert places.counted() == (0, 0)


def test_an_unrequested_sample_between_fragments(bench: Bench) -> None:
    """It takes the slot; a partly received sample is counted, and never delivered."""
    places = Places(bench, FRAGMENTS, THREE)
    chunks = places.agent.offer(FIRST, text(300, "a"))
    places.send(chunks[:3])
    places.send([places.message(places.data(0, text(30, "b")))])
    places.send(chunks[3:])
    places.client.spin(2)
    assert places.take(0) == "b" * 30
    assert places.take(0) is None
    assert places.counted() == (1, 0)


def test_a_new_session_between_fragments(bench: Bench) -> None:
    places = Places(bench, FRAGMENTS, THREE)
    chunks = places.agent.offer(FIRST, text(300, "a"))
    places.send(chunks[:3])
    places.client.spin(1)
    places.agent.restart()
    places.client.spin(40, 50)
    assert places.client.statistics()["reconnects"] == 1
    places.send(places.agent.offer(FIRST, text(350, "b")))
    places.client.spin(4)
    assert places.take(0) == "b" * 350


def test_a_sample_waits_at_the_end_of_the_input_buffer(bench: Bench) -> None:
    """What arrives while it waits is received in front of it."""
    places = Places(bench, LENT, TWO)
    places.send(places.agent.offer(FIRST, text(395, "a")))
    places.client.spin(2)
    for value in range(20):
        places.send(places.agent.numbers(FIRST + 1, value))
        places.client.spin(1, 30)
        assert places.take(1) == str(value)
    assert places.take(0) == "a" * 395
    assert places.counted() == (0, 0)


def test_the_newest_sample_takes_the_place(bench: Bench) -> None:
    places = Places(bench, LENT, TWO)
    for size, letter in ((300, "a"), (395, "b"), (3, "c"), (390, "d")):
        places.send(places.agent.offer(FIRST, text(size, letter)))
        places.client.spin(1)
    assert places.take(0) == "d" * 390
    assert places.take(0) is None
    assert places.counted() == (3, 0)


def test_a_large_invalid_message_takes_the_place_too(bench: Bench) -> None:
    """The sample is counted, and never given in part."""
    places = Places(bench, LENT, TWO)
    places.send(places.agent.offer(FIRST, text(395, "a")))
    places.client.spin(1)
    places.send([b"\x81\0\0\0" + bytes(100)])
    assert places.take(0) is None
    places.send([places.agent.offer(FIRST, text(395, "b"))[0]])
    places.client.spin(1)
    places.send([bytes(441)])
    assert places.take(0) is None
    assert places.counted() == (2, 0)


def test_what_follows_a_sample_in_its_message_is_handled(bench: Bench) -> None:
    """The sample is moved to its place when all of the message was."""
    places = Places(bench, LENT, TWO)
    first, second = places.data(0, text(31, "a")), places.data(1, struct.pack("<i", 5))
    third = places.data(0, text(299, "b"))
    assert len(first) % 4 == len(second) % 4 == 0
    places.send([places.message(first + second + third)])
    assert places.take(0) == "b" * 299
    assert places.take(1) == "5"
    assert places.counted() == (1, 0)


def test_samples_of_any_size_are_whole_and_in_order(bench: Bench) -> None:
    chance = random.Random(5)
    places = Places(bench, LENT, TWO)
    bodies = [(chance.randrange(1, 396), chr(ord("a") + i % 26)) for i in range(200)]
    found, numbers = [], []
    for value, (size, letter) in enumerate(bodies):
        places.send(places.agent.offer(FIRST, text(size, letter)))
        places.send(places.agent.numbers(FIRST + 1, value))
        if chance.random() < 0.4:
            chance.shuffle(places.client.queued)
        if chance.random() < 0.2:
            del places.client.queued[chance.randrange(len(places.client.queued))]
        places.client.spin(chance.randrange(3), 50)
        taken = places.take(0)
        found += [taken] if taken is not None else []
        while (number := places.take(1)) is not None:
            numbers.append(int(number))
    order = [bodies.index((len(sample), sample[0])) for sample in found]
    assert all(set(sample) == {sample[0]} for sample in found)
    assert order == sorted(order)
    assert len(found) > 100
    assert numbers == list(range(len(numbers))), "reliable ones are complete"


def test_a_reliable_subscription_is_refused_there(bench: Bench) -> None:
    """A sample in the input buffer can lose its place, which one that was acknowledged must not."""
    agent = ReadingAgent()
    client = bench.start(LENT, agent=agent)
    client.ok("init")
    client.ok("node 0 listener -")
    result = client.call("read_init 0 0 String go reliable")
    assert (result.code, result.error) == (
        1,
        "go is reliable here and best_effort in the application file: add qos: {reliability: reliable}"
        " in microros.yaml",
    )
    client.ok("read_init 0 0 String go best_effort")


def test_a_message_without_buffers_is_refused(bench: Bench) -> None:
    """What `storage: none` comes to where the program brings none: a text, a counter, and the next one is taken."""
    places = Places(bench, FRAGMENTS, THREE)
    places.send(places.agent.offer(FIRST, text(300, "a"), text(20, "b")))
    result = places.client.call("read_text 0 1")
    assert (result.code, result.error) == (
        1,
        "capacity for 0: set limits: {std_msgs/msg/String: {data: 300}} in microros.yaml, or that of your buffer",
    )
    assert places.counted() == (0, 1)
    places.client.spin(3)
    assert places.take(0) == "b" * 20
