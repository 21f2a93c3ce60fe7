# SPDX-License-Identifier: Apache-2.0
"""Files of references, as the public agent takes them with `-r`: XML profiles of Fast DDS.

The root is `profiles`, or `dds` with `profiles` in it. Each participant, topic, data_writer, data_reader, requester
and replier has the attribute `profile_name`, by which a CREATE names it; publisher and subscriber are older names of
data_writer and data_reader. Profiles of other things (transports, types, logs) are none of the agent's business.

    <profiles>
        <participant profile_name="participant_profile"><rtps><name>imu_node</name></rtps></participant>
        <topic profile_name="imu__t"><name>rt/imu</name><dataType>sensor_msgs::msg::dds_::Imu_</dataType></topic>
    </profiles>
"""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree import ElementTree
from xml.parsers import expat

from microros_gen.agent.representation.description import Description
from microros_gen.agent.representation.reference import References
from microros_gen.agent.representation.xml import XmlError, from_profile
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
_BESIDE_PROFILES = ("library_settings", "types", "log")


def read_references(sources: Sequence[Source]) -> References:
    """Return what the files hold together; UserError with every fault and its place."""
    diagnostics = Diagnostics()
    gathered = _Gathered(diagnostics)
    for source in sources:
        tree = _Tree(source)
        root = tree.parse(diagnostics)
        if root is not None:
            for profiles in _profiles(root, tree, diagnostics):
                for element in profiles:
                    gathered.add(element, tree)
    diagnostics.check()
    return References(gathered.known)


class _Tree:
    """The elements of one file and where each begins; tags without their namespace."""

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
        """Return the root; None and an error when the text is no XML."""
        try:
            self._parser.Parse(self._source.text.encode(), True)
        except expat.ExpatError as error:
            place = Span(self._source, error.lineno, error.offset + 1)
            diagnostics.error(f"this is no XML: {expat.errors.messages[error.code]}", place)
            return None
        for place in self._doctypes:
            hint = "Remove the <!DOCTYPE …>"
            diagnostics.error("document types and entities are not taken", place, hint)
        return None if self._doctypes else self._builder.close()

    def place(self, element: Element) -> Span:
        """Return where an element begins."""
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
        """Add a profile."""
        place = tree.place(element)
        if element.tag not in _SERVED:
            if element.tag not in _OTHERS:
                hint = nearest(element.tag, _SERVED) or f"There are {', '.join(_SERVED)}"
                self._diagnostics.error(f"there are no profiles of kind '{element.tag}'", place, hint)
            return
        name = element.get("profile_name", "")
        if not name:
            hint = 'Clients ask for it by that name: add profile_name="…"'
            self._diagnostics.error(f"this {element.tag} has no profile_name", place, hint)
        try:
            found = from_profile(element)
        except XmlError as error:
            about = f"{element.tag} '{name}': {error.detail}"
            self._diagnostics.error(about, tree.place(error.element))
            return
        if found and name:
            self._keep(found, name, place)

    def _keep(self, found: tuple[int, Description], name: str, place: Span) -> None:
        kind, description = found
        first = self._places.setdefault((kind, name), place)
        if self.known.setdefault((kind, name), description) != description:
            self._diagnostics.error(
                f"'{name}' is another one already, in {first}", place, "Give one of them another profile_name"
            )


def _profiles(root: Element, tree: _Tree, diagnostics: Diagnostics) -> list[Element]:
    if root.tag == "profiles":
        return [root]
    if root.tag != "dds":
        hint = "The root of a file of references is <profiles>, or <dds> with <profiles> in it"
        diagnostics.error(f"<{root.tag}> holds no references", tree.place(root), hint)
        return []
    for child in root:
        if child.tag not in ("profiles", *_BESIDE_PROFILES):
            hint = "Put profiles into <profiles>…</profiles>"
            diagnostics.error(f"<{child.tag}> cannot stand in <dds>", tree.place(child), hint)
    return root.findall("profiles")
