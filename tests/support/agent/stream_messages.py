# SPDX-License-Identifier: Apache-2.0
"""WRITE_DATA, HEARTBEAT and ACKNACK as they are sent and as they are found among answers."""

from __future__ import annotations

from microros_gen.agent.wire.constants import SubmessageId
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.entity_messages import Heartbeat
from microros_gen.agent.wire.message import split
from tests.support.agent.client import int32_body
from tests.support.agent.dialogue import message
from tests.support.agent.fakes import Bench

RELIABLE = 0x80


def samples(*values: int) -> list[WriteData]:
    return [WriteData(1, 0x15, int32_body(value)) for value in values]


def write(sequence: int, *values: int, stream: int = RELIABLE) -> bytes:
    return message(*samples(*values), stream=stream, sequence=sequence)


def heartbeat(first: int, last: int) -> bytes:
    return message(Heartbeat(first, last, RELIABLE), stream=0)


def acknacks(answers: list[str]) -> list[tuple[int, int]]:
    """Return of each ACKNACK the first message that it does not acknowledge, and the bits of those that lack."""
    found = []
    for data in map(bytes.fromhex, answers):
        for identifier, _, at, _ in split(data, 4):
            if identifier == SubmessageId.ACKNACK:
                found.append((data[at] | data[at + 1] << 8, data[at + 2] << 8 | data[at + 3]))
    return found


def values(bench: Bench) -> list[int]:
    return [int.from_bytes(data[4:8], "little") for _, data in bench.bridge.published]
