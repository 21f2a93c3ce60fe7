# SPDX-License-Identifier: Apache-2.0
"""Clients that come and go leave nothing: neither in Python nor, beyond what Fast DDS keeps, on the heap of C."""

from __future__ import annotations

import ctypes
import gc
import multiprocessing
import os
import time
import tracemalloc
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from itertools import pairwise
from pathlib import Path

import pytest

from microros_gen.agent.core import Agent
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog
from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.entity_messages import Create, Delete
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import Submessage, encode
from tests.support.agent.bridging import GET_TYPES, Bridged, opened
from tests.support.agent.captured import CREATE_CLIENT
from tests.support.agent.client import (
    dds_type,
    participant_blob,
    reader_blob,
    service_blob,
    topic_blob,
    writer_blob,
)
from tests.support.agent.fakes import FakeTransport
from tests.support.agent.process import own_domain
from tests.support.patience import deadline, seconds

pytestmark = [pytest.mark.ros, pytest.mark.system]

INT32 = dds_type("std_msgs/msg/Int32")
NODE, UP, DOWN = 0x11, 0x12, 0x22
OBJECTS = (
    (NODE, participant_blob("/comes_and_goes"), 0),
    (UP, topic_blob("rt/goes/up", INT32), NODE),
    (DOWN, topic_blob("rt/goes/down", INT32), NODE),
    (0x13, b"\0\0", NODE),
    (0x14, b"\0\0", NODE),
    (0x15, writer_blob(UP, 3, 10), 0x13),
    (0x16, reader_blob(DOWN, 3, 10), 0x14),
    (0x17, service_blob("/goes/asks", GET_TYPES), NODE),
    (0x18, service_blob("/goes/serves", GET_TYPES), NODE),
)
CYCLES, ROUNDS = 150, 3
PYTHON_BYTES, HEAP_BYTES = 200, 400
"""What one life may leave on average: it has nine objects, and tables that fill up differ by this much."""


class _MallocInfo(ctypes.Structure):
    """mallinfo2 of glibc: `used` and `mapped` are bytes in use."""

    _fields_ = tuple(
        (name, ctypes.c_size_t)
        for name in ("arena", "free", "small", "maps", "mapped", "x", "y", "used", "unused", "top")
    )


def heap_bytes() -> int:
    """Return what the C side of this process has in use."""
    mallinfo = ctypes.CDLL(None).mallinfo2
    mallinfo.restype = _MallocInfo
    info = mallinfo()
    return int(info.used + info.mapped)


def message(stream: int, sequence: int, *submessages: Submessage) -> bytes:
    return join(Header(0x81, stream, sequence), [encode(submessage) for submessage in submessages])


def live(agent: Agent, domain: int, transport: FakeTransport) -> None:
    """Connect, create everything, leave."""
    agent.receive(bytes.fromhex(CREATE_CLIENT), "a", transport)
    for place, (object_id, body, parent) in enumerate(OBJECTS):
        kind = object_id & 0x0F
        create = Create(
            10 + place, object_id, kind, Format.BINARY, body, parent, domain * (kind == 1), True, True
        )
        agent.receive(message(0x80, place, create), "a", transport)
    (client,) = agent.clients
    _until(agent, lambda: len(client.objects) == len(OBJECTS))
    agent.receive(message(0, 0, Delete(2, 0xFFFE)), "a", transport)
    _until(agent, lambda: not agent._turns.waits(client))
    agent.flush()
    agent.take()
    assert not len(agent.clients)
    transport.sent.clear()


def _until(agent: Agent, done: Callable[[], bool]) -> None:
    """Let the agent go on: who creates and leaves all the time has to wait now and then."""
    end = deadline(60)
    while not done():
        assert time.monotonic() < end
        time.sleep(0.001)
        agent.tick()


def measured() -> tuple[float, float]:
    """Return what a life leaves, in bytes of Python's and of the heap of C.

    The least of several rounds: a leak is in each, and what DDS on a busy machine has still to do in one alone.
    """
    transport = FakeTransport()
    with opened(own_domain()) as bridged, Path(os.devnull).open("w") as out:
        core = Agent(
            bridged.bridge, EventLog(out), Limits(operations_per_second=1_000_000, graph_ms_per_second=1_000)
        )
        tracemalloc.start()
        try:
            _lives(core, bridged, transport)
            rounds = [_lives(core, bridged, transport) for _ in range(ROUNDS)]
        finally:
            tracemalloc.stop()
    grown = [
        [(last - first) / CYCLES for first, last in zip(*pair, strict=True)] for pair in pairwise(rounds)
    ]
    python, heap = (min(of_kind) for of_kind in zip(*grown, strict=True))
    return python, heap


def _lives(core: Agent, bridged: Bridged, transport: FakeTransport) -> tuple[int, int]:
    """Live CYCLES times; return the bytes that are in use then."""
    for _ in range(CYCLES):
        live(core, bridged.domain, transport)
    used, end = (0, 0), deadline(6)
    # Whoever looks for somebody forgets them when it looks again, and DDS has its own threads: later on a busy machine.
    while time.monotonic() < end:
        bridged.wait_for(0.15)
        gc.collect()
        before, used = used, (tracemalloc.get_traced_memory()[0], heap_bytes())
        if used == before:
            break
    return used


def test_a_life_leaves_nothing() -> None:
    """In a separate process: another test's node in this one would keep what it has seen of the graph."""
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        python, heap = pool.submit(measured).result(timeout=seconds(120))
    print(f"each life leaves {python:.0f} B in Python and {heap:.0f} B on the heap")
    assert python < PYTHON_BYTES
    assert heap < HEAP_BYTES
