# SPDX-License-Identifier: Apache-2.0
"""Services through the bridge: raw requests and replies, many at once, correlated by ROS 2 itself."""

from __future__ import annotations

import io
import time
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import Any

import pytest

from microros_gen.agent.log import EventLog
from microros_gen.agent.ros import services
from microros_gen.agent.ros.bridge import BridgeError, NoClient, NoServer, ServerFound
from microros_gen.agent.ros.reports import graph_reporter
from microros_gen.agent.ros.services import HELD_BYTES, HELD_CALLS
from microros_gen.ros.libraries import TIMEOUT, Libraries
from tests.support.agent.bridging import (
    GET_TYPES,
    Bridged,
    get_types,
    names_body,
    read_names,
    read_types,
    types_body,
)
from tests.support.agent.observer import Observer
from tests.support.patience import deadline

pytestmark = pytest.mark.ros


def test_twenty_slow_requests_each_get_their_answer(bridged: Bridged, bridge_observer: Observer) -> None:
    """All requests come before the first is answered, and they are answered backwards."""
    node = bridged.bridge.create_node("server", bridged.domain)
    replier = node.create_replier(get_types("many"))
    names = [["x" * i, "y" * (40 - i)] for i in range(20)]
    bridge_observer.ask(do="call", service="/many", type=GET_TYPES, names=names)
    requests = bridged.take(replier, 20)
    assert sorted(read_names(request) for _, request in requests) == sorted(names)
    assert len({identity for identity, _ in requests}) == 20
    assert {len(identity) for identity, _ in requests} == {24}
    for identity, request in reversed(requests):
        replier.reply(identity, types_body([len(name) for name in read_names(request)]))
    bridged.wait(lambda: None not in bridge_observer.ask(do="replies"))
    assert bridge_observer.ask(do="replies") == [[len(a), len(b)] for a, b in names]
    node.destroy()


def test_counting_requests_takes_no_wake_up_away(bridged: Bridged, bridge_observer: Observer) -> None:
    """Short of memory, the agent counts what each client has to read, perhaps before it was told of it."""
    node = bridged.bridge.create_node("counted", bridged.domain)
    replier = node.create_replier(get_types("counted"))
    bridged.named()
    for calls in range(1, 4):
        before = replier.unread()
        bridge_observer.ask(do="call", service="/counted", type=GET_TYPES, names=[["x"]] * calls)
        end = deadline(15)
        while replier.unread() < before + calls:
            assert time.monotonic() < end
        assert replier.unread() == before + calls
        requests = bridged.take(replier, calls)
        assert replier.take() is None
        for identity, _ in requests:
            replier.reply(identity, types_body([1]))
    node.destroy()


def found(requester: Any) -> bool:
    """Whether the bridge's requester has discovered its server."""
    return bool(requester.find_server())


def test_twenty_requests_of_a_client_get_their_own_replies(
    bridged: Bridged, bridge_observer: Observer
) -> None:
    bridge_observer.ask(do="serve", service="/held", type=GET_TYPES, hold=20)
    node = bridged.bridge.create_node("asker", bridged.domain)
    requester = node.create_requester(get_types("held"))
    numbers = {requester.request(names_body(["z"])): 1}  # waits until the service is discovered
    bridged.wait(lambda: found(requester))
    numbers |= {requester.request(names_body(["z" * i])): i for i in range(2, 21)}
    assert len(numbers) == 20
    replies = bridged.take(requester, 20)
    assert {numbers[number]: read_types(reply) for number, reply in replies} == {i: [i] for i in range(1, 21)}
    node.destroy()


def test_replies_to_others_do_not_hide_ones_own(bridged: Bridged, bridge_observer: Observer) -> None:
    """All clients of a service read one topic of replies; ROS 2 passes over those to others one by one."""
    bridge_observer.ask(do="serve", service="/shared", type=GET_TYPES, hold=6)
    node = bridged.bridge.create_node("askers", bridged.domain)
    requesters = [node.create_requester(get_types("shared")) for _ in range(3)]
    requests = {
        (i, r.request(names_body(["n" * (i + 1)] * k))): k for k in (1, 2) for i, r in enumerate(requesters)
    }
    received: dict[tuple[int, int], bytes] = {}

    def sink(asker: int, reply: tuple[int, bytes]) -> None:
        received[asker, reply[0]] = reply[1]

    sinks: dict[Any, Callable[[Any], object]] = {r: partial(sink, i) for i, r in enumerate(requesters)}
    bridged.wait(lambda: len(received) == 6, sinks)
    assert {key: read_types(value) for key, value in received.items()} == {
        (i, number): [i + 1] * k for (i, number), k in requests.items()
    }
    node.destroy()


def test_a_big_endian_request_is_understood(bridged: Bridged, bridge_observer: Observer) -> None:
    bridge_observer.ask(do="serve", service="/big", type=GET_TYPES, hold=1)
    node = bridged.bridge.create_node("big", bridged.domain)
    requester = node.create_requester(get_types("big"))
    number = requester.request(names_body(["seven77"], "big"))
    [(answered, reply)] = bridged.take(requester, 1)
    assert (answered, read_types(reply)) == (number, [7])
    node.destroy()


def test_requests_wait_for_a_service_that_is_created_later(
    bridged: Bridged, bridge_observer: Observer
) -> None:
    """Of too many the last are dropped, with a report; no reply reaches another client."""
    node = bridged.bridge.create_node("early", bridged.domain)
    requester = node.create_requester(get_types("later"))
    requester.request(names_body(["n" * HELD_BYTES]))
    numbers = [requester.request(names_body(["n" * i])) for i in range(HELD_CALLS)]
    requester.request(names_body([]))
    crowded = "nobody serves it, and too many wait already"
    label = f"/later [{GET_TYPES}]"
    assert lost(bridged, "/early") == [NoServer("/early", label, crowded, count) for count in (1, 2)]
    bridge_observer.ask(do="serve", service="/later", type=GET_TYPES, hold=1)
    replies = bridged.take(requester, HELD_CALLS)
    assert {number: read_types(reply) for number, reply in replies} == {n: [i] for i, n in enumerate(numbers)}
    assert ServerFound("/early", label, 2) in bridged.reports
    node.destroy()


def test_what_waits_of_all_services_together_is_bounded(
    bridged: Bridged, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(services, "HELD_BYTES_OF_ALL", 1000)
    node = bridged.bridge.create_node("many", bridged.domain)
    first, second = (node.create_requester(get_types(name)) for name in ("nobody_1", "nobody_2"))
    first.request(names_body(["n" * 600]))
    assert not lost(bridged, "/many")
    second.request(names_body(["n" * 600]))
    assert [reported.endpoint for reported in lost(bridged, "/many")] == [f"/nobody_2 [{GET_TYPES}]"]
    first.destroy()
    second.request(names_body(["n" * 600]))
    assert [reported.lost for reported in lost(bridged, "/many")] == [1, 1], (
        "the first one's was lost with it"
    )
    node.destroy()


def lost(bridged: Bridged, node: str) -> list[NoServer]:
    return [
        reported for reported in bridged.reports if isinstance(reported, NoServer) and reported.node == node
    ]


def test_a_service_that_is_deleted_and_created_again(bridged: Bridged, bridge_observer: Observer) -> None:
    """Requests meanwhile wait, or are dropped with a report: ROS 2 would drop them silently."""
    node = bridged.bridge.create_node("patient", bridged.domain)
    requester = node.create_requester(get_types("absent"))
    requester._wait_s = 0.05  # type: ignore[attr-defined]
    requester.request(names_body(["lost"]))
    bridged.wait(lambda: lost(bridged, "/patient"))
    requester._wait_s = 30.0  # type: ignore[attr-defined]
    second = requester.request(names_body(["four"]))
    bridge_observer.ask(do="serve", service="/absent", type=GET_TYPES, hold=1)
    [(number, reply)] = bridged.take(requester, 1)
    assert (number, read_types(reply)) == (second, [4])
    bridge_observer.ask(do="stop_serving")
    bridged.wait(lambda: not found(requester))
    requester._wait_s = 0.05  # type: ignore[attr-defined]
    requester.request(names_body(["lost"]))
    bridged.wait(lambda: len(lost(bridged, "/patient")) == 2)
    requester._wait_s = 30.0  # type: ignore[attr-defined]
    third = requester.request(names_body(["fives"]))
    bridge_observer.ask(do="serve", service="/absent", type=GET_TYPES, hold=1)
    [(number, reply)] = bridged.take(requester, 1)
    assert (number, read_types(reply)) == (third, [5])
    bridge_observer.ask(do="stop_serving")
    bridged.wait(lambda: not found(requester))
    requester.request(names_body(["its client leaves"]))
    node.destroy()
    label = f"/absent [{GET_TYPES}]"
    reasons = ["no server within 0.05 s"] * 2 + ["no server until its client left"]
    assert lost(bridged, "/patient") == [NoServer("/patient", label, reason, 1) for reason in reasons]
    assert bridged.reports.count(ServerFound("/patient", label, 1)) == 2


def test_losses_are_reported_once_and_counted() -> None:
    text = io.StringIO()
    log = EventLog(text)
    report = graph_reporter(log)
    for lost in (1, 2, 3):
        report(NoServer("/n", "/s [T]", "no server within 5 s", lost))
        report(NoClient("/n", "/r [T]", lost))
    report(ServerFound("/n", "/s [T]", 3))
    report(NoServer("/n", "/s [T]", "no server within 5 s", 1))
    assert text.getvalue().splitlines() == [
        "warning: client /s [T] of /n: a request was dropped: no server within 5 s"
        " (further ones are only counted, until somebody does)",
        "service /r [T] of /n: a reply was dropped: the client that asked is gone (further ones are only counted)",
        "client /s [T] of /n: it is served now; 3 requests were dropped before",
        "warning: client /s [T] of /n: a request was dropped: no server within 5 s"
        " (further ones are only counted, until somebody does)",
    ]
    assert log.counters == {"no_server": 4, "no_client": 3}


def test_services_of_the_graph(bridged: Bridged, bridge_observer: Observer) -> None:
    node = bridged.bridge.create_node("robot/services", bridged.domain)
    node.create_replier(get_types("arm/offered"))
    node.create_requester(get_types("arm/wanted"))

    def seen() -> object:
        graph = bridge_observer.ask(do="graph")
        if "/robot/services" not in graph["nodes"]:
            return False
        found = bridge_observer.ask(do="node", node="services", namespace="/robot")
        return found == [[["/arm/offered", [GET_TYPES]]], [["/arm/wanted", [GET_TYPES]]]]

    bridged.wait(seen)
    node.destroy()
    bridge_observer.see(lambda g: "/robot/services" not in g["nodes"])


def test_a_vanished_client_delays_no_other(bridged: Bridged, monkeypatch: pytest.MonkeyPatch) -> None:
    """ROS 2 waits 100 ms for a client that it does not know: it is not asked to before the graph has the client."""
    node = bridged.bridge.create_node("forsaken", bridged.domain)
    asker = bridged.bridge.create_node("leaving", bridged.domain)
    replier = node.create_replier(get_types("forsaken"))
    requester = asker.create_requester(get_types("forsaken"))
    for _ in range(5):
        requester.request(names_body(["a"]))
    bridged.wait(lambda: found(requester))
    identities: list[bytes] = []

    def all_received() -> bool:
        identities.extend(identity for identity, _ in iter(replier.take, None))
        return len(identities) == 5

    bridged.wait(all_received)
    asker.destroy()
    bridged.wait_for(0.2)
    monkeypatch.setattr(services, "WAIT_FOR_CLIENT_S", 0.3)
    start = time.monotonic()
    for identity in identities:
        replier.reply(identity, types_body([1]))
    assert time.monotonic() - start < 0.09
    reports = [NoClient("/forsaken", f"/forsaken [{GET_TYPES}]", lost) for lost in range(1, 6)]
    bridged.wait(
        lambda: [reported for reported in bridged.reports if isinstance(reported, NoClient)] == reports
    )
    # Who was only not discovered in time is answered as soon as the graph has it.
    asker = bridged.bridge.create_node("staying", bridged.domain)
    requester = asker.create_requester(get_types("forsaken"))
    number = requester.request(names_body(["abc"]))
    [(identity, _)] = bridged.take(replier, 1)
    monkeypatch.setattr(services, "WAIT_FOR_CLIENT_S", 30)
    monkeypatch.setattr(replier, "_clients", set)
    replier.reply(identity, types_body([3]))
    assert not bridged.named()
    monkeypatch.undo()
    assert [(n, read_types(reply)) for n, reply in bridged.take(requester, 1)] == [(number, [3])]
    asker.destroy()
    node.destroy()


class Unmatched:
    """ROS 2 with a client that it has not matched yet, though the graph has it: so many attempts fail."""

    def __init__(self, libraries: Libraries, failures: int, takes_s: float = 0.0) -> None:
        self._libraries = libraries
        self.failures = failures
        self.takes_s = takes_s
        self.attempts = 0
        self.times: list[float] = []
        """When each attempt that failed began."""

    def __getattr__(self, name: str) -> Any:
        return getattr(self._libraries, name)

    def send_response(self, *arguments: Any) -> int:
        self.attempts += 1
        if self.attempts > self.failures:
            return int(self._libraries.send_response(*arguments))
        self.times.append(time.monotonic())
        time.sleep(self.takes_s)
        return TIMEOUT


@pytest.mark.parametrize("failures", [1, 2])
def test_a_client_that_is_matched_late_gets_its_replies(
    bridged: Bridged, monkeypatch: pytest.MonkeyPatch, failures: int
) -> None:
    """All of them, in their order, and later ones: on a busy machine the graph is faster than the match."""
    monkeypatch.setattr(services, "DEAF_S", 0.1, raising=False)
    monkeypatch.setattr(services, "WAIT_FOR_CLIENT_S", 300)
    node = bridged.bridge.create_node("hasty", bridged.domain)
    asker = bridged.bridge.create_node("matched_late", bridged.domain)
    replier, requester = node.create_replier(get_types("hasty")), asker.create_requester(get_types("hasty"))
    unmatched = Unmatched(replier._libraries, failures)  # type: ignore[attr-defined]
    monkeypatch.setattr(replier, "_libraries", unmatched)
    numbers = [requester.request(names_body(["abc"])) for _ in range(3)]
    identities = [identity for identity, _ in bridged.take(replier, 3)]
    for size, identity in enumerate(identities):
        replier.reply(identity, types_body([size]))
    assert unmatched.attempts <= 1, "the others wait as well: each attempt may take 100 ms"
    replies = bridged.take(requester, 3)
    assert [(number, read_types(reply)) for number, reply in replies] == [
        (n, [i]) for i, n in enumerate(numbers)
    ]
    assert unmatched.attempts == failures + 3
    number = requester.request(names_body(["abc"]))
    [(identity, _)] = bridged.take(replier, 1)
    replier.reply(identity, types_body([9]))
    assert [(n, read_types(reply)) for n, reply in bridged.take(requester, 1)] == [(number, [9])]
    assert not any(isinstance(r, NoClient) and r.node == "/hasty" for r in bridged.reports)
    asker.destroy()
    node.destroy()


def test_many_clients_that_are_not_matched_delay_the_agent_by_a_tenth(
    bridged: Bridged, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Forty at once, of two services: 100 ms each would stop all boards for four seconds. Who is matched waits not."""
    node = bridged.bridge.create_node("crowded", bridged.domain)
    asker = bridged.bridge.create_node("matched", bridged.domain)
    requester = asker.create_requester(get_types("crowded_0"))
    takes_s, crowd = 0.05, [bytes([0xEE, number] + 14 * [7]) for number in range(20)]
    repliers = [node.create_replier(get_types(f"crowded_{number}")) for number in range(2)]

    def ask_and_answer(size: int) -> None:
        number = requester.request(names_body(["abc"]))
        [(identity, _)] = bridged.take(repliers[0], 1)
        repliers[0].reply(identity, types_body([size]))
        assert [(n, read_types(r)) for n, r in bridged.take(requester, 1)] == [(number, [size])]

    ask_and_answer(1)
    times: list[float] = []
    for replier in repliers:
        in_graph = replier._clients()  # type: ignore[attr-defined]
        monkeypatch.setattr(replier, "_clients", lambda known=in_graph: known | set(crowd))
        libraries = replier._libraries  # type: ignore[attr-defined]
        unmatched = Unmatched(libraries, 1000, takes_s)
        unmatched.times = times
        monkeypatch.setattr(replier, "_libraries", unmatched)
    began = time.monotonic()
    for replier in repliers:
        for guid in crowd:
            replier.reply(guid + bytes(8), types_body([0]))
    assert time.monotonic() - began < 10 * takes_s
    bridged.wait(lambda: len(times) >= 4)
    assert min(after - before for before, after in pairwise(times)) >= 10 * takes_s * 0.99
    monkeypatch.setattr(repliers[0], "_libraries", libraries)
    attempts = len(times)
    ask_and_answer(2)
    assert len(times) <= attempts + 1
    asker.destroy()
    node.destroy()


def test_a_client_that_is_never_matched_is_tried_less_and_less_often() -> None:
    """Each attempt may block the agent; without a match in sight they take less than a hundredth of its time."""
    deaf, now, attempts = services._Reach(), 0.0, []
    while now < 600.0:
        if not deaf.rests(b"guid", now):
            attempts.append(now)
            deaf.missed(b"guid", now)
        now += 0.25
    pauses = [after - before for before, after in pairwise(attempts)]
    assert pauses[:4] == [0.5, 1.0, 2.0, 4.0]
    assert max(pauses) == services.LONGEST_DEAF_S
    deaf.reached(b"guid", {b"guid"})
    assert not deaf.rests(b"guid", attempts[-1])


def test_what_cannot_be_answered_or_asked_is_said(bridged: Bridged) -> None:
    node = bridged.bridge.create_node("errors", bridged.domain)
    replier, requester = node.create_replier(get_types("e1")), node.create_requester(get_types("e2"))
    with pytest.raises(BridgeError, match="identity of 3 bytes"):
        replier.reply(b"abc", types_body([]))
    for send in (requester.request, lambda message: replier.reply(bytes(24), message)):
        with pytest.raises(BridgeError, match="no encapsulation"):
            send(b"\0\1")
    for dropped in (replier, requester, replier):
        dropped.destroy()
    for send in (requester.request, lambda message: replier.reply(bytes(24), message)):
        with pytest.raises(BridgeError, match="is gone"):
            send(types_body([]))
    assert replier.take() is None
    assert requester.take() is None
    node.destroy()
