# SPDX-License-Identifier: Apache-2.0
"""Modes of a node with a scripted agent: services, events, refusals, reconfiguration, sleep, reconnection."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.ros.codec import ENCAPSULATION_BYTES, Codec
from tests.support.runtime.driver import Client
from tests.support.runtime.harness import Tree, build
from tests.support.runtime.parts_agent import PartsAgent
from tests.support.runtime.serving_agent import identity
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
profiles: [managed_service]
components: [+node_modes, +sleep_cycles, +session_state]
nodes:
  - name: device
    namespace: /arm
    parameters:
      - {name: speed, type: double, default: 0.5, range: {min: 0.0, max: 2.0}}
      - {name: gains.p, type: integer, default: 3}
      - {name: label, type: string, default: calm}
      - {name: path, type: "double[]", size: 3, default: [1.0, 2.0]}
      - {name: limit, type: double, default: 1.0}
    modes:
      __DEFAULT__: {limit: $(parent limit)}
      SLOW: {speed: 0.2, gains: {p: 1}}
      FAST: {speed: 2, label: wildly, path: [3.0, 4.0, 5.0]}
      BOUND: {limit: 0.25, path: []}
"""
SERVICES = {
    "change_mode": ("system_modes_msgs/srv/ChangeMode", 14),
    "get_available_modes": ("system_modes_msgs/srv/GetAvailableModes", 15),
    "get_mode": ("system_modes_msgs/srv/GetMode", 16),
    "change_state": ("lifecycle_msgs/srv/ChangeState", 3),
}
TRANSITION_EVENT, PARAMETER_EVENT, MODE_EVENT = 0, 1, 2
STEP_MS, SPINS = 20, 12
CONFIGURE, CLEANUP, ACTIVATE, DEACTIVATE = 1, 2, 3, 4
ERROR, INVALID, REJECTED, ON_CALLBACK = 1, 11, 4001, 40004
FAILURE, CALLBACK_ERROR = 1, 99
NEARLY_WRAPPED = 2**32 - 700
VALUES = {
    "__DEFAULT__": "0.50 3 calm 1.00 1.0 2.0",
    "SLOW": "0.20 1 calm 1.00 1.0 2.0",
    "FAST": "2.00 3 wildly 1.00 3.0 4.0 5.0",
}
"""What `show` prints of the values of a mode, where the limit was not set otherwise."""


class Device:
    """The program and its agent."""

    def __init__(self, client: Client, agent: PartsAgent, codec: Codec) -> None:
        self.client, self.agent, self._codec, self.requests = client, agent, codec, 0

    def start(self, *path: int) -> None:
        for call in ("init", "make", *(f"state {step}" for step in path)):
            self.client.ok(call)
        self.spin()
        self.agent.written.clear()
        self.client.ok("calls")

    def spin(self, times: int = SPINS) -> None:
        self.client.spin(times, STEP_MS)

    def request(self, service: str, body: bytes | None = None, **members: Any) -> int:
        self.requests += 1
        kind, place = SERVICES[service]
        if body is None:
            body = self._codec.encode(f"{kind}_Request", members)[ENCAPSULATION_BYTES:]
        target = (place << 4 | 8).to_bytes(2, "big")
        self.client.queued += self.agent.give(target, identity(self.requests) + body)
        return self.requests

    def answer(self, service: str, number: int) -> Any:
        (reply,) = [b[24:] for b in self.agent.answered if b[:24] == identity(number)]
        return self._codec.decode(f"{SERVICES[service][0]}_Response", b"\0\1\0\0" + reply)

    def ask(self, service: str, **members: Any) -> Any:
        number = self.request(service, **members)
        self.spin()
        return self.answer(service, number)

    def change(self, mode: str) -> bool:
        return bool(self.ask("change_mode", mode_name=mode)["success"])

    def mode(self) -> str:
        return str(self.ask("get_mode")["current_mode"])

    def shown(self) -> str:
        """Return state, mode and values, as the program has them."""
        (line,) = self.client.ok("show").lines
        return line.removeprefix("shown ")

    def calls(self) -> list[int]:
        """Return how often the callbacks of modes and of parameters were called, and what a nested call returned."""
        (line,) = self.client.ok("calls").lines
        words = line.split()
        return [int(words[i]) for i in (1, 2, 4)]

    def _of(self, publisher: int, kind: str) -> list[Any]:
        target = ((publisher << 4) | 5).to_bytes(2, "big")
        bodies = [body for written, body in self.agent.written if written == target]
        return [self._codec.decode(kind, b"\0\1\0\0" + body) for body in bodies]

    def events(self) -> list[tuple[str, str]]:
        found = self._of(MODE_EVENT, "system_modes_msgs/msg/ModeEvent")
        return [(event["start_mode"]["label"], event["goal_mode"]["label"]) for event in found]

    def times(self) -> list[int]:
        return [int(e["timestamp"]) for e in self._of(MODE_EVENT, "system_modes_msgs/msg/ModeEvent")]

    def changed(self) -> list[list[str]]:
        """Return the names of the parameters that each event of parameters lists."""
        found = self._of(PARAMETER_EVENT, "rcl_interfaces/msg/ParameterEvent")
        return [[p["name"] for p in event["changed_parameters"]] for event in found]


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Tree:
    return write_application(tmp_path_factory.mktemp("modes") / "tree", APPLICATION)


@pytest.fixture(scope="module")
def program(tree: Tree) -> Path:
    return build(tree.without_port(), ["port_fake.c", "client_modes.c"], "modes")


@pytest.fixture(scope="module")
def codec() -> Codec:
    names = [Named(kind, None) for kind, _ in SERVICES.values()]
    names += [
        Named(f"{m}", None) for m in ("system_modes_msgs/msg/ModeEvent", "rcl_interfaces/msg/ParameterEvent")
    ]
    finder = InterfaceFinder.from_environment((shipped_folder(),))
    return Codec(resolve_interfaces(tuple(names), finder, Diagnostics()))


@pytest.fixture
def device(program: Path, codec: Codec) -> Iterator[Device]:
    agent = PartsAgent()
    with Client(program, agent) as client:
        yield Device(client, agent, codec)


@pytest.mark.parametrize("start_ms", [0, NEARLY_WRAPPED], ids=["zero", "wraps"])
def test_modes_by_service(device: Device, start_ms: int) -> None:
    """The values of a mode are set as a whole, in one event; then ~/mode_event tells both modes."""
    device.client.wait(start_ms)
    device.start(CONFIGURE, ACTIVATE)
    assert device.ask("get_available_modes")["available_modes"] == ["__DEFAULT__", "SLOW", "FAST", "BOUND"]
    assert device.shown() == f"active __DEFAULT__ {VALUES['__DEFAULT__']}"
    former = "__DEFAULT__"
    for mode in ("SLOW", "FAST", "FAST", "__DEFAULT__"):
        device.agent.written.clear()
        assert device.change(mode)
        assert device.mode() == mode
        assert device.shown() == f"active {mode} {VALUES[mode]}"
        assert device.events() == [(former, mode)]
        assert device.changed() == [["speed", "gains.p", "label", "path"]]
        assert device.calls() == [1, 4, 0]
        former = mode


def test_the_time_of_an_event(device: Device) -> None:
    """Nanoseconds since 1970, as the port tells them."""
    device.start(CONFIGURE, ACTIVATE)
    times = (1_700_000_000_123, 4_000_000_000_456)
    for time, mode in zip(times, ("SLOW", "FAST"), strict=True):
        device.client.tell(f"epoch {time}")
        assert device.change(mode)
    assert device.times() == [time * 1_000_000 for time in times]


def test_a_template_keeps_the_value(device: Device) -> None:
    """The system sets it; a mode that has a value replaces it."""
    device.start(CONFIGURE, ACTIVATE)
    device.client.ok("set limit 0.75")
    assert device.change("SLOW")
    assert device.shown() == "active SLOW 0.20 1 calm 0.75 1.0 2.0"
    assert device.change("BOUND")
    assert device.shown() == "active BOUND 0.50 3 calm 0.25"
    assert device.change("__DEFAULT__")
    assert device.shown() == "active __DEFAULT__ 0.50 3 calm 0.25 1.0 2.0"


@pytest.mark.parametrize("name", ["", "slow", "SLO", "SLOWER", "x" * 19, "x" * 60, "y" * 900])
def test_an_unknown_mode(device: Device, name: str) -> None:
    """It is answered, however long it is, and nothing changes."""
    device.start(CONFIGURE, ACTIVATE)
    number = device.request("change_mode", mode_name=name)
    device.client.wait(STEP_MS)
    codes = [device.client.call("spin").code for _ in range(SPINS)]
    assert codes.count(0) >= SPINS - 1
    assert device.answer("change_mode", number) == {"success": False}
    assert device.shown() == f"active __DEFAULT__ {VALUES['__DEFAULT__']}"
    assert (device.events(), device.changed()) == ([], [])
    assert device.client.call("mode nothing").code == INVALID


@pytest.mark.parametrize("body", [b"", b"\5\0\0", b"\xff\xff\xff\xff", b"\5\0\0\0SLO", b"\4\0\0\0SLOW"])
def test_a_broken_request(device: Device, body: bytes) -> None:
    """It changes nothing; the next one is answered."""
    device.start(CONFIGURE, ACTIVATE)
    device.request("change_mode", body)
    device.client.wait(STEP_MS)
    for _ in range(SPINS):
        device.client.call("spin")
    assert device.shown() == f"active __DEFAULT__ {VALUES['__DEFAULT__']}"
    assert device.change("SLOW")


@pytest.mark.parametrize(
    ("path", "state", "changes"),
    [
        ((), "unconfigured", False),
        ((CONFIGURE,), "inactive", True),
        ((CONFIGURE, ACTIVATE), "active", True),
        ((5,), "finalized", False),
    ],
)
def test_the_states_in_which_a_mode_changes(
    device: Device, path: tuple[int, ...], state: str, changes: bool
) -> None:
    """Inactive nodes have no mode from outside, but the one that they will have can be chosen."""
    device.start(*path)
    assert device.change("SLOW") is changes
    mode = "SLOW" if changes else "__DEFAULT__"
    assert device.shown() == f"{state} {mode} {VALUES[mode]}"
    assert device.mode() == ("SLOW" if state == "active" else "")
    assert device.events() == ([("__DEFAULT__", "SLOW")] if changes else [])
    if not changes:
        result = device.client.call("reconfigure SLOW")
        assert (result.code, result.error) == (ERROR, "mode SLOW: the node is neither active nor inactive")


def test_a_mode_outlasts_other_states(device: Device) -> None:
    """Deactivated and activated again, the node is in its mode: nobody has changed its parameters."""
    device.start(CONFIGURE, ACTIVATE)
    assert device.change("FAST")
    device.client.ok(f"state {DEACTIVATE}")
    assert device.mode() == ""
    for step in (CLEANUP, CONFIGURE, ACTIVATE):
        device.client.ok(f"state {step}")
    assert device.mode() == "FAST"
    assert device.shown() == f"active FAST {VALUES['FAST']}"


@pytest.mark.parametrize("who", ["modes", "speed", "path"])
@pytest.mark.parametrize("state", ["active", "inactive"])
def test_a_callback_refuses(device: Device, who: str, state: str) -> None:
    """All or none: what the callback accepted before the value that it refuses is not set either."""
    device.start(CONFIGURE, ACTIVATE, *((DEACTIVATE,) if state == "inactive" else ()))
    device.client.ok(f"refuse {who}")
    assert not device.change("FAST")
    result = device.client.call("mode FAST")
    what = (
        "mode FAST: the callback refused it"
        if who == "modes"
        else f"parameter {who}: the callback refused the value"
    )
    assert (result.code, result.error) == (REJECTED, what)
    assert device.shown() == f"{state} __DEFAULT__ {VALUES['__DEFAULT__']}"
    assert (device.events(), device.changed()) == ([], [])
    device.client.ok("refuse nothing")
    assert device.change("FAST")


def test_callbacks_change_nothing_themselves(device: Device) -> None:
    device.start(CONFIGURE, ACTIVATE)
    device.client.ok("nest")
    assert device.change("SLOW")
    assert device.calls() == [1, 4, ON_CALLBACK]
    device.client.ok("set limit 0.5")
    assert device.calls() == [0, 1, ON_CALLBACK]
    assert device.shown() == "active SLOW 0.20 1 calm 0.50 1.0 2.0"


@pytest.mark.parametrize(
    ("change", "error"),
    [("delete path", "parameter path: unknown"), ("shorten label 5", "parameter label: too long a value")],
)
def test_parameters_that_the_program_changed(device: Device, change: str, error: str) -> None:
    """A parameter that is not there any more, or has less room than the mode needs: nothing is written."""
    device.start(CONFIGURE, ACTIVATE)
    device.client.ok(change)
    device.spin()
    device.agent.written.clear()
    result = device.client.call("mode FAST")
    assert (result.code, result.error) == (ERROR, error)
    assert not device.change("FAST")
    assert device.mode() == "__DEFAULT__"
    assert (device.events(), device.changed()) == ([], [])


def test_reconfiguration(device: Device) -> None:
    """Deactivated, set, checked, activated; the events come in this order, that of the mode at the end."""
    device.start(CONFIGURE, ACTIVATE)
    device.client.ok("reconfigure SLOW")
    assert device.shown() == f"active SLOW {VALUES['SLOW']}"
    device.spin()
    assert device.events() == [("__DEFAULT__", "SLOW")]
    kinds = [target[1] >> 4 for target, _ in device.agent.written]
    assert kinds[:2] == [TRANSITION_EVENT] * 2
    assert kinds[-1] == MODE_EVENT
    device.client.ok(f"state {DEACTIVATE}")
    device.client.ok("reconfigure FAST")
    assert device.shown() == f"inactive FAST {VALUES['FAST']}"


@pytest.mark.parametrize(
    ("failing", "code", "state", "values"),
    [
        # a callback refuses: active in the former mode
        (("refuse modes",), REJECTED, "active", "SLOW"),
        (("refuse label",), REJECTED, "active", "SLOW"),
        # the former mode, and the activation fails then
        (("refuse label", f"fail {ACTIVATE} {FAILURE} 1"), REJECTED, "inactive", "SLOW"),
        # the node does not deactivate
        ((f"fail {DEACTIVATE} {FAILURE} 1",), ERROR, "active", "SLOW"),
        ((f"fail {DEACTIVATE} {CALLBACK_ERROR} 1",), ERROR, "unconfigured", "SLOW"),
        # it does not activate: once, twice, with an error
        ((f"fail {ACTIVATE} {FAILURE} 1",), ERROR, "active", "SLOW"),
        ((f"fail {ACTIVATE} {FAILURE} 2",), ERROR, "inactive", "SLOW"),
        ((f"fail {ACTIVATE} {CALLBACK_ERROR} 1",), ERROR, "unconfigured", "SLOW"),
    ],
)
def test_reconfiguration_that_fails(
    device: Device, failing: tuple[str, ...], code: int, state: str, values: str
) -> None:
    device.start(CONFIGURE, ACTIVATE)
    assert device.change("SLOW")
    device.agent.written.clear()
    for command in failing:
        device.client.ok(command)
    assert device.client.call("reconfigure FAST").code == code
    assert device.shown() == f"{state} {values} {VALUES[values]}"
    device.spin()
    assert device.events() == []
    assert device.mode() == (values if state == "active" else "")


def test_reconfiguration_from_outside(device: Device) -> None:
    """By the services of life cycle and modes alone."""
    device.start(CONFIGURE, ACTIVATE)
    for step, mode in ((DEACTIVATE, "SLOW"), (ACTIVATE, "")):
        assert device.ask("change_state", transition={"id": step, "label": ""})["success"]
        assert not mode or device.change(mode)
    assert device.shown() == f"active SLOW {VALUES['SLOW']}"


def test_an_event_waits_for_the_agent(device: Device) -> None:
    """Together with changes in between: it tells where they began and where they ended."""
    device.start(CONFIGURE, ACTIVATE)
    device.agent.silent = True
    device.spin(400)  # the session is lost
    for mode in ("SLOW", "FAST", "BOUND"):
        device.client.ok(f"mode {mode}")
    device.agent.silent = False
    device.agent.restart()
    device.spin(600)
    assert device.events() == [("__DEFAULT__", "BOUND")]
    assert device.mode() == "BOUND"
    assert device.shown() == "active BOUND 0.50 3 calm 0.25"


def test_the_mode_survives_a_sleep(device: Device, program: Path, codec: Codec, tmp_path: Path) -> None:
    """The values are set again without a question: they were accepted before."""
    device.start(CONFIGURE, ACTIVATE)
    assert device.change("FAST")
    device.client.ok(f"sleep {tmp_path / 'memory'}")
    with Client(program, device.agent) as client:
        client.wait(77_000)
        client.ok(f"wake {tmp_path / 'memory'}")
        woken = Device(client, device.agent, codec)
        woken.requests = 100
        client.ok("refuse modes")
        client.ok("init")
        client.ok("make")
        assert woken.shown() == f"active FAST {VALUES['FAST']}"
        assert woken.mode() == "FAST"
        client.ok("refuse nothing")
        assert woken.change("SLOW")
        client.ok("end")
    agent = PartsAgent()
    with Client(program, agent) as client:  # a cold start
        cold = Device(client, agent, codec)
        cold.start(CONFIGURE, ACTIVATE)
        assert cold.mode() == "__DEFAULT__"


def test_wrong_arguments(device: Device) -> None:
    """Modes need a life cycle and parameters, of one node; nothing remains open."""
    device.client.ok("init")
    assert device.client.call("mode SLOW").code == INVALID
    assert device.client.call("reconfigure SLOW").code == INVALID
    assert device.client.call("end").code == INVALID
    device.client.ok("make")
    device.client.ok("end")
