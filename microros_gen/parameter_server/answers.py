# SPDX-License-Identifier: Apache-2.0
"""Responses of the four services that only read, as rclcpp gives them."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.parameter_server.node import Held
from microros_gen.ros.endpoints import Value

Parameters = Mapping[str, Held]


def get_parameters(parameters: Parameters, request: Value) -> Value:
    """Return the response of GetParameters; without values where a name is unknown."""
    names = request["names"]
    known = all(name in parameters for name in names)
    return {"values": [parameters[name].value.message() for name in names] if known else []}


def get_parameter_types(parameters: Parameters, request: Value) -> Value:
    """Return the response of GetParameterTypes; without types where a name is unknown."""
    names = request["names"]
    known = all(name in parameters for name in names)
    return {"types": bytes(parameters[name].value.type for name in names) if known else b""}


def describe_parameters(parameters: Parameters, request: Value) -> Value:
    """Return the response of DescribeParameters; without descriptors where a name is unknown."""
    names = request["names"]
    known = all(name in parameters for name in names)
    return {"descriptors": [parameters[name].declared.descriptor() for name in names] if known else []}


def list_parameters(parameters: Parameters, request: Value) -> Value:
    """Return the response of ListParameters: names below a prefix, so many levels deep."""
    listed = [name for name in parameters if _is_listed(name, request["prefixes"], request["depth"])]
    prefixes = dict.fromkeys(name.rpartition(".")[0] for name in listed if "." in name)
    return {"result": {"names": listed, "prefixes": list(prefixes)}}


def _is_listed(name: str, prefixes: list[str], depth: int) -> bool:
    if not prefixes:
        return depth == 0 or name.count(".") < depth
    levels = [_levels(name, prefix) for prefix in prefixes if name == prefix or name.startswith(f"{prefix}.")]
    return bool(levels) and (depth == 0 or min(levels) <= depth)


def _levels(name: str, prefix: str) -> int:
    return 0 if name == prefix else 1 + name[len(prefix) + 1 :].count(".")
