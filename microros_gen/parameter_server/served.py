# SPDX-License-Identifier: Apache-2.0
"""One node of a parameter server: its six services, and what goes between those, what is held and the board."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, Protocol

from microros_gen.parameter_server import answers
from microros_gen.parameter_server.exchange import Exchange, Outcome
from microros_gen.parameter_server.node import HeldNode, Merged, parameter
from microros_gen.parameter_server.values import NOT_SET, ParameterValue, value_of
from microros_gen.ros.endpoints import Respond, Value
from microros_gen.ros.peer import Peer

EXCHANGE = "exchange_parameters"
"""Service of a node whose parameters are held, below its name."""
HELD = "held until the node is back"
"""Reason of a set that succeeded while the node was away."""
_READ: Mapping[str, tuple[str, Callable[[answers.Parameters, Value], Value]]] = {
    "get_parameters": ("GetParameters", answers.get_parameters),
    "get_parameter_types": ("GetParameterTypes", answers.get_parameter_types),
    "describe_parameters": ("DescribeParameters", answers.describe_parameters),
    "list_parameters": ("ListParameters", answers.list_parameters),
}
_NO_PARAMETERS = "parameter list cannot be empty"


class Holder(Protocol):
    """The server, as its nodes see it."""

    def keep(self) -> None:
        """Write the file."""

    def tell(self, node: str, event: Merged) -> None:
        """Publish an event."""

    def log(self, text: str) -> None:
        """Take a line for the log."""


class NodeLine:
    """A client of the exchange service of a node."""

    def __init__(self, peer: Peer, node: str) -> None:
        self._client = peer.client(f"{node}/{EXCHANGE}", "microros_parameter_msgs/srv/Exchange")

    def send(self, request: Value, done: Callable[[Value], object]) -> int:
        """Send; see `Line`."""
        return self._client.send(request, done, several=True)

    def forget(self, number: int) -> None:
        """Ignore further responses."""
        self._client.forget(number)

    def available(self) -> bool:
        """Return whether the node is there."""
        return self._client.available()

    def size(self, request: Value) -> int:
        """Return the bytes of a request."""
        return self._client.size(request)


class ServedNode:
    """Not thread-safe."""

    def __init__(self, held: HeldNode, peer: Peer, holder: Holder) -> None:
        """Open the services. Raises RosError: the node's name is none."""
        self.held = held
        self._holder = holder
        self.exchange = Exchange(NodeLine(peer, held.name), self, time.monotonic)
        kinds = "rcl_interfaces/srv"
        for name, (kind, answer) in _READ.items():
            peer.serve(f"{held.name}/{name}", f"{kinds}/{kind}", partial(answer, held.parameters))
        peer.serve_later(f"{held.name}/set_parameters", f"{kinds}/SetParameters", self._set_each)
        peer.serve_later(
            f"{held.name}/set_parameters_atomically", f"{kinds}/SetParametersAtomically", self._set_all
        )

    def log(self, text: str) -> None:
        """Take a line of the exchange."""
        self._holder.log(f"{self.held.name}: {text}")

    def listed(self, items: Sequence[Mapping[str, Any]], complete: bool) -> None:
        """Bring together what is held and what the node has."""
        merged = self.held.merge(items, complete)
        if merged.has_event:
            self._holder.tell(self.held.name, merged)
        self._holder.keep()
        for name, value in merged.push:
            self.exchange.set([parameter(name, value)], partial(self._was_pushed, name, value))

    def _was_pushed(self, name: str, value: ParameterValue, outcome: Outcome | None) -> None:
        if outcome is None:
            return  # it stays pending
        if outcome.successful:
            self.held.has(name, value)
        else:
            changed = self.held.refused(name, value, outcome.reason)
            if changed is not None:
                self._holder.tell(self.held.name, Merged(changed=[changed]))
        self._holder.keep()

    def _set_each(self, request: Value, respond: Respond) -> None:
        """Set one parameter after the other: what is refused does not keep the next ones."""
        wanted, results = list(request["parameters"]), list[Value]()

        def next_one(result: Value | None = None) -> None:
            if result is not None:
                results.append(result)
            if len(results) == len(wanted):
                respond({"results": results})
            else:
                self._set([wanted[len(results)]], next_one)

        next_one()

    def _set_all(self, request: Value, respond: Respond) -> None:
        if request["parameters"]:
            self._set(request["parameters"], lambda result: respond({"result": result}))
        else:
            respond({"result": {"successful": False, "reason": _NO_PARAMETERS}})

    def _set(self, messages: Sequence[Value], done: Callable[[Value], object]) -> None:
        """Set all or none; `done` gets an rcl_interfaces/msg/SetParametersResult."""
        wanted = [(message["name"], value_of(message["value"])) for message in messages]
        is_there = self.exchange.is_open
        refused = self._refusal(wanted, is_there)
        if refused:
            done({"successful": False, "reason": refused})
        elif is_there:
            parameters = [parameter(name, value) for name, value in wanted]
            self.exchange.set(parameters, lambda outcome: done(self._settle(wanted, outcome)))
        else:
            done(self._settle(wanted, None))

    def _refusal(self, wanted: Sequence[tuple[str, ParameterValue]], is_there: bool) -> str:
        """Return why not; a node that is there decides itself about names that are not known here."""
        for name, value in wanted:
            if is_there and name and name not in self.held.parameters:
                continue
            if reason := self.held.refusal(name, value):
                return reason
            if value.type == NOT_SET and not is_there:
                return f"parameter '{name}' cannot be deleted while the node is away"
        return ""

    def _settle(self, wanted: Sequence[tuple[str, ParameterValue]], outcome: Outcome | None) -> Value:
        """Hold what the node took, or what it cannot be asked about."""
        if outcome is not None and not outcome.successful:
            return {"successful": False, "reason": outcome.reason}
        if outcome is None and (reason := self._refusal(wanted, is_there=False)):
            return {"successful": False, "reason": reason}
        event = Merged()
        for name, value in wanted:
            if value.type == NOT_SET:
                event.deleted.append(parameter(name, self.held.parameters.pop(name).value))
            elif name in self.held.parameters:
                self.held.hold(name, value, pending=outcome is None)
                event.changed.append(parameter(name, value))
            else:
                self.exchange.list_again()
        if event.has_event:
            self._holder.tell(self.held.name, event)
        self._holder.keep()
        return {"successful": True, "reason": HELD if outcome is None else ""}
