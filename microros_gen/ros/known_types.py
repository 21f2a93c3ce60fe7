# SPDX-License-Identifier: Apache-2.0
"""Types by name: their codec and hash, from interface files, when they are first used."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import InterfaceSet, resolve_interfaces, split_type_name
from microros_gen.interfaces.find import InterfaceFinder
from microros_gen.interfaces.types import TypeName
from microros_gen.ros.codec import Codec
from microros_gen.ros.errors import RosError


class KnownType:
    """A message, service or action from an interface file, with the codec of its messages."""

    def __init__(self, name: TypeName, interfaces: InterfaceSet) -> None:
        self.name = name
        self.codec = Codec(interfaces)
        self.interfaces = interfaces

    def type_hash(self, name: TypeName) -> str:
        """Return the type hash (RIHS01, REP-2011) of the type, or of a message of the service."""
        return self.interfaces.type_hash(name)


class KnownTypes:
    """Types found in `interface_paths`, the ament index, pip packages and the shipped interfaces, in this order.

    Raises UserError for an interface path that does not exist.
    """

    def __init__(self, interface_paths: Iterable[Path] = ()) -> None:
        self._finder = InterfaceFinder.from_environment(interface_paths)
        diagnostics = Diagnostics()
        self._finder.check_paths(diagnostics)
        diagnostics.check()
        self._known: dict[TypeName, KnownType] = {}

    def message(self, text: str) -> KnownType:
        """Return the message `pkg/msg/Type` or `pkg/Type`, or a derived one such as `pkg/srv/Type_Request`.

        Raises UserError if no interface file declares it or the file is invalid, RosError if it is not a message.
        """
        known = self._find(text, "msg")
        if known.name not in known.interfaces.messages:
            raise RosError(f"{known.name} is not a message")
        return known

    def service(self, text: str) -> KnownType:
        """Return the service `pkg/srv/Type` or `pkg/Type`.

        Raises UserError if no interface file declares it or the file is invalid, RosError if it is not a service.
        """
        known = self._find(text, "srv")
        if known.name not in known.interfaces.services:
            raise RosError(f"{known.name} is not a service")
        return known

    def action(self, text: str) -> KnownType:
        """Return the action `pkg/action/Type` or `pkg/Type`.

        Raises UserError if no interface file declares it or the file is invalid, RosError if it is not an action.
        """
        known = self._find(text, "action")
        if known.name not in known.interfaces.actions:
            raise RosError(f"{known.name} is not an action")
        return known

    def _find(self, text: str, kind: str) -> KnownType:
        name = split_type_name(text, kind)
        if name is None:
            raise RosError(f"'{text}' names no type: pkg/{kind}/Type is expected")
        if name not in self._known:
            diagnostics = Diagnostics()
            interfaces = resolve_interfaces((Named(str(name)),), self._finder, diagnostics)
            diagnostics.check()
            self._known[name] = KnownType(name, interfaces)
        return self._known[name]
