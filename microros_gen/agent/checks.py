# SPDX-License-Identifier: Apache-2.0
"""Checks before anything is created, so that an application with an invalid last object costs nothing."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection

from microros_gen.agent.representation import (
    Application,
    Description,
    Endpoint,
    Group,
    Participant,
    Service,
    Topic,
)
from microros_gen.agent.ros.names import ros_node, ros_service, ros_topic, ros_type
from microros_gen.agent.wire.constants import Status


class RefusedError(Exception):
    """An object cannot be created; the text is for people, `status` for the client."""

    def __init__(self, status: Status, reason: str) -> None:
        super().__init__(reason)
        self.status = status


def part_ids(application: int, description: Application) -> tuple[int, ...]:
    """Return the object ids of the parts: the n-th of a kind (from 0) has the application's number plus n."""
    counts: Counter[int] = Counter()
    ids = []
    for part in description.parts:
        ids.append((application >> 4) + counts[part.kind] << 4 & 0xFFF0 | part.kind)
        counts[part.kind] += 1
    return tuple(ids)


def check_application(
    application: int, description: Application, taken: Collection[int], maximum: int, replace: bool
) -> None:
    """Check that all parts of an application can be created if `taken` of `maximum` ids are in use (its own excluded).

    Raises RefusedError, or BridgeError for names that are invalid in ROS 2.
    """
    ids = part_ids(application, description)
    present = [object_id for object_id in ids if object_id in taken]
    if present and not replace:
        reason = f"object {present[0]:#06x} exists, although it is a part of it"
        raise RefusedError(Status.ALREADY_EXISTS, reason)
    if len(set(ids)) < len(ids):
        raise RefusedError(Status.RESOURCES, "it has more parts of a kind than there are numbers")
    if len(taken) + 1 + len(ids) - len(present) > maximum:
        raise RefusedError(Status.RESOURCES, f"with it the client would have more than {maximum} objects")
    types: dict[tuple[int | None, str], str] = {}
    for part in description.parts:
        check_object(part.description)
        check_names(part.description)
        if isinstance(part.description, Topic):
            topic = part.description
            if types.setdefault((part.container, topic.name), topic.type_name) != topic.type_name:
                raise RefusedError(Status.INCOMPATIBLE, f"topic {topic.name} has two types in it")


def check_object(description: Description) -> None:
    """Raise RefusedError for settings that ROS 2 cannot represent, rather than ignore them silently."""
    if isinstance(description, Endpoint) and description.content_filter:
        reason = f"ROS 2 cannot filter by content: '{description.content_filter}'"
        raise RefusedError(Status.INCOMPATIBLE, reason)
    if isinstance(description, Group) and any(description.partitions):
        reason = f"ROS 2 has no partitions: '{', '.join(description.partitions)}'"
        raise RefusedError(Status.INCOMPATIBLE, reason)


def check_names(description: Description) -> None:
    """Raise BridgeError for names that are invalid in ROS 2."""
    if isinstance(description, Endpoint) and description.topic is not None:
        description = description.topic
    if isinstance(description, Topic):
        ros_topic(description.name)
        ros_type(description.type_name)
    elif isinstance(description, Service):
        ros_service(description)
    elif isinstance(description, Participant) and description.name.strip("/"):
        ros_node(description.name.strip("/"))
