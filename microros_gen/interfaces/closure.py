# SPDX-License-Identifier: Apache-2.0
"""From names of packages and types to the closure of interfaces, in the order of their dependencies."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from graphlib import CycleError, TopologicalSorter
from types import MappingProxyType

from microros_gen.diagnostics import Diagnostics, Source, Span, nearest, nearest_package
from microros_gen.documents.named import Named
from microros_gen.interfaces.derived import declaring_name
from microros_gen.interfaces.find import KINDS, InterfaceFinder, PackagePlace, read_type, types_in
from microros_gen.interfaces.interface_set import Interface, InterfaceSet
from microros_gen.interfaces.msg.action import parse_action
from microros_gen.interfaces.msg.parser import parse_msg
from microros_gen.interfaces.msg.srv import parse_srv
from microros_gen.interfaces.types import Declaration, Field, Message, NamedType, TypeName, element_of

__all__ = ["Interface", "InterfaceSet", "resolve_interfaces", "split_type_name"]

_PARSERS: Mapping[str, Callable[[Source, TypeName, Diagnostics], Declaration | None]] = MappingProxyType(
    {"msg": parse_msg, "srv": parse_srv, "action": parse_action}
)


def resolve_interfaces(
    requested: tuple[Named, ...], finder: InterfaceFinder, diagnostics: Diagnostics
) -> InterfaceSet:
    """Return the closure of what is requested: `pkg` (all its types), `pkg/Type` or `pkg/kind/Type`.

    `pkg/Type` names a type of any kind where the package has one of this name only. Unknown and ambiguous
    packages and types, cycles and every fault of a file go to `diagnostics`, at the request or the field that
    needs them; the set then lacks what is faulty. Call `diagnostics.check()` before using it.
    """
    resolver = _Resolver(finder, diagnostics)
    roots: set[TypeName] = set()
    for request in requested:
        roots.update(resolver.request(request))
    found = resolver.close({declaring_name(name) for name in roots})
    order = _dependency_order(found, diagnostics)
    interfaces = {name: found[name] for name in order}
    return InterfaceSet(
        MappingProxyType(interfaces),
        tuple(sorted(name for name in roots if declaring_name(name) in interfaces)),
    )


def split_type_name(text: str, kind: str = "msg") -> TypeName | None:
    """Return the type that `pkg/Type` (of `kind`) or `pkg/msg/Type` names, or None for another text."""
    parts = text.split("/")
    if len(parts) == 2:
        parts.insert(1, kind)
    return TypeName(*parts) if len(parts) == 3 and all(parts) else None


class _Resolver:
    """Looks each package and each type up once."""

    def __init__(self, finder: InterfaceFinder, diagnostics: Diagnostics) -> None:
        self._finder = finder
        self._diagnostics = diagnostics
        self._places: dict[str, PackagePlace | None] = {}
        self._types: dict[str, frozenset[TypeName]] = {}
        self._own = finder.own_packages()

    def request(self, request: Named) -> tuple[TypeName, ...]:
        """Return the types that a request names; an error where it names none."""
        text = request.name.strip("/")
        if "/" not in text:
            place = self._place(text)
            if place is None:
                self._unknown_package(text, request.span, "")
                return ()
            names = types_in(place)
            if not names:
                self._nothing_to_read(place, request.span)
            return names
        if split_type_name(text) is None:
            self._diagnostics.error(
                f"'{request.name}' names no interface",
                request.span,
                "Write pkg, pkg/Type, pkg/msg/Type, pkg/srv/Type or pkg/action/Type",
                id="MG-2001",
            )
            return ()
        name = self._of_any_kind(text, request.span)
        return (name,) if name is not None and self._known(name, request.span, "") else ()

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
            for message in interface.messages:
                for needed in self._needed(message):
                    if needed not in tried:
                        tried.add(needed)
                        pending.append(needed)
        return found

    def _needed(self, message: Message) -> list[TypeName]:
        """Return the interfaces that the fields of `message` name; an error for each that is missing."""
        found = []
        for field in message.fields:
            element = element_of(field.type)
            if isinstance(element, NamedType):
                need = _need(message, field)
                if self._known(element.name, field.span or message.span, need):
                    found.append(declaring_name(element.name))
        return found

    def _of_any_kind(self, text: str, span: Span | None) -> TypeName | None:
        """Return the type that a request names; None, with an error, where several kinds have `pkg/Type`."""
        names = [name for kind in KINDS if (name := split_type_name(text, kind)) is not None]
        if text.count("/") > 1:
            return names[0]
        existing = [name for name in names if self._has(name)]
        if len(existing) > 1:
            self._diagnostics.error(
                f"'{text}' is ambiguous: {names[0].package} has {' and '.join(map(str, existing))}",
                span,
                f"Write {' or '.join(map(str, existing))}",
                id="MG-2002",
            )
            return None
        return existing[0] if existing else names[0]

    def _read(self, name: TypeName) -> Interface | None:
        place = self._place(name.package)
        source = read_type(place, name, self._diagnostics) if place is not None else None
        if place is None or source is None:
            return None
        declaration = _parsed(source, name, self._diagnostics)
        return Interface(declaration, source, place) if declaration is not None else None

    def _has(self, name: TypeName) -> bool:
        """Return whether there is a file of the type, or of the service or action that it is derived from."""
        place = self._place(name.package)
        if place is None:
            return False
        if name.package not in self._types:
            self._types[name.package] = frozenset(types_in(place))
        return declaring_name(name) in self._types[name.package]

    def _known(self, name: TypeName, span: Span | None, need: str) -> bool:
        """Return whether the type exists; otherwise report it at the request or at the field."""
        place = self._place(name.package)
        if place is None:
            self._unknown_package(name.package, span, need)
            return False
        if self._has(name):
            return True
        self._unknown_type(name, place, span, need)
        return False

    def _unknown_package(self, package: str, span: Span | None, need: str) -> None:
        places = self._finder.packages()
        suggestion = nearest_package(package, (place.name for place in places))
        for place in places:
            if place.folder.name == package:
                suggestion = (
                    f"The folder '{place.folder}' is the package '{place.name}': its package.xml says so."
                )
        looked = f"Add --interface-path and the folder of the package; looked in {self._finder.searched()}"
        self._diagnostics.error(
            f"unknown interface package '{package}'{need}",
            span,
            f"{suggestion} {looked}" if suggestion else looked,
            id="MG-2003",
        )

    def _unknown_type(self, name: TypeName, place: PackagePlace, span: Span | None, need: str) -> None:
        if name.kind not in KINDS:
            message = f"'{name}': the kinds of interfaces are {', '.join(KINDS)}, not '{name.kind}'{need}"
            self._diagnostics.error(
                message, span, f"Write {name.package}/msg/{name.name} for a message", id="MG-2004"
            )
            return
        what = f"package '{name.package}' ({place.folder}) has no type '{name.name}'{need}"
        self._diagnostics.error(what, span, self._near(name, place), id="MG-2005")

    def _near(self, name: TypeName, place: PackagePlace) -> str | None:
        """Return a hint: a place that this one hides, another package with such a type, the nearest type."""
        hidden = next((p for p in self._finder.places(name.package) if name in types_in(p)), None)
        if hidden is not None:
            return f"It hides {hidden.folder}, which has this type: a package is taken from one place only"
        sibling = next((k for k in KINDS if self._has(TypeName(name.package, k, name.name))), None)
        if sibling is not None:
            return f"It has {name.package}/{sibling}/{name.name}"
        packages = (other.name for other in self._finder.packages() if other.name != name.package)
        elsewhere = (p for p in packages if TypeName(p, name.kind, name.name) in self._finder.types(p))
        package = next(elsewhere, None)
        if package is not None:
            kind = "" if name.kind == "msg" else f"{name.kind}/"
            return (
                f"Did you mean '{package}/{kind}{name.name}'? A type without its package is one of the same"
                " package"
            )
        return nearest(name.name, (known.name for known in self._types[place.name]))

    def _nothing_to_read(self, place: PackagePlace, span: Span | None) -> None:
        self._diagnostics.error(
            f"package '{place.name}' ({place.folder}) has no .msg, .srv, .action or .idl file",
            span,
            "They are in its folders msg/, srv/ and action/",
            id="MG-2006",
        )

    def _place(self, package: str) -> PackagePlace | None:
        if package not in self._places:
            own = self._own.get(package, ())
            self._places[package] = own[0] if own else self._finder.package(package)
            if len(own) > 1:
                folders = " and ".join(f"'{place.folder}'" for place in own)
                self._diagnostics.error(
                    f"found {len(own)} packages named '{package}': {folders}",
                    hint="ROS 2 takes a name once: remove one, or name the folder that counts first with"
                    " --interface-path",
                    id="MG-2007",
                )
        return self._places[package]


def _parsed(source: Source, name: TypeName, diagnostics: Diagnostics) -> Declaration | None:
    """Return what a file declares, or None with errors in `diagnostics`."""
    if not source.name.endswith(".idl"):
        return _PARSERS[name.kind](source, name, diagnostics)
    from microros_gen.interfaces.omg_idl.parser import parse_idl  # few packages have such files

    found = Diagnostics()
    declarations = parse_idl(source, name.package, name.kind, found)
    declaration = next((d for d in declarations if d.name == name), None)
    if declaration is None and not found.has_errors():
        declared = ", ".join(str(d.name) for d in declarations) or "nothing"
        found.error(
            f"the file declares {declared} and not {name}",
            Span(source, 1, 1),
            "ROS 2 names a file after the type that it declares",
            id="MG-2008",
        )
    diagnostics.extend(found)
    return declaration


def _need(message: Message, field: Field) -> str:
    """Return what needs a type, in words; a field without a place is one that ROS 2 adds."""
    owner = "" if field.span is not None else f" of {message.name}"
    return f", which the field '{field.name}'{owner} needs"


def _dependency_order(found: Mapping[TypeName, Interface], diagnostics: Diagnostics) -> list[TypeName]:
    """Return the names, each after what it is made of; report cycles and leave their types out."""
    graph = {name: _needs(interface) & found.keys() for name, interface in found.items()}
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
    fields = [f for message in found[ring[0]].messages for f in message.fields]
    span = next((f.span for f in fields if _interface_of(f) == follower), None)
    path = " → ".join(str(name) for name in [*ring, ring[0]])
    diagnostics.error(f"a message contains itself: {path}", span, "Its size would have no end", id="MG-2009")


def _needs(interface: Interface) -> set[TypeName]:
    """Return the interfaces that this one is made of; a service or action uses its own messages."""
    found = {_interface_of(field) for message in interface.messages for field in message.fields}
    own = set() if isinstance(interface.declaration, Message) else {interface.name}
    return {name for name in found if name is not None} - own


def _interface_of(field: Field) -> TypeName | None:
    element = element_of(field.type)
    return declaring_name(element.name) if isinstance(element, NamedType) else None
