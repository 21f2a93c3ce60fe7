# SPDX-License-Identifier: Apache-2.0
"""XML representations, in the profile language that Fast DDS reads.

Its defaults apply: writers are reliable and transient-local, readers best effort and volatile; KEEP_LAST with depth 1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from xml.etree import ElementTree

from microros_gen.agent.representation.dds_xml import (
    Known,
    check_alone,
    is_standard,
    read_application_library,
    read_endpoint,
    read_participant,
    read_qos_library,
    read_topic,
    read_types,
)
from microros_gen.agent.representation.description import (
    Description,
    Durability,
    Endpoint,
    Group,
    Participant,
    Qos,
    Service,
    Topic,
    UnsupportedKindError,
)
from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.agent.wire.errors import MalformedError

Element = ElementTree.Element
_MAXIMUM_DEPTH = 65_535


class XmlError(MalformedError):
    """An element is invalid or missing; `element` is the invalid one, or the one in which it is missing."""

    def __init__(self, element: Element, detail: str) -> None:
        super().__init__("xml", detail)
        self.element = element


def from_xml(kind: int, text: str, domain: int, known: Known | None = None) -> Description:
    """Return the description in `text`, which may refer to the contents of `known`; `domain` is that of the CREATE.

    Raises MalformedError, UnknownNameError, or UnsupportedKindError for kinds without an XML form.
    """
    known = known or Known()
    if kind == ObjectKind.TYPE:
        return read_types(_parse(text), text)
    if kind == ObjectKind.QOSPROFILE:
        return read_qos_library(_parse(text), known)
    if kind == ObjectKind.APPLICATION:
        return read_application_library(_parse(text), known)
    if kind not in _READERS:
        raise UnsupportedKindError(f"XML objects of kind {kind:#04x}")
    tag, read = _READERS[kind]
    if not text.strip():
        if kind in (ObjectKind.PUBLISHER, ObjectKind.SUBSCRIBER):
            return Group()  # clients send an empty text for these
        raise MalformedError("xml", "empty")
    root = _parse(text)
    if kind == ObjectKind.PARTICIPANT and root.tag == "domain_participant_library":
        return read_participant(root, domain)
    element = _find(root, tag)
    if is_standard(element):
        return read_topic(element) if kind == ObjectKind.TOPIC else read_endpoint(element, known)
    return read(element, domain)


def from_profile(element: Element) -> tuple[int, Description] | None:
    """Return kind and description of a profile; None for anything else. Raises XmlError if it is invalid."""
    tag = _OLDER_TAGS.get(element.tag, element.tag)
    for kind, (name, read) in _READERS.items():
        if name == tag and kind not in (ObjectKind.PUBLISHER, ObjectKind.SUBSCRIBER):
            return kind, read(element, 0)
    return None


def _parse(text: str) -> Element:
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise MalformedError("xml", "document types and entities are refused")
    try:
        root = ElementTree.fromstring(text)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise MalformedError("xml", str(error)) from error
    for element in root.iter():
        element.tag = str(element.tag).rpartition("}")[2]
    return root


def _find(root: Element, tag: str) -> Element:
    found = root if root.tag == tag else root.find(tag)
    if found is None:
        raise XmlError(root, f"no element '{tag}'")
    return found


def _text(element: Element, path: str, default: str = "") -> str:
    return (element.findtext(path) or default).strip()


def _required(element: Element, path: str) -> str:
    value = _text(element, path)
    if not value:
        found = element.find(path)
        raise XmlError(element if found is None else found, f"no text in '{path}'")
    return value


def _participant(element: Element, domain: int) -> Participant:
    return Participant(_text(element, "rtps/name") or _text(element, "name"), domain)


def _topic(element: Element, _domain: int) -> Topic:
    return Topic(_required(element, "name"), _required(element, "dataType"))


def _group(element: Element, _domain: int) -> Group:
    check_alone(element, ("data_writer", "data_reader"))
    names = (name.text or "" for name in element.findall("qos/partition/names/name"))
    return Group(element.get("name", ""), tuple(name.strip() for name in names))


def _writer(element: Element, domain: int) -> Endpoint:
    return Endpoint(
        _endpoint_topic(element, domain), 0, _qos(element, "RELIABLE", Durability.TRANSIENT_LOCAL)
    )


def _reader(element: Element, domain: int) -> Endpoint:
    return Endpoint(_endpoint_topic(element, domain), 0, _qos(element, "BEST_EFFORT", Durability.VOLATILE))


def _endpoint_topic(element: Element, domain: int) -> Topic:
    return _topic(_find(element, "topic"), domain)


def _qos(element: Element, reliability: str, durability: Durability) -> Qos:
    kind = _choice(element, "qos/reliability/kind", reliability, ("RELIABLE", "BEST_EFFORT"))
    lasting = _choice(
        element, "qos/durability/kind", durability.name, tuple(member.name for member in Durability)
    )
    history = _choice(element, "topic/historyQos/kind", "KEEP_LAST", ("KEEP_LAST", "KEEP_ALL"))
    depth = _text(element, "topic/historyQos/depth", "1")
    if not (depth.isascii() and depth.isdigit() and len(depth) < 9 and int(depth) <= _MAXIMUM_DEPTH):
        place = element.find("topic/historyQos/depth")
        raise XmlError(
            element if place is None else place, "a history depth that is not a number from 0 to 65535"
        )
    return Qos(kind == "RELIABLE", Durability[lasting], history == "KEEP_LAST", int(depth))


def _choice(element: Element, path: str, default: str, choices: tuple[str, ...]) -> str:
    value = _text(element, path, default)
    for ending in ("", "_RELIABILITY_QOS", "_DURABILITY_QOS", "_HISTORY_QOS"):
        if value.removesuffix(ending) in choices:
            return value.removesuffix(ending)
    place = element.find(path)
    raise XmlError(element if place is None else place, f"'{path}' is not one of {', '.join(choices)}")


def _service(element: Element, _domain: int) -> Service:
    names = [element.get(name, "") for name in ("service_name", "request_type", "reply_type")]
    if not all(names):
        raise XmlError(element, "service_name, request_type or reply_type is missing")
    topics = (_text(element, "request_topic_name"), _text(element, "reply_topic_name"))
    return Service(names[0], names[1], names[2], *topics)


_READERS: Mapping[int, tuple[str, Callable[[Element, int], Description]]] = MappingProxyType(
    {
        ObjectKind.PARTICIPANT: ("participant", _participant),
        ObjectKind.TOPIC: ("topic", _topic),
        ObjectKind.PUBLISHER: ("publisher", _group),
        ObjectKind.SUBSCRIBER: ("subscriber", _group),
        ObjectKind.DATAWRITER: ("data_writer", _writer),
        ObjectKind.DATAREADER: ("data_reader", _reader),
        ObjectKind.REQUESTER: ("requester", _service),
        ObjectKind.REPLIER: ("replier", _service),
    }
)

_OLDER_TAGS: Mapping[str, str] = MappingProxyType({"publisher": "data_writer", "subscriber": "data_reader"})
"""Older names of writers and readers in files of profiles; in a CREATE these are groups."""
