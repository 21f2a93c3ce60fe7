# SPDX-License-Identifier: Apache-2.0
"""From names of packages and types to the closure of interfaces, in the order of their dependencies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from types import MappingProxyType
from typing import Any

from microros_gen.diagnostics import Diagnostics, Source, Span, nearest
from microros_gen.model.application import Named
from microros_gen.model.type_description import referenced_types, type_description, type_hash
from microros_gen.model.types import Field, Message, NamedType, TypeName, element_of
from microros_gen.parse.msg import parse_msg
from microros_gen.sources.interfaces import (
    KIND_OF_SUFFIX,
    InterfaceFinder,
    PackagePlace,
    read_type,
    types_in,
    unread_types_in,
)

_ONLY_MSG = "This version reads .msg files; ROS 2 packages mostly bring them beside the .idl files"


@dataclass(frozen=True)
class Interface:
    """One interface: its message, the text it was read from and the package's place (`place.origin`)."""

    message: Message
    source: Source
    place: PackagePlace

    @property
    def name(self) -> TypeName:
        """The full name of the type."""
        return self.message.name


@dataclass(frozen=True)
class InterfaceSet:
    """Closed under dependencies: every type that a field names is in it.

    `interfaces` is ordered: a type comes after all types of its fields; types of the same depth by name. The
    order does not depend on the order of the requests. `roots` are the requested types, sorted.
    """

    interfaces: Mapping[TypeName, Interface]
    roots: tuple[TypeName, ...]

    def __iter__(self) -> Iterator[Interface]:
        return iter(self.interfaces.values())

    def __len__(self) -> int:
        return len(self.interfaces)

    @cached_property
    def messages(self) -> Mapping[TypeName, Message]:
        """The messages by name, in the same order."""
        return MappingProxyType({name: entry.message for name, entry in self.interfaces.items()})

    def message(self, name: TypeName) -> Message:
        """Return the message of a type of this set (KeyError for another)."""
        return self.interfaces[name].message

    def closure(self, name: TypeName) -> tuple[TypeName, ...]:
        """Return the types that `name` is made of, directly or not, without itself, by name."""
        return referenced_types(self.message(name), self.messages)

    def type_hash(self, name: TypeName) -> str:
        """Return the RIHS01 hash of `name` (REP-2011), computed when it is asked for."""
        return type_hash(self.message(name), self.messages)

    def type_description(self, name: TypeName) -> dict[str, Any]:
        """Return the type description of `name` as data (REP-2016)."""
        return type_description(self.message(name), self.messages)


def resolve_interfaces(
    requested: tuple[Named, ...], finder: InterfaceFinder, diagnostics: Diagnostics
) -> InterfaceSet:
    """Return the closure of what is requested: `pkg` (all its types), `pkg/Type` or `pkg/msg/Type`.

    Unknown packages and types, cycles and every fault of a file go to `diagnostics`, at the request or the
    field that needs them; the set then lacks what is faulty. Call `diagnostics.check()` before using it.
    """
    resolver = _Resolver(finder, diagnostics)
    roots: set[TypeName] = set()
    for request in requested:
        roots.update(resolver.request(request))
    found = resolver.close(roots)
    order = _dependency_order(found, diagnostics)
    return InterfaceSet(
        MappingProxyType({name: found[name] for name in order}), tuple(sorted(roots & found.keys()))
    )


def split_type_name(text: str) -> TypeName | None:
    """Return the type that `pkg/Type` or `pkg/msg/Type` names, or None for another text."""
    parts = text.split("/")
    if len(parts) == 2:
        parts.insert(1, "msg")
    return TypeName(*parts) if len(parts) == 3 and all(parts) else None


class _Resolver:
    """Looks each package and each type up once."""

    def __init__(self, finder: InterfaceFinder, diagnostics: Diagnostics) -> None:
        self._finder = finder
        self._diagnostics = diagnostics
        self._places: dict[str, PackagePlace | None] = {}
        self._types: dict[str, frozenset[TypeName]] = {}

    def request(self, request: Named) -> tuple[TypeName, ...]:
        """Return the types that a request names; an error where it names none."""
        text = request.name.strip("/")
        if "/" not in text:
            place = self._place(text)
            if place is None:
                self._unknown_package(text, request.span, None)
                return ()
            names = types_in(place)
            if not names:
                self._nothing_to_read(place, request.span)
            return names
        name = split_type_name(text)
        if name is None:
            self._diagnostics.error(
                f"'{request.name}' names no interface", request.span, "Write pkg, pkg/Type or pkg/msg/Type"
            )
            return ()
        return (name,) if self._known(name, request.span, None) else ()

    def close(self, roots: set[TypeName]) -> dict[TypeName, Interface]:
        """Read `roots` and everything that they are made of."""
        found: dict[TypeName, Interface] = {}
        tried = set(roots)
        pending = sorted(roots, reverse=True)
        while pending:
            interface = self._read(pending.pop())
            if interface is None:
                continue
            found[interface.name] = interface
            for field in interface.message.fields:
                element = element_of(field.type)
                if not isinstance(element, NamedType):
                    continue
                if self._known(element.name, field.span, field) and element.name not in tried:
                    tried.add(element.name)
                    pending.append(element.name)
        return found

    def _read(self, name: TypeName) -> Interface | None:
        place = self._place(name.package)
        source = read_type(place, name, self._diagnostics) if place is not None else None
        if place is None or source is None:
            return None
        message = parse_msg(source, name, self._diagnostics)
        return Interface(message, source, place) if message is not None else None

    def _known(self, name: TypeName, span: Span | None, field: Field | None) -> bool:
        """Return whether the type exists; otherwise say what is missing, at the request or at the field."""
        place = self._place(name.package)
        if place is None:
            self._unknown_package(name.package, span, field)
            return False
        if name.package not in self._types:
            self._types[name.package] = frozenset(types_in(place))
        if name in self._types[name.package]:
            return True
        self._unknown_type(name, place, span, field)
        return False

    def _unknown_package(self, package: str, span: Span | None, field: Field | None) -> None:
        near = nearest(package, (place.name for place in self._finder.packages()))
        need = f", which the field '{field.name}' needs" if field is not None else ""
        looked = f"Looked in {self._finder.searched()}; --interface-path adds a place"
        self._diagnostics.error(
            f"unknown interface package '{package}'{need}", span, f"{near} {looked}" if near else looked
        )

    def _unknown_type(
        self, name: TypeName, place: PackagePlace, span: Span | None, field: Field | None
    ) -> None:
        unread = [stem for stem in unread_types_in(place) if stem.startswith(f"{name.kind}/{name.name}.")]
        need = f", which the field '{field.name}' needs" if field is not None else ""
        if unread:
            self._diagnostics.error(f"'{place.folder / unread[0]}' cannot be read yet{need}", span, _ONLY_MSG)
            return
        if name.kind not in KIND_OF_SUFFIX.values():
            kinds = " and ".join(KIND_OF_SUFFIX.values())
            message = f"'{name}': interfaces of kind {kinds} are read, not '{name.kind}'{need}"
            self._diagnostics.error(message, span, f"Write {name.package}/msg/{name.name} for a message")
            return
        what = f"package '{name.package}' ({place.folder}) has no type '{name.name}'{need}"
        self._diagnostics.error(what, span, self._near(name, place))

    def _near(self, name: TypeName, place: PackagePlace) -> str | None:
        """Return a hint: a place that this one hides, another package with such a type, the nearest type."""
        hidden = next((p for p in self._finder.places(name.package) if name in types_in(p)), None)
        if hidden is not None:
            return f"It hides {hidden.folder}, which has this type: a package is taken from one place only"
        packages = (other.name for other in self._finder.packages() if other.name != name.package)
        elsewhere = (p for p in packages if TypeName(p, name.kind, name.name) in self._finder.types(p))
        package = next(elsewhere, None)
        if package is not None:
            return (
                f"Did you mean '{package}/{name.name}'? A type without its package is one of the same package"
            )
        return nearest(name.name, (known.name for known in self._types[place.name]))

    def _nothing_to_read(self, place: PackagePlace, span: Span | None) -> None:
        unread = unread_types_in(place)
        kinds = ", ".join(sorted(KIND_OF_SUFFIX))
        what = (
            f"only files that cannot be read yet ({', '.join(unread[:3])})" if unread else f"no {kinds} file"
        )
        self._diagnostics.error(f"package '{place.name}' ({place.folder}) has {what}", span, _ONLY_MSG)

    def _place(self, package: str) -> PackagePlace | None:
        if package not in self._places:
            self._places[package] = self._finder.package(package)
        return self._places[package]


def _dependency_order(found: Mapping[TypeName, Interface], diagnostics: Diagnostics) -> list[TypeName]:
    """Return the names, each after what it is made of; report cycles and leave their types out."""
    graph = {name: _needs(interface.message) & found.keys() for name, interface in found.items()}
    while True:
        sorter = TopologicalSorter(graph)
        try:
            sorter.prepare()
        except CycleError as fault:
            cycle = list(reversed(fault.args[1]))
            _report_cycle(cycle, found, diagnostics)
            graph = {name: needs - set(cycle) for name, needs in graph.items() if name not in cycle}
            continue
        order: list[TypeName] = []
        while sorter.is_active():
            ready = sorted(sorter.get_ready())
            order.extend(ready)
            sorter.done(*ready)
        return order


def _report_cycle(
    cycle: list[TypeName], found: Mapping[TypeName, Interface], diagnostics: Diagnostics
) -> None:
    """Report a cycle (its first type again at its end) at the field that leads on from its least type."""
    ring = cycle[:-1]
    start = ring.index(min(ring))
    ring = ring[start:] + ring[:start]
    follower = ring[1] if len(ring) > 1 else ring[0]
    fields = found[ring[0]].message.fields
    span = next((f.span for f in fields if element_of(f.type) == NamedType(follower)), None)
    path = " → ".join(str(name) for name in [*ring, ring[0]])
    diagnostics.error(f"a message contains itself: {path}", span, "Its size would have no end")


def _needs(message: Message) -> set[TypeName]:
    elements = (element_of(field.type) for field in message.fields)
    return {element.name for element in elements if isinstance(element, NamedType)}
