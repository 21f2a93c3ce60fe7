# SPDX-License-Identifier: Apache-2.0
"""A worker's end of the channel: how long it works on what the front has passed on."""

from __future__ import annotations

import io
import select
import socket
from collections.abc import Hashable
from typing import cast

from microros_gen.agent.core import Agent
from microros_gen.agent.fairness import TURN_S
from microros_gen.agent.log import EventLog
from microros_gen.agent.transport.base import RemoteAddress, Transport
from microros_gen.agent.workers.addresses import remote_code
from microros_gen.agent.workers.channel import Channel, Kind, message_frame
from microros_gen.agent.workers.front_transport import FrontTransport
from microros_gen.agent.workers.link import FrontLink
from microros_gen.agent.workers.remote import RemoteTransport

COUNT = 2000
CODE = remote_code(RemoteAddress("serial /dev/test", 1, "client", "/dev/test", 3))


def test_other_work_has_its_turn_while_much_arrives() -> None:
    """Each message takes 1 ms here: a turn ends some messages after its time, and all arrive in their order."""
    near, far = map(Channel, socket.socketpair(socket.AF_UNIX, socket.SOCK_STREAM))
    log = EventLog(io.StringIO())
    own = RemoteTransport(0, FrontTransport("serial /dev/test", False), far, log)
    now = 0.0
    received: list[int] = []

    def receive(data: bytes, _address: Hashable, _transport: Transport) -> None:
        nonlocal now
        now += 0.001
        received.append(int.from_bytes(data[:4], "big"))

    link = FrontLink(far, 1, cast("Agent", None), [own], [own], log, lambda: now)
    for number in range(COUNT):
        near.send(Kind.MESSAGE, message_frame(0, CODE, number.to_bytes(4, "big") + bytes(200)))
    most, turns = 0.0, 0
    while len(received) < COUNT:
        near.flush()
        assert select.select([link.fileno()], [], [], 5)[0], "the rest is still announced"
        began = now
        link.pump(receive)
        most, turns = max(most, now - began), turns + 1
    assert received == list(range(COUNT))
    assert most < TURN_S + 0.020
    assert turns > COUNT * 0.001 / (TURN_S + 0.020)
    near.close()
    far.close()
    own.close()
