# SPDX-License-Identifier: Apache-2.0
"""Reference files, as the public agent reads them with `-r`: XML profiles of Fast DDS.

The root is `profiles`, or `dds` with `profiles` in it. Each participant, topic, data_writer, data_reader, requester
and replier has the attribute `profile_name`, by which a CREATE refers to it; publisher and subscriber are older names
of data_writer and data_reader. Profiles of anything else (transports, types, logs) are ignored. Libraries of DDS-XML
may follow, or be the root: `qos_library` and `application_library`, to whose contents a CREATE refers as
`Library::Name` (DDS-XRCE 1.0, 7.7.3.2.1 and 7.7.3.5.1).

    <profiles>
        <participant profile_name="participant_profile"><rtps><name>imu_node</name></rtps></participant>
        <topic profile_name="imu__t"><name>rt/imu</name><dataType>sensor_msgs::msg::dds_::Imu_</dataType></topic>
    </profiles>
"""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree import ElementTree
from xml.parsers import expat

from microros_gen.agent.representation.dds_xml import Known, read_application, read_qos_profile
from microros_gen.agent.representation.description import (
    Application,
    Description,
    QosProfile,
    UnknownNameError,
)
from microros_gen.agent.representation.reference import References
from microros_gen.agent.representation.xml import XmlError, from_profile
from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.diagnostics import Diagnostics, Source, Span, nearest

Element = ElementTree.Element
_SERVED = (
    "participant",
    "topic",
    "data_writer",
    "data_reader",
    "requester",
    "replier",
    "publisher",
    "subscriber",
)
_OTHERS = ("domainparticipant_factory", "library_settings", "transport_descriptors", "types", "log")
_LIBRARIES = ("qos_library", "application_library")
"""Libraries of DDS-XML; QoS libraries come first, since applications refer to them."""
_BESIDE_PROFILES = ("library_settings", "types", "log", *_LIBRARIES)


def read_references(sources: Sequence[Source]) -> References:
    """Return the descriptions in all files. Raises UserError with a diagnostic for every fault."""
    diagnostics = Diagnostics()
    gathered = _Gathered(diagnostics)
    libraries: list[tuple[Element, _Tree]] = []
    for source in sources:
        tree = _Tree(source)
        root = tree.parse(diagnostics)
        if root is not None:
            for profiles in _profiles(root, tree, diagnostics):
                for element in profiles:
                    gathered.add(element, tree)
            libraries += ((element, tree) for element in (root, *root) if element.tag in _LIBRARIES)
    for library, tree in sorted(libraries, key=lambda item: _LIBRARIES.index(item[0].tag)):
        gathered.add_library(library, tree)
    diagnostics.check()
    return References(gathered.known)


class _Tree:
    """The elements of one file and their positions; tags have no namespace."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._builder = ElementTree.TreeBuilder()
        self._spans: dict[Element, Span] = {}
        self._parser = expat.ParserCreate(namespace_separator="}")
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._builder.data
        self._parser.StartDoctypeDeclHandler = self._doctype
        self._doctypes: list[Span] = []

    def parse(self, diagnostics: Diagnostics) -> Element | None:
        """Return the root; report an error and return None if the text is not well-formed XML."""
        try:
            self._parser.Parse(self._source.text.encode(), True)
        except expat.ExpatError as error:
            place = Span(self._source, error.lineno, error.offset + 1)
            diagnostics.error(
                f"not well-formed XML: {expat.errors.messages[error.code]}", place, id="MG-9417"
            )
            return None
        for place in self._doctypes:
            hint = "Remove the <!DOCTYPE …>"
            diagnostics.error("document types and entities are not supported", place, hint, id="MG-9418")
        return None if self._doctypes else self._builder.close()

    def place(self, element: Element) -> Span:
        """Return the position of an element."""
        return self._spans[element]

    def _here(self) -> Span:
        return Span(self._source, self._parser.CurrentLineNumber, self._parser.CurrentColumnNumber + 1)

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        self._spans[self._builder.start(tag.rpartition("}")[2], attributes)] = self._here()

    def _end(self, tag: str) -> None:
        self._builder.end(tag.rpartition("}")[2])

    def _doctype(self, *_: object) -> None:
        before = self._source.text[: self._source.text.find("<!DOCTYPE")]
        lines = before.split("\n")
        self._doctypes.append(Span(self._source, len(lines), len(lines[-1]) + 1))


class _Gathered:
    def __init__(self, diagnostics: Diagnostics) -> None:
        self._diagnostics = diagnostics
        self._places: dict[tuple[int, str], Span] = {}
        self.known: dict[tuple[int, str], Description] = {}

    def add(self, element: Element, tree: _Tree) -> None:
        """Add a profile; report it if it is invalid or a duplicate."""
        place = tree.place(element)
        if element.tag not in _SERVED:
            if element.tag not in _OTHERS:
                hint = nearest(element.tag, _SERVED) or f"Available: {', '.join(_SERVED)}"
                self._diagnostics.error(f"unknown kind of profile '{element.tag}'", place, hint, id="MG-9419")
            return
        name = element.get("profile_name", "")
        if not name:
            hint = 'Clients ask for it by that name: add profile_name="…"'
            self._diagnostics.error(f"this {element.tag} has no profile_name", place, hint, id="MG-9420")
        try:
            found = from_profile(element)
        except XmlError as error:
            about = f"{element.tag} '{name}': {error.detail}"
            self._diagnostics.error(about, tree.place(error.element), id="MG-9421")
            return
        if found and name:
            self._keep(found, name, place)

    def add_library(self, library: Element, tree: _Tree) -> None:
        """Add the contents of a QoS or application library as `Library::Name`; report faults and duplicates."""
        name = library.get("name", "")
        if not name:
            self._diagnostics.error(
                f"this {library.tag} has no name", tree.place(library), 'Add name="…"', id="MG-9422"
            )
        profiles = library.tag == "qos_library"
        for element in library.findall("qos_profile" if profiles else "application"):
            qualities = [d for d in self.known.values() if isinstance(d, QosProfile)]
            held = Known({profile.name: profile for profile in qualities})
            found: QosProfile | Application
            try:
                if profiles:
                    found, kind = read_qos_profile(name, element, held), ObjectKind.QOSPROFILE
                else:
                    found, kind = read_application(name, element, held), ObjectKind.APPLICATION
            except (MalformedError, UnknownNameError) as error:
                about = error.detail if isinstance(error, MalformedError) else str(error)
                self._diagnostics.error(
                    f"{element.tag} '{element.get('name', '')}': {about}", tree.place(element), id="MG-9423"
                )
                continue
            self._keep((kind, found), found.name, tree.place(element))

    def _keep(self, found: tuple[int, Description], name: str, place: Span) -> None:
        kind, description = found
        first = self._places.setdefault((kind, name), place)
        if self.known.setdefault((kind, name), description) != description:
            self._diagnostics.error(
                f"duplicate name '{name}'; first in {first}",
                place,
                "Give one of them another profile_name",
                id="MG-9424",
            )


def _profiles(root: Element, tree: _Tree, diagnostics: Diagnostics) -> list[Element]:
    if root.tag == "profiles":
        return [root]
    if root.tag in _LIBRARIES:
        return []
    if root.tag != "dds":
        hint = "The root of a file of references is <profiles>, or <dds> with <profiles> in it"
        diagnostics.error(f"<{root.tag}> contains no references", tree.place(root), hint, id="MG-9425")
        return []
    for child in root:
        if child.tag not in ("profiles", *_BESIDE_PROFILES):
            hint = "Put profiles into <profiles>…</profiles>"
            diagnostics.error(f"<{child.tag}> is not allowed in <dds>", tree.place(child), hint, id="MG-9426")
    return root.findall("profiles")
