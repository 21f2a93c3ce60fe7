# SPDX-License-Identifier: Apache-2.0
"""From what a CREATE carries (binary, XML or reference) to one description of the object."""

from __future__ import annotations

from microros_gen.agent.representation.binary import from_binary
from microros_gen.agent.representation.dds_xml import Known
from microros_gen.agent.representation.description import (
    Application,
    Description,
    Durability,
    Endpoint,
    Group,
    Participant,
    Qos,
    QosProfile,
    Service,
    Topic,
    TypeDefinition,
)
from microros_gen.agent.representation.reference import References
from microros_gen.agent.representation.xml import from_xml
from microros_gen.agent.wire.constants import Format, ObjectKind
from microros_gen.agent.wire.entity_messages import Create

__all__ = [
    "Application",
    "Description",
    "Durability",
    "Endpoint",
    "Group",
    "Known",
    "Participant",
    "Qos",
    "QosProfile",
    "References",
    "Service",
    "Topic",
    "TypeDefinition",
    "describe",
]


def describe(create: Create, references: References, known: Known | None = None) -> Description:
    """Return what `create` describes; `known` is what XML may name.

    MalformedError when it cannot be read, UnknownReferenceError for a name that `references` does not hold,
    UnknownNameError for one that `known` does not, UnsupportedKindError for a kind of object without that form.
    """
    if create.format == Format.BINARY:
        return from_binary(create)
    text = create.body.decode("utf-8")
    if create.format == Format.REFERENCE:
        if create.kind == ObjectKind.TYPE and text:
            return TypeDefinition(text)  # ROS 2 knows types by their names
        return references.find(create.kind, text, create.domain)
    return from_xml(create.kind, text, create.domain, known)
