# SPDX-License-Identifier: Apache-2.0
"""Requests, responses and events of parts as messages of ROS."""

from __future__ import annotations

import time
from collections.abc import Collection, Mapping
from typing import Any

from microros_gen.mode_manager.calls import STATE_IDS, STATES_BY_ID, TRANSITIONS, Call, Kind, Values
from microros_gen.modes.model import ACTIVE, UNKNOWN, Scalar, Status
from microros_gen.parameter_server.values import (
    BOOL,
    BOOL_ARRAY,
    BYTE_ARRAY,
    DOUBLE,
    DOUBLE_ARRAY,
    INTEGER,
    INTEGER_ARRAY,
    NOT_SET,
    STRING,
    STRING_ARRAY,
    ParameterValue,
    value_of,
)

MODE_EVENT = "system_modes_msgs/msg/ModeEvent"
TRANSITION_EVENT = "lifecycle_msgs/msg/TransitionEvent"
SERVICES = {
    Kind.GET_STATE: "lifecycle_msgs/srv/GetState",
    Kind.CHANGE_STATE: "lifecycle_msgs/srv/ChangeState",
    Kind.GET_MODE: "system_modes_msgs/srv/GetMode",
    Kind.CHANGE_MODE: "system_modes_msgs/srv/ChangeMode",
    Kind.GET_PARAMETERS: "rcl_interfaces/srv/GetParameters",
    Kind.SET_PARAMETERS: "rcl_interfaces/srv/SetParametersAtomically",
}
_TYPES: Mapping[type, tuple[int, int]] = {
    bool: (BOOL, BOOL_ARRAY),
    int: (INTEGER, INTEGER_ARRAY),
    float: (DOUBLE, DOUBLE_ARRAY),
    str: (STRING, STRING_ARRAY),
}


def state_message(state: str) -> dict[str, Any]:
    """Return a lifecycle_msgs/msg/State."""
    return {"id": STATE_IDS.get(state, 0), "label": state}


def state_of(message: Mapping[str, Any]) -> str:
    """Return the state that a message names; one without a known number is unknown."""
    return STATES_BY_ID.get(message["id"], UNKNOWN)


def mode_of(status: Status) -> str:
    """Return the mode of an active part; empty: it is not active, or in no known mode."""
    return status.mode if status.state == ACTIVE else ""


def transition_of(message: Mapping[str, Any]) -> int:
    """Return the number of a lifecycle_msgs/msg/Transition; like rclcpp, a label counts more than the number."""
    return TRANSITIONS.get(message["label"], int(message["id"]))


def mode_event(start: Status, goal: Status) -> dict[str, Any]:
    """Return a system_modes_msgs/msg/ModeEvent."""
    return {
        "timestamp": time.time_ns(),
        "start_mode": {"label": mode_of(start)},
        "goal_mode": {"label": mode_of(goal)},
    }


def transition_event(start: Status, goal: Status) -> dict[str, Any]:
    """Return a lifecycle_msgs/msg/TransitionEvent; its transition is the one to the goal, if it has a name."""
    label = {"active": "activate", "inactive": "deactivate", "unconfigured": "cleanup"}.get(goal.state, "")
    if (start.state, goal.state) == ("unconfigured", "inactive"):
        label = "configure"
    return {
        "timestamp": time.time_ns(),
        "transition": {"id": TRANSITIONS.get(label, 0), "label": label},
        "start_state": state_message(start.state),
        "goal_state": state_message(goal.state),
    }


def request_of(
    call: Call, names: tuple[str, ...], byte_arrays: Collection[str] = frozenset()
) -> dict[str, Any]:
    """Return the request of a call.

    `names` are those of the parameters that are asked for, `byte_arrays` those that take byte[].
    """
    if call.kind is Kind.CHANGE_STATE:
        labels = {number: label for label, number in TRANSITIONS.items()}
        return {"transition": {"id": call.transition, "label": labels[call.transition]}}
    if call.kind is Kind.CHANGE_MODE:
        return {"mode_name": call.mode}
    if call.kind is Kind.GET_PARAMETERS:
        return {"names": list(names)}
    if call.kind is Kind.SET_PARAMETERS:
        return {"parameters": parameters_of(call.values, byte_arrays)}
    return {}


def parameters_of(values: Values, byte_arrays: Collection[str] = frozenset()) -> list[dict[str, Any]]:
    """Return rcl_interfaces/msg/Parameter of each value; an empty list has the type of no parameter."""
    return [
        {"name": name, "value": _parameter_value(value, name in byte_arrays).message()}
        for name, value in values.items()
        if value is not None
    ]


def values_of(parameters: list[dict[str, Any]]) -> dict[str, Scalar | tuple[Scalar, ...] | None]:
    """Return the values of rcl_interfaces/msg/Parameter, lists as tuples."""
    return {parameter["name"]: scalar_of(parameter["value"]) for parameter in parameters}


def scalar_of(message: Mapping[str, Any]) -> Scalar | tuple[Scalar, ...] | None:
    """Return the value of an rcl_interfaces/msg/ParameterValue; None: it is not set."""
    value = value_of(message).value
    if isinstance(value, (list, bytes)):
        return tuple(value)
    return value if isinstance(value, (bool, int, float, str)) else None


def facts_of(call: Call, response: Mapping[str, Any], names: tuple[str, ...]) -> dict[str, Any]:
    """Return a response as arguments of `Orchestrator.answer`."""
    if call.kind is Kind.GET_STATE:
        return {"success": True, "state": state_of(response["current_state"])}
    if call.kind is Kind.GET_MODE:
        return {"success": True, "mode": response["current_mode"]}
    if call.kind is Kind.GET_PARAMETERS:
        found = [scalar_of(value) for value in response["values"]]
        complete = found if len(found) == len(names) else [None] * len(names)
        values = dict(zip(names, complete, strict=True))
        kinds = zip(names, response["values"], strict=False)  # fewer: no parameter is known
        return {
            "success": True,
            "values": values,
            "byte_arrays": [name for name, value in kinds if value["type"] == BYTE_ARRAY],
        }
    if call.kind is Kind.SET_PARAMETERS:
        result = response["result"]
        return {"success": result["successful"], "reason": result["reason"]}
    return {"success": response["success"]}


def _parameter_value(value: Scalar | tuple[Scalar, ...], is_byte_array: bool) -> ParameterValue:
    if is_byte_array and isinstance(value, tuple):
        return ParameterValue(BYTE_ARRAY, bytes(element for element in value if isinstance(element, int)))
    if isinstance(value, tuple):
        return ParameterValue(_TYPES[type(value[0])][1], list(value)) if value else ParameterValue(NOT_SET)
    return ParameterValue(_TYPES[type(value)][0], value)
