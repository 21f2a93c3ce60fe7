# SPDX-License-Identifier: Apache-2.0
"""An agent that ends delivers what its clients know to be delivered, and does not wait long for who does not read."""

from __future__ import annotations

import signal
import time
from contextlib import ExitStack
from typing import Any

import pytest

from microros_gen.agent.limits import Limits
from tests.support.agent.client import XrceClient, int32_body
from tests.support.agent.dialogue import entities, message, publishing
from tests.support.agent.observer import observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.agent.ros_client import INT32
from tests.support.agent.stream_messages import acknacks, values, write
from tests.support.patience import seconds

LAST = 10
"""Samples that the history of the writer keeps."""


def test_what_was_accepted_is_published_and_acknowledged() -> None:
    """A message of many samples, which does not finish within the client's turn."""
    bench = publishing(Limits(stop_s=1.0))

    class Slow(list[Any]):
        def append(self, item: Any) -> None:
            bench.now += 0.001
            super().append(item)

    bench.bridge.published = Slow()
    bench.agent.receive(write(0, *range(20)), "a", bench.transport)
    bench.agent.flush()
    assert 0 < len(bench.bridge.published) < 20
    del bench.transport.sent[:]
    bench.agent.close()
    assert values(bench) == list(range(20))
    sent = [data.hex() for _, data in bench.transport.sent]
    assert acknacks(sent) == [(1, 0)]
    assert sent[-1] == "81000000" + "05010600" + "0002fffe" + "0000", (
        "after the last acknowledgement, a farewell"
    )
    assert bench.bridge.graph == []


def test_all_publishers_together_are_waited_for_once() -> None:
    bench = publishing(Limits(stop_s=0.75))
    for sequence, create in enumerate(entities(2, topic="b"), 4):
        bench.say(message(create, sequence=sequence))
    bench.bridge.settled = False

    class Waits(list[float]):
        def append(self, item: float) -> None:
            bench.now += item
            super().append(item)

    bench.bridge.waited = Waits()
    bench.agent.close()
    assert bench.bridge.waited == [0.75, 0.0]
    assert "warning: 2 publishers end before all of their readers" in bench.text.getvalue()
    assert bench.bridge.graph == []


def test_readers_that_have_everything_are_not_waited_for() -> None:
    bench = publishing()
    before = bench.now
    bench.agent.close()
    assert bench.now == before
    assert "acknowledged" not in bench.text.getvalue()


@pytest.mark.ros
def test_a_reader_that_is_late_gets_the_last_samples() -> None:
    """The reader's process is stopped while the samples come, and goes on after the agent was told to end."""
    domain = own_domain()
    with ExitStack() as stack:
        observer = stack.enter_context(observing(domain))
        agent = stack.enter_context(running_agent(domain, "--limit", "stop_s=30"))
        observer.subscribe("/last", INT32)
        client = stack.enter_context(XrceClient(agent.port))
        assert client.connect() == 0
        writer = client.publisher("ends", "last", INT32, domain, depth=LAST)
        client.wait_until_subscribed(writer, int32_body(-1), observer, "/last")
        with observer.stopped():
            for value in range(LAST):
                client.write(writer, int32_body(value))
            client.drain()
            agent.process.send_signal(signal.SIGTERM)
            time.sleep(0.5)  # time for an agent that does not wait to end
            assert agent.process.poll() is None
        assert [value["data"] for _, value in observer.got(LAST)] == list(range(LAST))
        assert agent.process.wait(timeout=seconds(15)) == 0


@pytest.mark.system
@pytest.mark.ros
def test_a_reader_that_never_reads_delays_the_end_by_a_second() -> None:
    domain = own_domain()
    with ExitStack() as stack:
        observer = stack.enter_context(observing(domain))
        agent = stack.enter_context(running_agent(domain))
        observer.subscribe("/never", INT32)
        client = stack.enter_context(XrceClient(agent.port))
        assert client.connect() == 0
        writer = client.publisher("ends", "never", INT32, domain, depth=LAST)
        client.wait_until_subscribed(writer, int32_body(-1), observer, "/never")
        with observer.stopped():
            client.write(writer, int32_body(1))
            client.drain()
            assert agent.stop() == 0
        agent.wait_for("1 publishers end before all of their readers have acknowledged")
