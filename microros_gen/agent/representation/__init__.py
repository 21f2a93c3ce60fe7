# SPDX-License-Identifier: Apache-2.0
"""Parsing of the representations in a CREATE (binary, XML or reference) into one description of the object."""

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
    """Return the description in `create`, a CREATE (DDS-XRCE 1.0, 7.7.3); XML may refer to the contents of `known`.

    Raises MalformedError if it is invalid, UnknownReferenceError for a name that is not in `references`,
    UnknownNameError for one that is not in `known`, and UnsupportedKindError if the kind of object has no such form.
    """
    if create.format == Format.BINARY:
        return from_binary(create)
    text = create.body.decode("utf-8")
    if create.format == Format.REFERENCE:
        if create.kind == ObjectKind.TYPE and text:
            return TypeDefinition(text)  # ROS 2 knows types by their names
        return references.find(create.kind, text, create.domain)
    return from_xml(create.kind, text, create.domain, known)
