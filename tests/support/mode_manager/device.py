# SPDX-License-Identifier: Apache-2.0
"""A node with a life cycle and its own mode services, as firmware has them, in a thread."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from typing import Any

from microros_gen.mode_manager.calls import STATE_IDS
from microros_gen.mode_manager.messages import mode_event, parameters_of, transition_event, values_of
from microros_gen.mode_manager.server import CLIENTS_TOPIC, CLIENTS_TYPE
from microros_gen.mode_manager.simulated_node import GOALS
from microros_gen.modes import Status
from microros_gen.ros.endpoints import Publisher
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from tests.support.ros.running import node_in_thread


class Device:
    """Its state and mode; it keeps the mode while it is not active.

    `agent_says` is published as what an agent knows of its client: 0 connected, 1 silent. With `values` it serves
    parameters as well, of which `mode_values` has those of each mode; `reacts` has the modes that it goes to itself,
    and `refused` those that it does not take.
    """

    def __init__(
        self,
        name: str,
        modes: tuple[str, ...],
        values: Mapping[str, Any] | None = None,
        mode_values: Mapping[str, Mapping[str, Any]] | None = None,
    ) -> None:
        self.name, self.modes = name, modes
        self.values, self.mode_values = dict(values or {}), mode_values or {}
        self.reacts: list[str] = []
        self.refused: set[str] = set()
        self.state, self.mode = "unconfigured", "__DEFAULT__"
        self.agent_says: list[int] = []
        self.requests: list[Any] = []

    def serve(self, peer: Peer) -> None:
        """Serve everything."""
        self._states = peer.publisher(f"/{self.name}/transition_event", "lifecycle_msgs/msg/TransitionEvent")
        self._events = peer.publisher(f"/{self.name}/mode_event", "system_modes_msgs/msg/ModeEvent")
        for service, kind, answer in (
            ("get_state", "lifecycle_msgs/srv/GetState", self._get_state),
            ("change_state", "lifecycle_msgs/srv/ChangeState", self._change_state),
            ("get_available_modes", "system_modes_msgs/srv/GetAvailableModes", self._get_modes),
            ("get_mode", "system_modes_msgs/srv/GetMode", self._get_mode),
            ("change_mode", "system_modes_msgs/srv/ChangeMode", self._change_mode),
        ):
            peer.serve(f"/{self.name}/{service}", kind, answer)
        self._changes: Publisher | None = None
        if self.values:
            self._changes = peer.publisher("/parameter_events", "rcl_interfaces/msg/ParameterEvent")
            for service, kind, answer in (
                ("list_parameters", "ListParameters", self._list_parameters),
                ("get_parameters", "GetParameters", self._get_parameters),
                ("set_parameters", "SetParameters", self._set_parameters),
                ("set_parameters_atomically", "SetParametersAtomically", self._set_atomically),
            ):
                peer.serve(f"/{self.name}/{service}", f"rcl_interfaces/srv/{kind}", answer)

    def react(self, mode: str) -> None:
        """Reconfigure itself: inactive, the mode, active; it tells each step."""
        for goal in ("deactivating", "inactive"):
            self._become(goal)
        self._enter(mode, tells=False)
        for goal in ("activating", "active"):
            self._become(goal)
        self._tell_mode(self._former)

    def _become(self, goal: str) -> None:
        self._states.publish(transition_event(Status(self.state), Status(goal)))
        self.state = goal

    def _enter(self, mode: str, tells: bool = True) -> None:
        self._former, self.mode = self.mode, mode
        self._take(self.mode_values.get(mode, {}))
        if tells:
            self._tell_mode(self._former)

    def _tell_mode(self, former: str) -> None:
        self._events.publish(mode_event(Status("active", former), Status("active", self.mode)))

    def _take(self, values: Mapping[str, Any]) -> None:
        self.values.update(values)
        if self._changes is not None and values:
            event = {"node": f"/{self.name}", "changed_parameters": parameters_of(values)}
            self._changes.publish(event)

    def _list_parameters(self, _: Mapping[str, Any]) -> Mapping[str, Any]:
        return {"result": {"names": list(self.values)}}

    def _get_modes(self, _: Mapping[str, Any]) -> Mapping[str, Any]:
        return {"available_modes": list(self.modes)}

    def _get_parameters(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        known = {p["name"]: p["value"] for p in parameters_of(self.values)}
        return {"values": [known.get(name, {"type": 0}) for name in request["names"]]}

    def _set_parameters(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        self._take(values_of(request["parameters"]))
        return {"results": [{"successful": True} for _ in request["parameters"]]}

    def _set_atomically(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        values = values_of(request["parameters"])
        self.requests.append(values)
        self._take(values)
        return {"result": {"successful": True}}

    def _get_state(self, _: Mapping[str, Any]) -> Mapping[str, Any]:
        return {"current_state": {"id": STATE_IDS[self.state], "label": self.state}}

    def _change_state(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        goal = GOALS.get((self.state, request["transition"]["id"]))
        self.requests.append(request["transition"]["label"])
        if goal is not None:
            self._states.publish(transition_event(Status(self.state), Status(goal)))
            self.state = goal
        return {"success": goal is not None}

    def _get_mode(self, _: Mapping[str, Any]) -> Mapping[str, Any]:
        return {"current_mode": self.mode if self.state == "active" else ""}

    def _change_mode(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        mode = request["mode_name"]
        self.requests.append(mode)
        accepts = mode in self.modes and mode not in self.refused
        if self.state not in ("active", "inactive") or not accepts:
            return {"success": False}
        self._enter(mode)
        return {"success": True}


def alive(device: Device) -> AbstractContextManager[None]:
    """Return a context in which the device is there, in a thread."""

    def begin(peer: Peer) -> Callable[[], object]:
        device.serve(peer)
        states = peer.publisher(CLIENTS_TOPIC, CLIENTS_TYPE, Qos(transient_local=True, depth=10))

        def turn() -> None:
            while device.reacts:
                device.react(device.reacts.pop(0))
            while device.agent_says:
                presence = device.agent_says.pop(0)
                states.publish({"key": "0000002A", "presence": presence, "nodes": [f"/{device.name}"]})

        return turn

    return node_in_thread(device.name, begin)
