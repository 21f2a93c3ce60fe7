# SPDX-License-Identifier: Apache-2.0
"""Which worker a message is for."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from microros_gen.agent.seal.layout import FIRST, RECORD, Kind
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.session_messages import CreateClient, GetInfo
from microros_gen.agent.wire.submessages import Submessage, encode
from microros_gen.agent.workers.routing import NEWCOMERS, Place, Router

HERE: Place = (0, b"here")
THERE: Place = (1, b"there")


def message(submessage: Submessage, session: int, key: int = 0) -> bytes:
    return join(
        Header(session, 0, 0, key.to_bytes(4, "big") if session < 0x80 else b""), [encode(submessage)]
    )


def create(key: int, session: int = 0x81) -> bytes:
    return message(CreateClient(key.to_bytes(4, "big"), session, 512), session & 0x80, key)


PING = GetInfo(1, 0xFFFD, 2)


def test_a_key_has_one_worker_wherever_it_is() -> None:
    router = Router(3)
    for key in (3, 4, 5, 0xFFFFFFFF):
        for session in (0x01, 0x81):
            assert {router.worker_for(create(key, session), place) for place in (HERE, THERE)} == {key % 3}
        assert router.worker_for(message(WriteData(1, 0x15, b""), 0x01, key), THERE) == key % 3


def test_the_first_message_without_a_key_goes_where_its_session_was_opened() -> None:
    router = Router(4)
    assert router.worker_for(create(2), HERE) == 2
    assert router.worker_for(message(PING, 0x81), HERE) == 2


def test_a_newcomer_takes_nothing_from_who_is_in_session_at_its_address() -> None:
    """Anyone may send with that address: only who has proved it has it, and messages show their session."""
    router = Router(4)
    router.worker_for(create(1, 0x81), HERE)
    assert router.claim(HERE, 1) is None
    router.worker_for(create(2, 0x82), HERE)
    assert router.worker_for(message(PING, 0x81), HERE) == 1
    assert router.worker_for(message(PING, 0x80), HERE) == 1
    assert router.worker_for(message(PING, 0x82), HERE) == 1, "its worker may refuse it"
    router.admit(HERE, 2, 0x82)
    assert router.worker_for(message(PING, 0x81), HERE) == 1
    assert router.worker_for(message(PING, 0x82), HERE) == 2
    assert router.claim(HERE, 2) == 1, "the worker of the first one is told"
    assert router.worker_for(message(PING, 0x81), HERE) == 2
    router.release(HERE, 1)
    assert router.worker_for(message(PING, 0x82), HERE) == 2, (
        "what the other one releases is not there any more"
    )
    router.release(HERE, 2)
    assert router.forget(2) == []


def test_the_places_of_a_worker_that_ended_are_free() -> None:
    router = Router(2)
    router.claim(HERE, 1)
    router.claim(THERE, 0)
    assert router.forget(1) == [HERE]
    assert router.claim(HERE, 0) is None
    assert router.worker_for(message(PING, 0x81), THERE) == 0


@pytest.mark.parametrize("forged", [2, 5, 6])
@pytest.mark.parametrize("session", [0x81, 0x82])
def test_a_forged_create_between_the_answer_and_the_next_message_changes_nothing(
    forged: int, session: int
) -> None:
    """Its worker refuses it, or its confirmation is lost with that worker."""
    router = Router(4)
    router.worker_for(create(1), HERE)
    router.admit(HERE, 1, 0x81)
    router.worker_for(create(forged, session), HERE)
    assert router.worker_for(message(PING, 0x81), HERE) == 1
    if forged % 4 != 1:
        router.forget(forged % 4)
    assert router.worker_for(message(PING, 0x81), HERE) == 1
    assert router.claim(HERE, 1) is None
    assert router.worker_for(message(PING, 0x81), HERE) == 1


def test_a_forged_create_before_the_answer_is_forgotten_with_it() -> None:
    router = Router(4)
    router.worker_for(create(1), HERE)
    router.worker_for(create(2), HERE)
    router.admit(HERE, 1, 0x81)
    assert router.worker_for(message(PING, 0x81), HERE) == 1


def test_one_that_repeats_its_create_because_the_answer_was_lost() -> None:
    router = Router(4)
    for _ in range(2):
        assert router.worker_for(create(1), HERE) == 1
        router.admit(HERE, 1, 0x81)
        router.worker_for(create(2), HERE)
    assert router.worker_for(message(PING, 0x81), HERE) == 1


def test_a_worker_that_ended_knows_no_newcomer() -> None:
    router = Router(2)
    router.claim(HERE, 0)
    router.admit(HERE, 1, 0x82)
    assert router.forget(1) == []
    assert router.worker_for(message(PING, 0x82), HERE) == 0


def test_forged_newcomers_do_not_grow_it() -> None:
    router = Router(2)
    for number in range(2 * NEWCOMERS + 10):
        place = (0, str(number).encode())
        router.admit(place, router.worker_for(create(number), place), 0x81)
    assert len(router._newcomers) == len(router._requested) == 2 * NEWCOMERS


def test_forged_requests_do_not_displace_admitted_ones() -> None:
    router = Router(2)
    router.admit(HERE, 1, 0x81)
    for number in range(3 * NEWCOMERS):
        router.worker_for(create(2 * number), (0, str(number).encode()))
    assert router.worker_for(message(PING, 0x81), HERE) == 1


def test_sealed_messages_show_their_worker_and_nothing_else_counts() -> None:
    router = Router(3, is_sealed=True)
    first = FIRST.pack(Kind.FIRST, 1, 0, 7, 5) + bytes(48)
    record = RECORD.pack(Kind.RECORD, 1, 0, 4, 0) + bytes(20)
    assert router.worker_for(first, HERE) == 2
    router.claim(HERE, 0)
    router.worker_for(create(2), HERE)
    assert {router.worker_for(record, place) for place in (HERE, THERE)} == {1}
    assert router.worker_for(first, THERE) == 2


def test_an_unknown_sender_is_for_the_worker_of_the_only_client_to_adopt() -> None:
    router = Router(3)
    sample = message(WriteData(1, 0x15, b""), 0x81)
    assert {router.worker_for(sample, HERE, only) for only in range(3)} == {0, 1, 2}
    router.claim(HERE, 1)
    assert router.worker_for(sample, HERE, 2) == 1


@given(st.binary(max_size=40), st.integers(1, 64), st.booleans())
def test_every_message_has_a_worker(data: bytes, workers: int, is_sealed: bool) -> None:
    router = Router(workers, is_sealed)
    first = router.worker_for(data, HERE)
    assert 0 <= first < workers
    assert router.worker_for(data, HERE) == first
