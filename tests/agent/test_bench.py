# SPDX-License-Identifier: Apache-2.0
"""The agent's bench counts right: all samples of reliable streams arrive, both ways. Its speeds are not judged here."""

from __future__ import annotations

import json
import socket
import subprocess
from collections.abc import Iterator

import pytest

from tests.bench.agent_bench import CLIENTS, print_memory
from tests.bench.agent_rates import Case, client_to_dds, dds_to_client, loopback_trip, round_trip
from tests.bench.agent_sides import BEST_EFFORT, RELIABLE, Programs, Target, build_programs, own_agent
from tests.support.agent.process import own_domain

pytestmark = [pytest.mark.ros, pytest.mark.builds]
COUNT = 2_000


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Programs:
    built = build_programs(tmp_path_factory.mktemp("bench"))
    assert built is not None, "the ROS 2 wheels or a C compiler is missing"
    return built


@pytest.fixture(scope="module")
def target() -> Iterator[Target]:
    with own_agent(own_domain()) as running:
        yield running


def test_every_reliable_sample_of_a_client_is_counted_at_a_dds_reader(
    programs: Programs, target: Target
) -> None:
    rate = client_to_dds(programs, target, Case(1024, 512, RELIABLE), COUNT, 0x51)
    assert (rate.samples, rate.lost) == (COUNT, 0)
    assert rate.per_second > 0


def test_every_reliable_sample_of_dds_is_counted_in_a_client(programs: Programs, target: Target) -> None:
    rate = dds_to_client(programs, target, Case(1024, 512, RELIABLE), COUNT, 0x61)
    assert (rate.samples, rate.lost) == (COUNT, 0)


def test_losses_of_best_effort_are_counted(programs: Programs) -> None:
    receiver, sender = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
    with receiver, sender:
        receiver.bind(("127.0.0.1", 0))
        sender.connect(receiver.getsockname())
        receiver.connect(sender.getsockname())
        for sequence, number in enumerate((0, 1, 3, 7)):
            body = b"\x0d\0\0\0%08d....\0" % number
            receiver.send(bytes((0x81, 1, sequence, 0, 9, 1, 4 + len(body), 0, 0, 0x20, 0, 0x16)) + body)
        numbers = (sender.fileno(), 0x16, 17, 8, 512, BEST_EFFORT, 0, 0, 0, -1)
        command = [str(programs.load), "receive", *map(str, numbers)]
        done = subprocess.run(
            command, pass_fds=(sender.fileno(),), capture_output=True, text=True, check=True
        )
    seen = json.loads(done.stdout)
    assert (seen["samples"], seen["lost"]) == (4, 4)


def test_round_trips_end_where_they_began(programs: Programs, target: Target) -> None:
    trip = round_trip(programs, target, RELIABLE, 200, 0x81)
    assert (trip.samples, trip.lost) == (200, 0)
    assert 0 < trip.median_us <= trip.p99_us
    assert loopback_trip(programs, 100).samples == 100


@pytest.mark.system
def test_memory_is_read_for_each_number_of_clients(capsys: pytest.CaptureFixture[str]) -> None:
    """With the largest number, too: it has to fit the limits of an agent that has the default ones."""
    with own_agent(own_domain()) as fresh:
        print_memory(fresh)
    rows = capsys.readouterr().out.splitlines()[1:]
    assert [int(row.split()[0]) for row in rows] == [0, *CLIENTS]
    assert all(10 < float(row.split()[2]) < 500 for row in rows)
