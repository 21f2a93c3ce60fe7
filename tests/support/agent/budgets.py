# SPDX-License-Identifier: Apache-2.0
"""What clients ask for until their agent refuses, kind by kind."""

from __future__ import annotations

from microros_gen.agent.wire.data_messages import ReadData
from microros_gen.agent.wire.entity_messages import Create, Delete
from tests.support.agent import captured
from tests.support.agent.dialogue import message
from tests.support.agent.fakes import Bench
from tests.support.agent.readers import FOREVER, reader_entities

OK, RESOURCES = 0x00, 0x87
KEY = "a1 b2 c3 d4"


def connect(bench: Bench, number: int = 1) -> str:
    """Open the session of a client; return its address."""
    address = f"client {number}"
    bench.say(captured.CREATE_CLIENT.replace(KEY, f"00 00 00 {number:02x}"), address)
    return address


def ask(bench: Bench, create: Create | Delete, address: str = "client 1") -> int:
    """Create or delete; return the status."""
    (answer,) = bench.say(message(create, stream=0), address)
    return int(answer.split()[-2], 16)


def reading(bench: Bench, number: int) -> str:
    """Return the address of a client that reads reliably."""
    address = connect(bench, number)
    for create in reader_entities(topic=f"t{number}"):
        assert ask(bench, create, address) == OK
    bench.say(message(ReadData(7, 0x16, 0x80, delivery=FOREVER), stream=0), address)
    return address
