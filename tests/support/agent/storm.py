# SPDX-License-Identifier: Apache-2.0
"""A bench with every kind of entity, and what must hold of it whatever came."""

from __future__ import annotations

from microros_gen.agent.limits import Limits
from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.data_messages import ReadData
from microros_gen.agent.wire.entity_messages import Create
from tests.support.agent import captured
from tests.support.agent.client import service_blob
from tests.support.agent.dialogue import entities, message
from tests.support.agent.fakes import Bench
from tests.support.agent.readers import FOREVER, reader_entities

LIMITS = Limits(
    clients=4, objects=20, streams=3, backlog_bytes=2_000, message_bytes=5_000, requests=8, client_timeout_s=2
)


def services() -> list[Create]:
    blob = service_blob("/set_bool", "std_srvs/srv/SetBool")
    return [Create(20 + k, 0x10 | k, k, Format.BINARY, blob, 0x11, 0, True, True) for k in (7, 8)]


def bench_with_everything() -> Bench:
    bench = Bench(LIMITS, verbosity=2)
    bench.say(captured.CREATE_CLIENT)
    for create in (*entities(), *reader_entities(), *services()):
        bench.say(message(create, stream=0))
    for object_id in (0x16, 0x17, 0x18):
        bench.say(message(ReadData(object_id, object_id, 0x80, delivery=FOREVER), stream=0))
    return bench


def check(bench: Bench) -> None:
    """No fault of the program; what the agent holds is what its clients have."""
    internal = {k: n for k, n in bench.log.counters.items() if k.startswith("internal_")}
    assert not internal, bench.text.getvalue()
    agent = bench.agent
    for client in agent.clients:
        assert set(client.readings) <= {entity.id for entity in client.objects}
        assert set(client.waiting) <= set(client.readings.values())
        for entity in client.objects:
            assert len(entity.outstanding) <= LIMITS.requests
    readings = [r for client in agent.clients for r in client.readings.values()]
    held = agent._deliveries._by_source
    assert sorted(map(id, held.values())) == sorted(id(r) for r in readings if r.source is not None)
