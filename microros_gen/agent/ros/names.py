# SPDX-License-Identifier: Apache-2.0
"""Conversion of the DDS names that clients send to ROS names.

Topics are `rt/…`, message types `pkg::msg::dds_::Type_`; a service has the topics `rq/…Request` and `rr/…Reply` with
the types `pkg::srv::dds_::Type_Request_` and `…_Response_`. Those of an action (`…/_action/send_goal` and the like) are
services and topics, with `action` in place of `srv` and `msg`. Source: the design article "Topic and Service name
mapping to DDS" and rmw_fastrtps.
"""

from __future__ import annotations

import re

from microros_gen.agent.representation.description import Service
from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.wire.constants import Status
from microros_gen.interfaces.types import TypeName
from microros_gen.ros.names import ServiceName

MAXIMUM_NAME = 255
"""Characters that ROS 2 allows in the name of a node."""
MAXIMUM_TOPIC = 238
"""Maximum characters of a topic or service; with `rt` or similar and `Request` it must fit into DDS's 255."""
MAXIMUM_TYPE = 200
"""Maximum characters of package and type together; names derived from them must fit into DDS's 255."""
_NAME = r"((?:/[A-Za-z_][A-Za-z0-9_]*)+)"
_TOPIC = re.compile(f"rt{_NAME}", re.ASCII)
_REQUEST = re.compile(f"rq{_NAME}Request", re.ASCII)
_REPLY = re.compile(f"rr{_NAME}Reply", re.ASCII)
_SERVICE = re.compile(_NAME, re.ASCII)
_TYPE = re.compile(r"([a-z][a-z0-9_]*)::(msg|srv|action)::dds_::([A-Z][A-Za-z0-9_]*)_", re.ASCII)
_WRONG = re.compile(r"[^A-Za-z0-9_]", re.ASCII)


def ros_topic(dds_name: str) -> str:
    """Return the absolute ROS name of a DDS topic. Raises BridgeError if it is not a ROS topic."""
    match = _TOPIC.fullmatch(dds_name)
    if not match:
        raise BridgeError(
            f"topic '{_short(dds_name)}' is not a ROS topic: 'rt/' and a ROS name is expected",
            Status.INVALID_DATA,
        )
    return _bounded(match[1], "topic")


def ros_type(dds_name: str) -> TypeName:
    """Return the ROS type of a DDS type name. Raises BridgeError if it is not a ROS message."""
    match = _TYPE.fullmatch(dds_name)
    if not match:
        raise BridgeError(
            f"type '{_short(dds_name)}' is not a ROS message: 'package::msg::dds_::Type_' is expected",
            Status.INVALID_DATA,
        )
    if len(match[1]) + len(match[3]) > MAXIMUM_TYPE:
        raise BridgeError(f"the type name '{_short(dds_name)}' is too long", Status.INVALID_DATA)
    return TypeName(match[1], match[2], match[3])


def ros_service(service: Service) -> ServiceName:
    """Return the ROS names of a service. Raises BridgeError if its topics or types are not those of one ROS service.

    The topics decide; for an empty one, the service's name is used, with or without a leading slash.
    """
    own = service.name if service.name.startswith("/") else f"/{service.name}"
    request = _service_topic(
        service.request_topic or f"rq{own}Request", _REQUEST, "request", "rq/nameRequest"
    )
    reply = _service_topic(service.reply_topic or f"rr{own}Reply", _REPLY, "reply", "rr/nameReply")
    if request != reply:
        raise BridgeError(
            f"requests are for the service {request}, replies for {reply}: ROS 2 has one name for both",
            Status.INVALID_DATA,
        )
    return ServiceName(_bounded(request, "service"), _service_type(service))


def ros_node(name: str) -> tuple[str, str]:
    """Return node name and namespace (absolute) for `name`: `node` or `namespace/node`.

    Characters that ROS does not allow become `_`, a part that begins with a digit gets a `_` in front, and empty parts
    are omitted. Raises BridgeError if nothing remains or a part is too long.
    """
    parts = [_part(part) for part in name.split("/") if part]
    if not parts:
        raise BridgeError("the participant has no name", Status.INVALID_DATA)
    if len(parts[-1]) > MAXIMUM_NAME or sum(len(part) + 1 for part in parts[:-1]) > MAXIMUM_NAME - 10:
        raise BridgeError(f"the node name '{name[:40]}…' is too long", Status.INVALID_DATA)
    return parts[-1], "/" + "/".join(parts[:-1])


def _service_topic(dds_name: str, pattern: re.Pattern[str], what: str, expected: str) -> str:
    match = pattern.fullmatch(dds_name)
    if not match:
        raise BridgeError(
            f"{what} topic '{_short(dds_name)}' is not that of a ROS service: '{expected}' is expected",
            Status.INVALID_DATA,
        )
    return match[1]


def _service_type(service: Service) -> TypeName:
    request, response = ros_type(service.request_type), ros_type(service.reply_type)
    for found, ending in ((request, "_Request"), (response, "_Response")):
        if found.kind == "msg" or not found.name.endswith(ending) or found.name == ending:
            raise BridgeError(
                f"type {found} is not that of a ROS service: 'package::srv::dds_::Type{ending}_' is expected",
                Status.INVALID_DATA,
            )
    name = request.name.removesuffix("_Request")
    if (request.package, request.kind, name) != (
        response.package,
        response.kind,
        response.name.removesuffix("_Response"),
    ):
        raise BridgeError(
            f"request type {request} and reply type {response} are not of one service", Status.INVALID_DATA
        )
    return TypeName(request.package, request.kind, name)


def _bounded(name: str, what: str) -> str:
    if len(name) > MAXIMUM_TOPIC:
        raise BridgeError(f"the {what} name '{_short(name)}' is too long", Status.INVALID_DATA)
    return name


def _part(part: str) -> str:
    clean = _WRONG.sub("_", part)
    return f"_{clean}" if clean[0].isdigit() else clean


def _short(text: str) -> str:
    return text if len(text) <= 80 else f"{text[:80]}…"
