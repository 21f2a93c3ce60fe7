# SPDX-License-Identifier: Apache-2.0
"""The agent's view of its clients on /diagnostics: levels and their thresholds, and a client that is killed."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from typing import Any

import pytest

from microros_gen.agent.client_diagnostics import ERROR, OK, STALE, TOPIC, TYPE, WARN, ClientDiagnostics
from microros_gen.agent.states import ClientState, Presence
from microros_gen.ros.peer import Peer
from tests.support.agent.client import XrceClient
from tests.support.agent.process import own_domain, running_agent
from tests.support.agent.ros_client import INT32
from tests.support.patience import deadline

TIMEOUT_S = 4.0
STATE = ClientState(
    "A1B2C3D4", Presence.CONNECTED, "udp4", "127.0.0.1:1", ("/a",), 0.5, 1, 0, 0, None, 0, 3, ""
)


def level(diagnostics: ClientDiagnostics, state: ClientState, now: float) -> int:
    return diagnostics.levels((state,), now)["A1B2C3D4"].level


@pytest.mark.parametrize(
    ("presence", "silent_s", "expected"),
    [
        (Presence.CONNECTED, 1.9, OK),
        (Presence.CONNECTED, 2.0, WARN),
        (Presence.SILENT, 4.0, STALE),
        (Presence.SILENT, 11.9, STALE),
        (Presence.SILENT, 12.0, ERROR),
        (Presence.GONE, 0.1, STALE),
        (Presence.GONE, 100.0, STALE),
    ],
)
def test_levels_of_silence(presence: Presence, silent_s: float, expected: int) -> None:
    state = replace(STATE, presence=presence, silent_s=silent_s)
    assert level(ClientDiagnostics(TIMEOUT_S), state, 0.0) == expected


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"lost": 3}, "messages lost: 3"),
        ({"reconnects": 1}, "reconnected"),
        ({"silences": 1}, "was silent"),
        ({"last_error": "a late frame"}, "new warning: a late frame"),
        (
            {"lost": 1, "reconnects": 1, "silences": 1, "last_error": "bad"},
            "messages lost: 1, reconnected, was silent, new warning: bad",
        ),
    ],
)
def test_a_change_is_a_warning_for_ten_seconds(change: dict[str, Any], message: str) -> None:
    diagnostics = ClientDiagnostics(TIMEOUT_S)
    assert level(diagnostics, STATE, 0.0) == OK
    changed = replace(STATE, **change)
    assert [level(diagnostics, changed, at) for at in (1.0, 10.9, 11.0, 50.0)] == [WARN, WARN, OK, OK]
    again = ClientDiagnostics(TIMEOUT_S)
    assert level(again, STATE, 0.0) == OK
    assert again.levels((changed,), 1.0)["A1B2C3D4"].message == message
    assert again.levels((replace(changed, lost=7),), 60.0)["A1B2C3D4"].message == "messages lost: 7"
    assert diagnostics.levels((), 61.0) == {}


def test_a_client_that_is_new_has_reconnected_from_nothing() -> None:
    """An agent that restarts knows no loss before; what was lost since the first look is told."""
    assert level(ClientDiagnostics(TIMEOUT_S), replace(STATE, reconnects=2), 0.0) == OK
    assert level(ClientDiagnostics(TIMEOUT_S), replace(STATE, lost=2), 0.0) == WARN


@pytest.mark.ros
def test_a_killed_client_is_seen_from_ros(monkeypatch: pytest.MonkeyPatch) -> None:
    """OK, then a warning, stale and an error; connected again, it has reconnected; closed, it is stale."""
    domain = own_domain()
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    found: list[dict[str, Any]] = []
    with ExitStack() as stack:
        agent = stack.enter_context(running_agent(domain, "--diagnostics", "--client-timeout", "1"))
        peer = stack.enter_context(Peer(f"watcher_{os.getpid()}", domain=domain))

        def keep(message: dict[str, Any]) -> None:
            found.extend(
                status for status in message["status"] if status["name"].startswith("agent: client ")
            )

        def see(seen: Callable[[dict[str, Any], dict[str, str]], object]) -> dict[str, str]:
            end = deadline(20)
            while True:
                assert time.monotonic() < end, found[-3:]
                peer.spin_once(0.1)
                for status in found:
                    values = {entry["key"]: entry["value"] for entry in status["values"]}
                    if seen(status, values):
                        found.clear()
                        return values

        peer.subscribe(TOPIC, TYPE, keep)
        with XrceClient(agent.port) as client:
            assert client.connect() == 0
            client.publisher("seen", "seen", INT32, domain)
            values = see(lambda status, values: status["level"] == OK and values["nodes"] == "/seen")
            assert values["transport"].startswith("udp4")
            assert (values["presence"], values["reconnects"]) == ("connected", "0")
            see(lambda status, _: status["level"] == WARN)  # from here it is as if it was killed
            see(lambda status, values: (status["level"], values["presence"]) == (STALE, "silent"))
            values = see(lambda status, _: status["level"] == ERROR)
            assert float(values["silent_s"]) >= 3.0
            assert "/microros_agent/client_states" not in dict(peer.graph().topics())
            assert client.connect() == 0
            values = see(lambda status, values: status["level"] == WARN and values["reconnects"] == "1")
            assert values["presence"] == "connected"
            client.leave()
        see(lambda status, values: (status["level"], values["presence"]) == (STALE, "gone"))
        assert agent.stop() == 0
