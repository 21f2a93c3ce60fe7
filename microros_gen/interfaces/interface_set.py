# SPDX-License-Identifier: Apache-2.0
"""A closed set of interfaces, with everything that ROS 2 derives from its services and actions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import Any

from microros_gen.diagnostics import Source
from microros_gen.interfaces.derived import messages_of, structures_of
from microros_gen.interfaces.find import PackagePlace
from microros_gen.interfaces.type_description import referenced_types, type_description, type_hash
from microros_gen.interfaces.types import Action, Declaration, Message, Service, TypeName
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Interface:
    """What one file declares, the text it was read from and the package's place (`place.origin`)."""

    declaration: Declaration
    source: Source
    place: PackagePlace

    @property
    def name(self) -> TypeName:
        """The full name of the type."""
        return self.declaration.name

    @property
    def messages(self) -> tuple[Message, ...]:
        """The message itself, or every message of the service or action; a later one may use an earlier one."""
        return messages_of(self.declaration)


@dataclass(frozen=True)
class InterfaceSet:
    """Closed under dependencies: every type that a field names is in it.

    `interfaces` is ordered: a type comes after all types of its fields; types of the same depth by name. The
    order does not depend on the order of the requests. `roots` are the requested types, sorted: names of
    `interfaces`, or of what ROS 2 derives from one of them.
    """

    interfaces: Mapping[TypeName, Interface]
    roots: tuple[TypeName, ...]

    def __iter__(self) -> Iterator[Interface]:
        return iter(self.interfaces.values())

    def __len__(self) -> int:
        return len(self.interfaces)

    @cached_property
    def messages(self) -> Mapping[TypeName, Message]:
        """Every message by its name, derived ones too, each after what it is made of."""
        found = (message for entry in self for message in entry.messages)
        return MappingProxyType({message.name: message for message in found})

    @cached_property
    def services(self) -> Mapping[TypeName, Service]:
        """Every service by its name; those of an action stand before it."""
        found: list[Service] = []
        for declaration in (entry.declaration for entry in self):
            if isinstance(declaration, Action):
                found += [declaration.send_goal, declaration.get_result]
            elif isinstance(declaration, Service):
                found.append(declaration)
        return MappingProxyType({service.name: service for service in found})

    @cached_property
    def actions(self) -> Mapping[TypeName, Action]:
        """Every action by its name."""
        found = (entry.declaration for entry in self)
        return MappingProxyType({d.name: d for d in found if isinstance(d, Action)})

    @cached_property
    def message_roots(self) -> tuple[TypeName, ...]:
        """The requested messages, and every message of the requested services and actions, sorted."""
        found: set[TypeName] = set()
        for name in self.roots:
            found.update(message.name for message in messages_of(self.declaration(name)))
        return tuple(sorted(found))

    @cached_property
    def described(self) -> Mapping[TypeName, Message]:
        """Everything that has a type description: messages, and services and actions as structures."""
        found = (structure for entry in self for structure in structures_of(entry.declaration))
        return MappingProxyType({structure.name: structure for structure in found})

    def declaration(self, name: TypeName) -> Declaration:
        """Return what `name` is: an interface, or a message or service that ROS 2 derives from one.

        KeyError for another name.
        """
        entry = self.interfaces.get(name)
        if entry is not None:
            return entry.declaration
        return self.services[name] if name in self.services else self.messages[name]

    def message(self, name: TypeName) -> Message:
        """Return a message of this set (KeyError for another type)."""
        return self.messages[name]

    def closure(self, name: TypeName) -> tuple[TypeName, ...]:
        """Return the types that `name` is made of, directly or not, without itself, by name."""
        return referenced_types(self.described[name], self.described)

    def type_hash(self, name: TypeName) -> str:
        """Return the RIHS01 hash of `name` (REP-2011): a message, a service, an action, or a derived one."""
        return type_hash(self.described[name], self.described)

    def type_description(self, name: TypeName) -> dict[str, Any]:
        """Return the type description of `name` as data (REP-2016)."""
        return type_description(self.described[name], self.described)

    def hashed_description(self, name: TypeName) -> dict[str, Any]:
        """Return the description with the hashes of all its types, in the form of the .json files of ROS 2."""
        return {
            "type_description_msg": self.type_description(name),
            "type_hashes": [
                {"type_name": str(described), "hash_string": self.type_hash(described)}
                for described in (name, *self.closure(name))
            ],
        }
