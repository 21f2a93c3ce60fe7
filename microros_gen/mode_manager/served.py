# SPDX-License-Identifier: Apache-2.0
"""The services and topics of one part that a manager has: those of a system, or of a node without mode services."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microros_gen.mode_manager.calls import ACTIVATE, CLEANUP, CONFIGURE, DEACTIVATE, Announcement, Topic
from microros_gen.mode_manager.messages import (
    MODE_EVENT,
    TRANSITION_EVENT,
    mode_event,
    mode_of,
    state_message,
    transition_event,
    transition_of,
)
from microros_gen.mode_manager.orchestrator import Orchestrator
from microros_gen.modes.model import ACTIVE, INACTIVE, Part, Status, active
from microros_gen.ros.endpoints import Publisher, Server
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos

_LATCHED = Qos(transient_local=True, depth=1)
_STATES = (INACTIVE, ACTIVE)


class ServedPart:
    """Answers for a part. Requests are answered at once; what follows from them is published."""

    def __init__(self, peer: Peer, manager: Orchestrator, part: Part) -> None:
        self._peer = peer
        self._manager = manager
        self._part = part
        self._modes: list[Server] = []
        self._publishers: dict[Topic, Publisher] = {}
        self._publisher(Topic.TRANSITION_REQUEST)
        if part.is_system:
            for topic in Topic:
                self._publisher(topic)
            self._serve_states()
            self.serve_modes()

    def serve_modes(self) -> None:
        """Serve the modes, unless that is done already."""
        if self._modes:
            return
        for service, kind, answer in (
            ("get_mode", "GetMode", self._get_mode),
            ("get_available_modes", "GetAvailableModes", self._get_modes),
            ("change_mode", "ChangeMode", self._change_mode),
        ):
            name = f"/{self._part.name}/{service}"
            self._modes.append(self._peer.serve(name, f"system_modes_msgs/srv/{kind}", answer))

    def leave_modes(self) -> None:
        """Leave the modes to the node, which serves them itself."""
        while self._modes:
            self._peer.remove(self._modes.pop())

    def publish(self, announcement: Announcement) -> None:
        """Publish a request or an event."""
        is_mode = announcement.topic in (Topic.MODE_EVENT, Topic.MODE_REQUEST)
        make = mode_event if is_mode else transition_event
        self._publisher(announcement.topic).publish(make(announcement.start, announcement.goal))

    def _publisher(self, topic: Topic) -> Publisher:
        publisher = self._publishers.get(topic)
        if publisher is None:
            is_request = topic in (Topic.MODE_REQUEST, Topic.TRANSITION_REQUEST)
            is_mode = topic in (Topic.MODE_EVENT, Topic.MODE_REQUEST)
            publisher = self._peer.publisher(
                f"/{self._part.name}/{topic.value}",
                MODE_EVENT if is_mode else TRANSITION_EVENT,
                _LATCHED if is_request else None,
            )
            self._publishers[topic] = publisher
        return publisher

    def _serve_states(self) -> None:
        for service, kind, answer in (
            ("get_state", "GetState", self._get_state),
            ("get_available_states", "GetAvailableStates", self._get_states),
            ("get_available_transitions", "GetAvailableTransitions", self._get_transitions),
            ("change_state", "ChangeState", self._change_state),
        ):
            self._peer.serve(f"/{self._part.name}/{service}", f"lifecycle_msgs/srv/{kind}", answer)

    def _status(self) -> Status:
        return self._manager.statuses()[self._part.name]

    def _get_state(self, _: Mapping[str, Any]) -> Mapping[str, Any]:
        return {"current_state": state_message(self._status().state)}

    def _get_states(self, _: Mapping[str, Any]) -> Mapping[str, Any]:
        return {"available_states": [state_message(state) for state in _STATES]}

    def _get_transitions(self, _: Mapping[str, Any]) -> Mapping[str, Any]:
        """List what leads to another state; a system that is in neither can be commanded to both."""
        state = self._status().state
        known = ((ACTIVATE, "activate", ACTIVE), (DEACTIVATE, "deactivate", INACTIVE))
        return {
            "available_transitions": [
                {
                    "transition": {"id": number, "label": label},
                    "start_state": state_message(state),
                    "goal_state": state_message(goal),
                }
                for number, label, goal in known
                if goal != state
            ]
        }

    def _change_state(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        transition, name = transition_of(request["transition"]), self._part.name
        if transition == ACTIVATE:
            self._manager.request(name, active())
        elif transition == DEACTIVATE:
            self._manager.request(name, Status(INACTIVE))
        elif transition == CONFIGURE:
            self._manager.request(name, Status(INACTIVE), must_configure=True)
        elif transition == CLEANUP:
            self._manager.clean_up(name)
        else:
            return {"success": False}
        return {"success": True}

    def _get_mode(self, _: Mapping[str, Any]) -> Mapping[str, Any]:
        return {"current_mode": mode_of(self._status())}

    def _get_modes(self, _: Mapping[str, Any]) -> Mapping[str, Any]:
        return {"available_modes": list(self._part.modes)}

    def _change_mode(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        mode = request["mode_name"]
        if mode not in self._part.modes:
            return {"success": False}
        self._manager.request(self._part.name, active(mode))
        return {"success": True}
