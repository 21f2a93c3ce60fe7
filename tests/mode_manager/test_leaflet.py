# SPDX-License-Identifier: Apache-2.0
"""Running nodes as parts of a model file: what is printed is read with the same values and types."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import ExitStack
from types import SimpleNamespace
from typing import Any, cast

import pytest
from hypothesis import given
from hypothesis import strategies as st

import microros_gen.mode_manager.leaflet as leaflet_module
from microros_gen.diagnostics import UserError
from microros_gen.mode_manager.leaflet import leaflet, mine
from microros_gen.modes.model import Scalar
from microros_gen.ros.endpoints import Client
from microros_gen.ros.peer import Peer
from tests.support.agent.process import environment, own_domain
from tests.support.mode_manager.device import Device, alive
from tests.support.mode_manager.processes import node
from tests.support.modes.models import model_of

TEXTS = st.text(
    st.characters(min_codepoint=32, max_codepoint=0x2FF, exclude_categories=["Cc", "Cs"]), max_size=9
)
SCALARS = (
    st.booleans(),
    st.integers(-(2**63), 2**63 - 1),
    st.floats(allow_nan=False),
    TEXTS.filter(lambda text: not text.startswith("$(")),
)
VALUES = st.one_of(*SCALARS, *(st.lists(each, min_size=1, max_size=3).map(tuple) for each in SCALARS))


@given(st.dictionaries(st.from_regex(r"[a-z_][a-z0-9_.]{0,8}", fullmatch=True), VALUES, max_size=5))
def test_what_is_printed_is_read_as_it_was(values: dict[str, object]) -> None:
    text = leaflet("left/arm", values)  # type: ignore[arg-type]
    read = model_of(text).parts["left/arm"].modes["__DEFAULT__"].parameters
    assert {name: value.value for name, value in read.items()} == values
    assert all(type(value.value) is type(values[name]) for name, value in read.items())


def test_not_a_number_is_read_as_such() -> None:
    value = model_of(leaflet("a", {"x": math.nan})).parts["a"].modes["__DEFAULT__"].parameters["x"].value
    assert isinstance(value, float)
    assert math.isnan(value)


@pytest.mark.ros
def test_a_node_of_rclpy(monkeypatch: pytest.MonkeyPatch) -> None:
    domain = own_domain()
    for name, value in environment(domain).items():
        monkeypatch.setenv(name, value)
    reported: list[str] = []
    with (
        node(domain, "left/wheel", plain=True, speed=1.0, names=["a", "b"], count=2) as running,
        Peer("miner") as peer,
    ):
        running.wait_for("node ready")
        assert mine(peer, "/left/wheel", 30.0, reported.append) == leaflet(
            "left/wheel",
            {"count": 2, "names": ("a", "b"), "speed": 1.0},
            comment="Its current values; it does not say in which mode.",
        )
        with pytest.raises(UserError) as refused:
            mine(peer, "/left/wheel", 30.0, reported.append, each_mode=True)
        assert [d.id for d in refused.value.diagnostics] == ["MG-8886"]
        with pytest.raises(UserError) as raised:
            mine(peer, "/right/wheel", 0.3, reported.append)
    assert [d.id for d in raised.value.diagnostics] == ["MG-8877"]
    assert reported == []


class FoundLater:
    """A graph in which a service is found each second, those of the modes of /device last; time passes in spin."""

    def __init__(self, count: int, last: bool) -> None:
        self.now = 0.0
        self._count = count
        self._last = last

    def graph(self) -> FoundLater:
        return self

    def services(self) -> tuple[int, ...]:
        return tuple(range(min(int(self.now), self._count)))

    def count_servers(self, name: str) -> int:
        assert name.startswith("/device/")
        return int(self._last and self.now >= self._count)

    def spin(self, done: Callable[[], object], timeout_s: float) -> bool:
        self.now += timeout_s
        return bool(done())


@pytest.mark.parametrize(
    ("count", "last", "timeout_s", "took_s"), [(6, True, 10.0, 6), (3, False, 10.0, 5), (9, True, 4.0, 4)]
)
def test_mode_services_are_waited_for_while_others_are_found(
    monkeypatch: pytest.MonkeyPatch, count: int, last: bool, timeout_s: float, took_s: float
) -> None:
    """On a busy machine the services of a manager are found seconds after those of its node."""
    found = FoundLater(count, last)
    monkeypatch.setattr(leaflet_module, "time", SimpleNamespace(monotonic=lambda: found.now))
    read = leaflet_module._Node(cast(Peer, found), "device", timeout_s, print)
    assert read.has_modes() is (last and count < timeout_s)
    assert found.now == pytest.approx(took_s, abs=0.1)


SPEEDS: dict[str, dict[str, Any]] = {
    "__DEFAULT__": {"speed": 0.5},
    "SLOW": {"speed": 0.2},
    "FAST": {"speed": 2.0, "law": "QUICK"},
}


def device() -> Device:
    found = Device("device", tuple(SPEEDS), {"speed": 0.2, "law": "SLOW", "limit": 3}, SPEEDS)
    found.state, found.mode = "active", "SLOW"
    return found


@pytest.mark.ros
def test_each_mode_is_read_and_the_first_one_is_restored(
    stack: ExitStack, domain: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Only what differs from __DEFAULT__ is printed; a mode that the node refuses is left out, and reported."""
    assert domain >= 0
    mined, reported = device(), list[str]()
    stack.enter_context(alive(mined))
    peer = stack.enter_context(Peer("miner"))
    text = mine(peer, "/device", 30.0, reported.append)
    modes = "__DEFAULT__, SLOW, FAST"
    assert text.splitlines()[0] == (
        f"# Read in the mode SLOW. Its modes: {modes} (--visit reads all of them)."
    )
    assert mined.requests == []
    mined.values["law"] = "SLOW"
    names, create = list[str](), peer.client

    def client(name: str, kind: str) -> Client:
        names.append(name)
        return create(name, kind)

    monkeypatch.setattr(peer, "client", client)
    text = mine(peer, "/device", 30.0, reported.append, each_mode=True)
    assert mined.requests == ["__DEFAULT__", "SLOW", "FAST", "SLOW"]
    assert len(names) == len(set(names)) == 5, "a client of each service, whatever the number of calls"
    assert peer.graph().count_clients("/device/get_mode") == 0
    assert mined.mode == "SLOW"
    default: dict[str, Scalar] = {"law": "SLOW", "limit": 3, "speed": 0.5}
    others: dict[str, dict[str, Scalar]] = {"SLOW": {"speed": 0.2}, "FAST": {"law": "QUICK", "speed": 2.0}}
    assert text == leaflet("device", default, others, "Read in each mode.")
    read = model_of(text).parts["device"].modes
    assert {n: v.value for n, v in read["FAST"].parameters.items()} == {**default, **others["FAST"]}
    mined.refused = {"FAST"}
    text = mine(peer, "/device", 30.0, reported.append, each_mode=True)
    assert reported == ["FAST: the node does not change to it, and it is left out"]
    assert list(model_of(text).parts["device"].modes) == ["__DEFAULT__", "SLOW"]


@pytest.mark.ros
def test_a_node_that_does_not_return_and_one_that_is_not_active(stack: ExitStack, domain: int) -> None:
    assert domain >= 0
    mined = device()
    mined.refused = {"SLOW"}
    stack.enter_context(alive(mined))
    peer = stack.enter_context(Peer("miner"))
    for identity in ("MG-8888", "MG-8887"):
        with pytest.raises(UserError) as raised:
            mine(peer, "/device", 30.0, print, each_mode=True)
        assert [d.id for d in raised.value.diagnostics] == [identity]
        mined.state = "inactive"
    assert mine(peer, "/device", 30.0, print).startswith("# Read while it was not active")
