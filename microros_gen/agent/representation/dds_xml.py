# SPDX-License-Identifier: Apache-2.0
"""The XML of the standard (DDS-XRCE 1.0, 7.7.3.2 to 7.7.3.11, based on DDS-XML): types, QoS profiles, applications.

Clients of the public library send Fast DDS profiles instead (module `xml`); elements with the attributes of DDS-XML
(`topic_ref`, `register_type_ref`) are read here. QoS policies that are not set have the defaults of DDS: writers are
reliable, readers best effort; both are volatile and keep the last sample.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from typing import TypeVar
from xml.etree import ElementTree

from microros_gen.agent.representation.description import (
    Application,
    Durability,
    Endpoint,
    Group,
    Part,
    Participant,
    Qos,
    QosProfile,
    Topic,
    TypeDefinition,
    UnknownNameError,
)
from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.records import dataclass

Element = ElementTree.Element
_T = TypeVar("_T")
WRITER, READER = Qos(), Qos(reliable=False)
"""The default QoS of DDS for writers and readers."""
_RELIABILITY = {"RELIABLE": True, "BEST_EFFORT": False}
_HISTORY = {"KEEP_LAST": True, "KEEP_ALL": False}
_DURABILITY = {member.name: member for member in Durability}
_TYPES = ("struct", "union", "enum", "typedef", "bitmask", "bitset")
_LONGEST = 0xFFFFFFFF
"""Largest deadline or lifespan in ms; a longer one is treated as infinite."""


@dataclass(frozen=True)
class Known:
    """What a description may refer to: QoS profiles by `Library::Profile`, and topics of its participant by name."""

    profiles: Mapping[str, QosProfile] = field(default_factory=dict)
    topics: Mapping[str, Topic] = field(default_factory=dict)


def is_standard(element: Element) -> bool:
    """Return whether an element has attributes that only DDS-XML has."""
    return "topic_ref" in element.attrib or "register_type_ref" in element.attrib


def read_types(root: Element, text: str) -> TypeDefinition:
    """Return the one type in `types` that is not nested. Raises MalformedError unless there is exactly one."""
    _expect(root, "types")
    found = [name for name, nested in _types_in(root, "") if not nested]
    if len(found) != 1:
        raise MalformedError("xml", f"{len(found)} types that are not nested in <types>: one is expected")
    return TypeDefinition(found[0], text.strip())


def read_qos_library(root: Element, known: Known) -> QosProfile:
    """Return the only profile of a `qos_library`. Raises MalformedError, or UnknownNameError for its base profile."""
    _expect(root, "qos_library")
    return read_qos_profile(_name(root), _only(root, "qos_profile"), known)


def read_qos_profile(library: str, profile: Element, known: Known) -> QosProfile:
    """Return a profile (`qos_profile`) of the library named `library`. Raises as `read_qos_library`."""
    base = _profile(profile.get("base_name", ""), known)
    return QosProfile(
        f"{library}::{_name(profile)}",
        _qos(profile.find("data_writer_qos"), base.writer or WRITER, known),
        _qos(profile.find("data_reader_qos"), base.reader or READER, known),
    )


def read_application_library(root: Element, known: Known) -> Application:
    """Return the only application of an `application_library`. Raises MalformedError or UnknownNameError."""
    _expect(root, "application_library")
    return read_application(_name(root), _only(root, "application"), known)


def read_application(library: str, application: Element, known: Known) -> Application:
    """Return an application of the library `library`, with its parts. Raises MalformedError or UnknownNameError."""
    parts: list[Part] = []
    for element in application.findall("domain_participant"):
        _add_participant(parts, element, known)
    return Application(f"{library}::{_name(application)}", tuple(parts))


def read_participant(root: Element, domain: int) -> Participant:
    """Return the only participant of a `domain_participant_library`; `domain` is that of the CREATE."""
    _expect(root, "domain_participant_library")
    element = _only(root, "domain_participant")
    check_alone(element, ("topic", "publisher", "subscriber"))
    return Participant(_name(element), domain)


def check_alone(element: Element, contents: tuple[str, ...]) -> None:
    """Raise MalformedError if an element contains objects: without ids, a client could not use them."""
    inside = next((child.tag for child in element if child.tag in contents), None)
    if inside is not None:
        raise MalformedError(
            "xml", f"a {inside} in a {element.tag}: create it by itself, or all of them as an application"
        )


def read_topic(element: Element, types: Mapping[str, str] | None = None) -> Topic:
    """Return a topic; `types` maps registered names to types. Raises MalformedError if the topic names no type."""
    reference = element.get("register_type_ref", "")
    if not reference:
        raise MalformedError("xml", f"topic '{_name(element)}' has no register_type_ref")
    return Topic(_name(element), (types or {}).get(reference, reference))


def read_endpoint(element: Element, known: Known) -> Endpoint:
    """Return a data writer or reader. Raises UnknownNameError for an unknown topic or QoS profile."""
    name = element.get("topic_ref", "")
    topic = known.topics.get(name)
    if topic is None:
        raise UnknownNameError(f"{element.tag} '{element.get('name', '')}': unknown topic '{name}'")
    writes = element.tag == "data_writer"
    qos = _qos(element.find(f"{element.tag}_qos"), WRITER if writes else READER, known)
    separation = _milliseconds(element, f"{element.tag}_qos/time_based_filter/minimum_separation")
    content = (element.findtext("content_filter/expression") or "").strip()
    return Endpoint(topic, 0, qos, 0 if writes else separation, "" if writes else content)


def _add_participant(parts: list[Part], element: Element, known: Known) -> None:
    place = len(parts)
    parts.append(Part(ObjectKind.PARTICIPANT, None, Participant(_name(element), _domain(element))))
    types = {_name(t): t.get("type_ref", "") or _name(t) for t in element.findall("register_type")}
    topics = {}
    for child in element.findall("topic"):
        topics[_name(child)] = topic = read_topic(child, types)
        parts.append(Part(ObjectKind.TOPIC, place, topic))
    inside = replace(known, topics=topics)
    for tag, group, inner, kind in (
        ("publisher", ObjectKind.PUBLISHER, "data_writer", ObjectKind.DATAWRITER),
        ("subscriber", ObjectKind.SUBSCRIBER, "data_reader", ObjectKind.DATAREADER),
    ):
        for child in element.findall(tag):
            parts.append(Part(group, place, Group(child.get("name", ""))))
            container = len(parts) - 1
            parts += (Part(kind, container, read_endpoint(e, inside)) for e in child.findall(inner))


def _qos(element: Element | None, base: Qos, known: Known) -> Qos:
    if element is None:
        return base
    if element.get("base_name"):
        profile = _profile(element.get("base_name", ""), known)
        base = (profile.writer if element.tag == "data_writer_qos" else profile.reader) or base
    depth = (element.findtext("history/depth") or str(base.depth)).strip()
    if not (depth.isascii() and depth.isdigit() and len(depth) < 6 and int(depth) <= 0xFFFF):
        raise MalformedError("xml", "a history depth that is not a number from 0 to 65535")
    return Qos(
        _choice(element, "reliability", _RELIABILITY, base.reliable),
        _choice(element, "durability", _DURABILITY, base.durability),
        _choice(element, "history", _HISTORY, base.keep_last),
        int(depth),
        _milliseconds(element, "deadline/period", base.deadline_ms),
        _milliseconds(element, "lifespan/duration", base.lifespan_ms),
    )


def _choice(element: Element, policy: str, choices: Mapping[str, _T], default: _T) -> _T:
    value = (element.findtext(f"{policy}/kind") or "").strip()
    if not value:
        return default
    found = choices.get(value.removesuffix(f"_{policy.upper()}_QOS"))
    if found is None:
        raise MalformedError("xml", f"{policy} '{value[:40]}' is not one of {', '.join(choices)}")
    return found


def _milliseconds(element: Element, path: str, default: int = 0) -> int:
    found = element.find(path)
    if found is None:
        return default
    numbers = [(found.findtext(part) or "0").strip() for part in ("sec", "nanosec")]
    if any("INFINIT" in number for number in numbers):
        return 0
    if not all(n.isascii() and n.isdigit() and len(n) < 11 for n in numbers):
        raise MalformedError("xml", f"'{path}' is not a time")
    total = int(numbers[0]) * 1000 + int(numbers[1]) // 1_000_000
    return total if total <= _LONGEST else 0


def _profile(name: str, known: Known) -> QosProfile:
    if not name:
        return QosProfile("")
    library, _, profile = name.replace("::", ":").partition(":")  # the standard uses both separators
    found = known.profiles.get(f"{library}::{profile}")
    if found is None:
        raise UnknownNameError(f"unknown quality of service '{name}'")
    return found


def _types_in(root: Element, prefix: str) -> list[tuple[str, bool]]:
    found = []
    waiting = [(root, prefix)]
    while waiting:
        element, within = waiting.pop()
        for child in element:
            name = within + child.get("name", "")
            if child.tag == "module":
                waiting.append((child, name + "::"))
            elif child.tag in _TYPES:
                found.append((name, child.get("nested") == "true"))
    return found


def _only(root: Element, tag: str) -> Element:
    found = root.findall(tag)
    if len(found) != 1:
        raise MalformedError("xml", f"{len(found)} elements '{tag}' in '{root.tag}': one is expected")
    return found[0]


def _expect(root: Element, tag: str) -> None:
    if root.tag != tag:
        raise MalformedError("xml", f"'{tag}' is expected, not '{root.tag[:40]}'")


def _name(element: Element) -> str:
    name = element.get("name", "")
    if not name:
        raise MalformedError("xml", f"an element '{element.tag[:40]}' without a name")
    return name


def _domain(element: Element) -> int:
    text = element.get("domain_id", "0")
    if not (text.isascii() and text.isdigit() and len(text) < 5):
        raise MalformedError("xml", "a domain_id that is not a number")
    return int(text)
