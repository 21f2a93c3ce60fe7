# SPDX-License-Identifier: Apache-2.0
"""The parameter services of a system whose parent has another manager: this one sets the values that the parent gives.

They are named as in the parent: `limit` for `$(parent limit)`. Until one is set, it is the one in `__DEFAULT__` of the
parent.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microros_gen.mode_manager.messages import parameters_of, values_of
from microros_gen.mode_manager.orchestrator import Orchestrator
from microros_gen.ros.peer import Peer


class ServedValues:
    """Answers for a system."""

    def __init__(self, peer: Peer, manager: Orchestrator, system: str) -> None:
        self._manager = manager
        self._system = system
        for service, kind, answer in (
            ("get_parameters", "GetParameters", self._get),
            ("set_parameters_atomically", "SetParametersAtomically", self._set),
        ):
            peer.serve(f"/{system}/{service}", f"rcl_interfaces/srv/{kind}", answer)

    def _get(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        known = self._manager.parent_values(self._system)
        messages = {p["name"]: p["value"] for p in parameters_of(known)}
        return {"values": [messages.get(name, {"type": 0}) for name in request["names"]]}

    def _set(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        reason = self._manager.set_parent_values(self._system, values_of(request["parameters"]))
        return {"result": {"successful": not reason, "reason": reason}}
