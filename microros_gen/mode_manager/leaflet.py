# SPDX-License-Identifier: Apache-2.0
"""The part of a model file that describes a running node: its parameters with the values that they have now."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Mapping

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.mode_manager.messages import scalar_of
from microros_gen.modes.model import DEFAULT, Scalar
from microros_gen.parameter_server.values import BYTE_ARRAY
from microros_gen.ros.endpoints import Value
from microros_gen.ros.peer import Peer

_KIND = "rcl_interfaces/srv"
_OWN = ("use_sim_time", "start_type_description_service", "qos_overrides.")
"""Parameters of every node of rclcpp and rclpy, which no mode sets."""
_PLAIN = re.compile(r"[A-Za-z_][\w./]*")
Values = Mapping[str, Scalar | tuple[Scalar, ...]]


def mine(peer: Peer, node: str, timeout_s: float, report: Callable[[str], object]) -> str:
    """Return the part of a model file for `node`; `report` gets a line about each parameter that it cannot have.

    `timeout_s` limits each wait, in seconds. Raises UserError if the node does not answer.
    """
    name = node.strip("/")

    def call(service: str, kind: str, **request: object) -> Value:
        response = peer.client(f"/{name}/{service}", f"{_KIND}/{kind}").call(request, timeout_s)
        if response is None:
            hint = "Start it, or name another one; the ROS domain is that of --domain"
            raise UserError([Diagnostic(f"the node '/{name}' does not answer", hint=hint, id="MG-8877")])
        return response

    listed = call("list_parameters", "ListParameters", prefixes=[], depth=0)["result"]["names"]
    names = sorted(each for each in listed if not each.startswith(_OWN))
    values = call("get_parameters", "GetParameters", names=names)["values"] if names else []
    found: dict[str, Scalar | tuple[Scalar, ...]] = {}
    for each, message in zip(names, values, strict=True):
        value = scalar_of(message)
        if value is None or value == () or message["type"] == BYTE_ARRAY:
            report(f"{each}: it has no value, or none that a model file can have, and is left out")
        else:
            found[each] = value
    return leaflet(name, found)


def leaflet(name: str, values: Values) -> str:
    """Return a node with these values as its mode `__DEFAULT__`."""
    lines = [f"{name}:", "  ros__parameters:", "    type: node", "    modes:", f"      {DEFAULT}:"]
    lines.append("        ros__parameters:" if values else "        ros__parameters: {}")
    lines += [f"          {_key(key)}: {_text(value)}" for key, value in values.items()]
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
