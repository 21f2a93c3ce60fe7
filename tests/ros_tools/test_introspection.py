# SPDX-License-Identifier: Apache-2.0
"""Commands on nodes of rclpy: the calls of a service with introspection, and rates in the time of a simulation."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from importlib import import_module
from itertools import product
from typing import Any

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


def until(done: Callable[[list[str]], object], *arguments: str, calls: tuple[str, ...] = ()) -> list[str]:
    """Run a command without an end until its output is what is wanted; make calls of /enable meanwhile."""
    with running(own_domain(), "microros_gen", *arguments) as started:
        end, turn = deadline(60), 0
        while not (started.says("") and done(started.lines)):
            assert time.monotonic() < end, started.lines
            assert started.process.poll() is None, started.lines
            if calls:
                called = command(
                    "service", "call", "/enable", "std_srvs/srv/SetBool", calls[turn % len(calls)]
                )
                assert called.returncode == 0, called.stderr
                turn += 1
            time.sleep(0.05)
        started.process.send_signal(signal.SIGINT)
        assert started.process.wait(seconds(20)) == 0
        started.read_to_end()
    return started.lines


def each(*patterns: str) -> Callable[[list[str]], bool]:
    """Want a line for each of these regular expressions."""
    return lambda lines: all(any(re.search(pattern, line) for line in lines) for pattern in patterns)


def echo(*arguments: str, patience_s: float = 5) -> tuple[str, ...]:
    """Return the command; it looks longer for what it needs where the machine has other work."""
    return ("service", "echo", *arguments, "--spin-time", f"{seconds(patience_s):.0f}")


def call_in(lines: list[str]) -> tuple[Any, Any] | None:
    """Return request and reply of the first call with both; one during the discovery may have its reply alone."""
    whole = "\n".join(lines).rpartition("---")[0]
    events = [event for event in yaml.safe_load_all(whole) if event]
    for request, response in product(events, events):
        about, answer = dict(request["info"]), dict(response["info"])
        kinds = about.pop("event_type"), answer.pop("event_type")
        del about["stamp"], answer["stamp"]
        if kinds == ("REQUEST_RECEIVED", "RESPONSE_SENT") and about == answer:
            return request, response
    return None


def test_calls_of_a_service_are_printed(node: Running) -> None:
    lines = until(call_in, *echo("/enable"), calls=("data: true",))
    assert not any("No publishers" in line for line in lines)
    found = call_in(lines)
    assert found is not None
    request, response = found
    assert (request["request"], request["response"]) == ([{"data": True}], [])
    assert (response["request"], response["response"]) == ([], [{"success": True, "message": "enabled"}])
    assert len(request["info"]["client_gid"]) == 16


def test_options_of_the_text(node: Running) -> None:
    arguments = echo("/enable", "std_srvs/srv/SetBool")
    request = r"request: '<sequence type: std_srvs/srv/SetBool_Request\[1\], length: 1>'"
    until(each(request, "RESPONSE_SENT"), *arguments, "--flow-style", "--no-arr", calls=("data: false",))
    numbers = each("^1,", "^2,.*disabled$")  # as ros2 prints them
    until(numbers, *arguments, "--csv", calls=("data: false",))


def test_service_without_introspection_gives_a_reason(node: Running) -> None:
    (line,) = until(each("service introspection"), *echo("/silent", patience_s=1.5))
    assert "No publishers on topic '/silent/_service_event'" in line


def test_events_that_are_best_effort_are_reported(node: Running) -> None:
    (line,) = until(each("best effort"), *echo("/unheard"))
    assert line == "A publisher of '/unheard/_service_event' is best effort: its events are not printed."


def test_unknown_service_has_a_proposal(node: Running) -> None:
    done = command("service", "echo", "/enabled")
    assert done.returncode == 1
    assert "Did you mean '/enable'?" in done.stderr
    assert "[MG-9813]" in done.stderr


def rate(*options: str) -> float:
    lines = until(each("average rate"), "topic", "hz", "--window", "20", "/ticks", *options)
    return float(next(found[1] for line in lines if (found := re.search(r"average rate: ([\d.]+)", line))))


def test_rates_in_both_times(node: Running) -> None:
    """One that the machine delays is measured again."""
    for options, expected in (((), 1.0), (("-s",), 1 / SPEED), (("-s", "--wall-time"), 1.0)):
        found: list[float] = []
        end = deadline(30)
        while not found or found[-1] != pytest.approx(expected / PERIOD_S, rel=0.25):
            assert time.monotonic() < end, (options, found)
            found.append(rate(*options))


def test_delay_in_the_time_of_a_simulation(node: Running) -> None:
    lines = until(each("average delay"), "topic", "delay", "-s", "/ticks")
    delay = float(next(found[1] for line in lines if (found := re.search(r"average delay: ([\d.]+)", line))))
    assert LATE_S - 1 < delay < LATE_S + 1
    lines = until(each("average delay"), "topic", "delay", "/ticks")
    assert not any(re.search(r"average delay: [0-9]\.", line) for line in lines), "years, in real time"


def test_names_of_events_are_those_of_the_interface() -> None:
    info = SetBool.Event.get_fields_and_field_types()["info"]
    assert info == "service_msgs/ServiceEventInfo"
    event_info = import_module("service_msgs.msg").ServiceEventInfo
    for name in ("REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED"):
        assert _event_name(getattr(event_info, name)) == name
    assert _event_name(9) == 9
