# SPDX-License-Identifier: Apache-2.0
"""The part of a model file that describes a running node: its parameters, with the values of its modes."""

from __future__ import annotations

import json
import math
import re
import time
from collections.abc import Callable, Mapping
from contextlib import closing
from types import MappingProxyType

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.mode_manager.messages import scalar_of
from microros_gen.modes.model import DEFAULT, Scalar
from microros_gen.parameter_server.values import BYTE_ARRAY
from microros_gen.ros.endpoints import Client, Value
from microros_gen.ros.peer import Peer

_KIND = "rcl_interfaces/srv"
_MODES = "system_modes_msgs/srv"
_QUIET_S = 2.0
"""The mode services of a node may be those of another process, its manager, which is found later than the node. When no
further service was found for so long, it counts as one without modes."""
_PAUSE_S = 0.05
_OWN = ("use_sim_time", "start_type_description_service", "qos_overrides.")
"""Parameters of every node of rclcpp and rclpy, which no mode sets."""
_PLAIN = re.compile(r"[A-Za-z_][\w./]*")
Values = Mapping[str, Scalar | tuple[Scalar, ...]]


def mine(
    peer: Peer, node: str, timeout_s: float, report: Callable[[str], object], each_mode: bool = False
) -> str:
    """Return the part of a model file for `node`; `report` gets a line about each parameter that it cannot have.

    A comment says in which mode the values were read. `each_mode` changes the node to each of its modes, one after
    another, reads what it has there, and returns to the first one.

    `timeout_s` limits each wait, in seconds. Raises UserError if the node does not answer, is in no known mode, or does
    not return to its mode.
    """
    with closing(_Node(peer, node.strip("/"), timeout_s, report)) as read:
        return _mined(read, each_mode)


def _mined(read: _Node, each_mode: bool) -> str:
    values = read.values()
    if not read.has_modes():
        if each_mode:
            hint = "Leave --visit out: its current values are printed"
            raise UserError(
                [Diagnostic(f"the node '/{read.name}' has no mode services", hint=hint, id="MG-8886")]
            )
        return leaflet(read.name, values, comment="Its current values; it does not say in which mode.")
    if each_mode:
        found = read.each_mode()
        default = found.pop(DEFAULT, values)
        others = {mode: _differing(default, known) for mode, known in found.items()}
        return leaflet(read.name, default, others, "Read in each mode.")
    mode, modes = read.mode(), ", ".join(read.modes())
    words = f"Read in the mode {mode}" if mode else "Read while it was not active, or in no known mode"
    return leaflet(read.name, values, comment=f"{words}. Its modes: {modes} (--visit reads all of them).")


class _Node:
    """The services of a running node."""

    def __init__(self, peer: Peer, name: str, timeout_s: float, report: Callable[[str], object]) -> None:
        self.name = name
        self._peer = peer
        self._timeout_s = timeout_s
        self._report = report
        self._clients: dict[str, Client] = {}

    def close(self) -> None:
        """Remove its clients from the peer."""
        while self._clients:
            self._peer.remove(self._clients.popitem()[1])

    def values(self) -> Values:
        """Return the values that it has now."""
        listed = self._call(_KIND, "list_parameters", "ListParameters", prefixes=[], depth=0)["result"][
            "names"
        ]
        names = sorted(each for each in listed if not each.startswith(_OWN))
        values = self._call(_KIND, "get_parameters", "GetParameters", names=names)["values"] if names else []
        found: dict[str, Scalar | tuple[Scalar, ...]] = {}
        for each, message in zip(names, values, strict=True):
            value = scalar_of(message)
            if value is None or value == () or message["type"] == BYTE_ARRAY:
                self._report(f"{each}: it has no value, or none that a model file can have, and is left out")
            else:
                found[each] = value
        return found

    def has_modes(self) -> bool:
        """Return whether it has mode services, or a manager has them for it."""
        graph = self._peer.graph()
        names = [f"/{self.name}/{service}" for service in ("get_mode", "get_available_modes", "change_mode")]
        known, since = graph.services(), time.monotonic()
        end = since + self._timeout_s
        while not self._peer.spin(lambda: all(map(graph.count_servers, names)), _PAUSE_S):
            found, now = graph.services(), time.monotonic()
            if found != known:
                known, since = found, now
            if now >= min(end, since + _QUIET_S):
                return False
        return True

    def mode(self) -> str:
        """Return its mode; empty: it is not active, or in none."""
        return str(self._call(_MODES, "get_mode", "GetMode")["current_mode"])

    def modes(self) -> tuple[str, ...]:
        """Return the names of its modes."""
        return tuple(self._call(_MODES, "get_available_modes", "GetAvailableModes")["available_modes"])

    def each_mode(self) -> dict[str, Values]:
        """Return its values in each mode that it accepts; it is in its first mode again then."""
        first = self.mode()
        if not first:
            message = f"the node '/{self.name}' is in no mode that it could return to"
            raise UserError([Diagnostic(message, hint="Activate it first", id="MG-8887")])
        found: dict[str, Values] = {}
        try:
            for mode in self.modes():
                if self._change(mode):
                    found[mode] = self.values()
                else:
                    self._report(f"{mode}: the node does not change to it, and it is left out")
        finally:
            if not self._change(first):
                message = f"the node '/{self.name}' does not return to its mode {first}"
                hint = "Change its mode with ~/change_mode"
                raise UserError([Diagnostic(message, hint=hint, id="MG-8888")])
        return found

    def _change(self, mode: str) -> bool:
        """Return whether it is in a mode, which was requested."""
        if not self._call(_MODES, "change_mode", "ChangeMode", mode_name=mode)["success"]:
            return False
        end = time.monotonic() + self._timeout_s
        while self.mode() != mode:
            if time.monotonic() >= end:
                return False
            self._peer.spin(lambda: False, _PAUSE_S)
        return True

    def _call(self, package: str, service: str, kind: str, **request: object) -> Value:
        if service not in self._clients:
            self._clients[service] = self._peer.client(f"/{self.name}/{service}", f"{package}/{kind}")
        response = self._clients[service].call(request, self._timeout_s)
        if response is None:
            hint = "Start it, or name another one; the ROS domain is that of --domain"
            message = f"the node '/{self.name}' does not answer"
            raise UserError([Diagnostic(message, hint=hint, id="MG-8877")])
        return response


def _differing(default: Values, values: Values) -> Values:
    return {
        name: value
        for name, value in values.items()
        if name not in default or type(default[name]) is not type(value) or default[name] != value
    }


def leaflet(
    name: str, values: Values, others: Mapping[str, Values] = MappingProxyType({}), comment: str = ""
) -> str:
    """Return a node with these values as its mode `__DEFAULT__`; `others` has what further modes have different."""
    lines = [f"# {comment}"] if comment else []
    lines += [f"{name}:", "  ros__parameters:", "    type: node", "    modes:"]
    for mode, known in {DEFAULT: values, **others}.items():
        lines += [f"      {mode}:", "        ros__parameters:" if known else "        ros__parameters: {}"]
        lines += [f"          {_key(key)}: {_text(value)}" for key, value in known.items()]
    return "".join(f"{line}\n" for line in lines)


def _key(name: str) -> str:
    return name if _PLAIN.fullmatch(name) else json.dumps(name)


def _text(value: Scalar | tuple[Scalar, ...]) -> str:
    """Return a value so that it is read with its type: a double has a point."""
    if isinstance(value, tuple):
        return f"[{', '.join(map(_text, value))}]"
    if not isinstance(value, float):
        return json.dumps(value, ensure_ascii=False)
    if math.isnan(value):
        return ".nan"
    if math.isinf(value):
        return ".inf" if value > 0 else "-.inf"
    mantissa, e, exponent = repr(value).partition("e")
    point = "" if "." in mantissa else ".0"
    return f"{mantissa}{point}{e}{exponent}"
