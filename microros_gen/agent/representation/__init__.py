# SPDX-License-Identifier: Apache-2.0
"""From what a CREATE carries (binary, XML or reference) to one description of the object."""

from __future__ import annotations

from microros_gen.agent.representation.binary import from_binary
from microros_gen.agent.representation.description import (
    Description,
    Durability,
    Endpoint,
    Group,
    Participant,
    Qos,
    Service,
    Topic,
)
from microros_gen.agent.representation.reference import References
from microros_gen.agent.representation.xml import from_xml
from microros_gen.agent.wire.constants import Format
from microros_gen.agent.wire.entity_messages import Create

__all__ = [
    "Description",
    "Durability",
    "Endpoint",
    "Group",
    "Participant",
    "Qos",
    "References",
    "Service",
    "Topic",
    "describe",
]


def describe(create: Create, references: References) -> Description:
    """Return what `create` describes.

    MalformedError when it cannot be read, UnknownReferenceError for a name that `references` does not hold,
    UnsupportedKindError for a kind of object that the agent does not have.
    """
    if create.format == Format.BINARY:
        return from_binary(create)
    text = create.body.decode("utf-8")
    if create.format == Format.REFERENCE:
        return references.find(create.kind, text, create.domain)
    return from_xml(create.kind, text, create.domain)
