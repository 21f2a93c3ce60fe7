# SPDX-License-Identifier: Apache-2.0
"""Commands on nodes of rclpy: the calls of a service with introspection, and rates in the time of a simulation."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from importlib import import_module

import pytest
import yaml
from std_srvs.srv import SetBool

from microros_gen.cli.service_events import _event_name
from tests.support.agent.process import environment, own_domain
from tests.support.patience import deadline, seconds
from tests.support.ros.introspected import LATE_S, PERIOD_S, SPEED
from tests.support.ros.running import Running, running

pytestmark = [pytest.mark.ros, pytest.mark.system]


@pytest.fixture(scope="module")
def node() -> Iterator[Running]:
    with running(own_domain(), "tests.support.ros.introspected") as found:
        found.wait_for("ready")
        yield found


def command(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "microros_gen", *arguments, "--spin-time", "10"],
        env=environment(own_domain()),
        capture_output=True,
        text=True,
        timeout=seconds(60),
        check=False,
    )


def until(pattern: str, *arguments: str, calls: tuple[str, ...] = ()) -> list[str]:
    """Run a command without an end until a line of its output fits; make calls of /enable meanwhile."""
    with running(own_domain(), "microros_gen", *arguments) as started:
        end, turn = deadline(60), 0
        while not started.says_match(pattern):
            assert time.monotonic() < end, started.lines
            assert started.process.poll() is None, started.lines
            if calls:
                done = command("service", "call", "/enable", "std_srvs/srv/SetBool", calls[turn % len(calls)])
                assert done.returncode == 0, done.stderr
                turn += 1
            time.sleep(0.05)
        started.process.send_signal(signal.SIGINT)
        assert started.process.wait(seconds(20)) == 0
        started.read_to_end()
    return started.lines


def test_calls_of_a_service_are_printed(node: Running) -> None:
    lines = until("event_type: RESPONSE_SENT", "service", "echo", "/enable", calls=("data: true",))
    assert not any("No publishers" in line for line in lines)
    request, response = list(yaml.safe_load_all("\n".join(lines)))[:2]
    assert request["info"]["event_type"] == "REQUEST_RECEIVED"
    assert (request["request"], request["response"]) == ([{"data": True}], [])
    assert response["info"]["event_type"] == "RESPONSE_SENT"
    assert (response["request"], response["response"]) == ([], [{"success": True, "message": "enabled"}])
    assert request["info"]["sequence_number"] == response["info"]["sequence_number"]
    assert len(request["info"]["client_gid"]) == 16


def test_options_of_the_text(node: Running) -> None:
    arguments = ("service", "echo", "/enable", "std_srvs/srv/SetBool")
    lines = until("RESPONSE_SENT", *arguments, "--flow-style", "--no-arr", calls=("data: false",))
    assert any("request: '<sequence type: std_srvs/srv/SetBool_Request[1], length: 1>'" in x for x in lines)
    lines = until(r"^2,.*disabled$", *arguments, "--csv", calls=("data: false",))
    assert lines[0].startswith("1,"), "numbers, as ros2 prints them"


def test_service_without_introspection_gives_a_reason(node: Running) -> None:
    (line,) = until("service introspection", "service", "echo", "/silent")
    assert "No publishers on topic '/silent/_service_event'" in line


def test_unknown_service_has_a_proposal(node: Running) -> None:
    done = command("service", "echo", "/enabled")
    assert done.returncode == 1
    assert "Did you mean '/enable'?" in done.stderr
    assert "[MG-9813]" in done.stderr


def rate(*options: str) -> float:
    lines = until("average rate", "topic", "hz", "--window", "20", "/ticks", *options)
    return float(next(found[1] for line in lines if (found := re.search(r"average rate: ([\d.]+)", line))))


def test_rates_in_both_times(node: Running) -> None:
    """One that the machine delays is measured again."""
    for options, expected in (((), 1.0), (("-s",), 1 / SPEED), (("-s", "--wall-time"), 1.0)):
        found: list[float] = []
        while not found or found[-1] != pytest.approx(expected / PERIOD_S, rel=0.25):
            assert len(found) < 5, (options, found)
            found.append(rate(*options))


def test_delay_in_the_time_of_a_simulation(node: Running) -> None:
    lines = until("average delay", "topic", "delay", "-s", "/ticks")
    delay = float(next(found[1] for line in lines if (found := re.search(r"average delay: ([\d.]+)", line))))
    assert LATE_S - 1 < delay < LATE_S + 1
    lines = until("average delay", "topic", "delay", "/ticks")
    assert not any(re.search(r"average delay: [0-9]\.", line) for line in lines), "years, in real time"


def test_names_of_events_are_those_of_the_interface() -> None:
    info = SetBool.Event.get_fields_and_field_types()["info"]
    assert info == "service_msgs/ServiceEventInfo"
    event_info = import_module("service_msgs.msg").ServiceEventInfo
    for name in ("REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED"):
        assert _event_name(getattr(event_info, name)) == name
    assert _event_name(9) == 9
