# SPDX-License-Identifier: Apache-2.0
"""The metrics of the agent, as the parser of Prometheus's client reads them."""

from __future__ import annotations

import itertools
import re
import time
import urllib.request
from dataclasses import replace

from prometheus_client.parser import text_string_to_metric_families

from microros_gen.agent.monitoring.metrics import metrics_text
from microros_gen.agent.monitoring.serving import metrics_routes
from microros_gen.agent.monitoring.status import AgentStatus
from microros_gen.agent.states import Presence
from microros_gen.agent.traffic import Direction
from microros_gen.web.places import Place
from microros_gen.web.server import served
from tests.support.agent.fakes import Bench
from tests.support.agent.monitored import CLIENT, STATUS, many, running

Series = dict[tuple[str, tuple[tuple[str, str], ...]], float]


def series(text: str) -> Series:
    """Return the value of each series of the client's parser, which finds no series twice."""
    found: Series = {}
    for family in text_string_to_metric_families(text):
        for sample in family.samples:
            key = sample.name, tuple(sorted(sample.labels.items()))
            assert key not in found
            found[key] = sample.value
    return found


def of_client(status: AgentStatus, name: str) -> float | None:
    return series(metrics_text(status)).get((f"microros_agent_client_{name}", (("client", "A1B2C3D4"),)))


def test_values_are_those_of_the_status() -> None:
    found = series(metrics_text(STATUS))
    assert found["microros_agent_start_time_seconds", ()] == 1_700_000_000
    assert found["microros_agent_clients", (("state", "connected"),)] == 1
    assert found["microros_agent_clients", (("state", "silent"),)] == 0
    assert found["microros_agent_faults_total", (("kind", "truncated"),)] == 3
    assert found["microros_agent_transport_ready", (("transport", "serial /dev/ttyUSB0"),)] == 0
    assert found["microros_agent_build_info", (("version", "1.2.3"),)] == 1
    expected = {
        "last_message_timestamp_seconds": 1_700_000_090.25,
        "round_trip_seconds": 0.0015,
        "received_bytes_total": 64_000,
        "sent_messages_total": 500,
        "lost_messages_total": 2,
        "resent_messages_total": 3,
        "repeated_messages_total": 4,
        "sessions_total": 3,
        "silences_total": 1,
        "denied_total": 0,
        "queue_fill_ratio": 0.5,
        "queue_bytes": 512,
        "input_bytes": 100,
        "connected": 1,
    }
    assert {name: of_client(STATUS, name) for name in expected} == expected


def test_every_metric_has_a_text_and_a_type_and_a_conventional_name() -> None:
    families = list(text_string_to_metric_families(metrics_text(STATUS)))
    assert len(families) == len({family.name for family in families}) > 20
    for family in families:
        assert family.documentation.endswith("."), family.name
        assert family.type in ("counter", "gauge")
        assert re.fullmatch(r"microros_agent_[a-z_]+", family.name)
        names = {sample.name for sample in family.samples}
        assert names == {f"{family.name}_total" if family.type == "counter" else family.name}


def test_labels_are_escaped() -> None:
    name = 'a"b\\n\nc\\'
    status = replace(STATUS, clients=(replace(CLIENT, nodes=(name,)),))
    (labels,) = [labels for metric, labels in series(metrics_text(status)) if metric.endswith("client_info")]
    assert dict(labels) == {"client": "A1B2C3D4", "name": name, "transport": "udp4 127.0.0.1:8888"}


def test_what_was_not_measured_has_no_series() -> None:
    status = replace(STATUS, clients=(replace(CLIENT, round_trip_s=None),), faults={})
    assert of_client(status, "round_trip_seconds") is None
    assert "round_trip" not in metrics_text(status)
    assert "faults" not in metrics_text(status)


def test_the_number_of_series_is_bounded_by_the_number_of_clients() -> None:
    """Clients that have left have none, however many keys there were."""
    closed = tuple(replace(CLIENT, key=f"{i:08X}", presence=Presence.GONE) for i in range(500))
    text = metrics_text(replace(STATUS, clients=(*closed, CLIENT)))
    assert series(text) == series(metrics_text(STATUS))
    began = time.process_time()
    thousand = metrics_text(many(1000))
    assert time.process_time() - began < 2.0  # 40 ms on an idle machine
    assert len(thousand) < 2_000_000
    assert len(series(thousand)) - len(series(metrics_text(many(0)))) == 17 * 1000


def test_counters_do_not_go_back_when_a_client_reconnects() -> None:
    bench = Bench(watched=True)
    create = "80 00 00 00 00 01 10 00 58 52 43 45 01 00 01 0f a1 b2 c3 d4 {} 00 00 02"
    counters: list[Series] = []
    for session in ("81", "81", "82", "83"):
        bench.say(create.format(session))
        for sequence in (0, 3):
            bench.say(f"{session} 01 0{sequence} 00 0b 01 05 00 00 00 00 00 80")
        found = series(metrics_text(replace(STATUS, clients=bench.agent.client_states())))
        counters.append({key: value for key, value in found.items() if key[0].endswith("_total")})
    for before, after in itertools.pairwise(counters):
        assert before.keys() <= after.keys()
        assert all(after[key] >= value for key, value in before.items())
    assert [each["microros_agent_client_sessions_total", (("client", "A1B2C3D4"),)] for each in counters] == [
        *(1, 2, 3, 4)
    ]
    assert CLIENT.sent == Direction(500, 8_000)


def test_they_are_fetched_in_the_format_of_prometheus() -> None:
    with (
        running() as loop,
        served(Place("127.0.0.1", 0), metrics_routes(loop.board)) as address,
        urllib.request.urlopen(f"{address}metrics") as response,
    ):
        assert response.headers["Content-Type"] == "text/plain; version=0.0.4; charset=utf-8"
        text = response.read().decode()
    assert series(text) == series(metrics_text(STATUS))
