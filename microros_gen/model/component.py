# SPDX-License-Identifier: Apache-2.0
"""Components and profiles, as their YAML files describe them."""

from __future__ import annotations

from dataclasses import dataclass

from microros_gen.diagnostics import Span
from microros_gen.model.application import ComponentChange, Named


@dataclass(frozen=True)
class Component:
    """One component: what it needs, what it adds to the wire, which files it brings.

    `layer` is `micro-ROS` for the eleven of D1.4 (4.10.3), `middleware` or `port` for what they stand on.
    `ready` is false for a component that the resolver knows and the runtime does not have yet.
    `headers` are public headers below include/; they become an `#error` when the component is not selected.
    `sends`, `receives` name XRCE submessages; `objects` name XRCE object kinds that the client creates.
    """

    name: str
    summary: str
    layer: str
    ready: bool
    needs: tuple[str, ...] = ()
    xrce: tuple[str, ...] = ()
    sends: tuple[str, ...] = ()
    receives: tuple[str, ...] = ()
    objects: tuple[str, ...] = ()
    headers: tuple[str, ...] = ()
    sources: tuple[str, ...] = ()


@dataclass(frozen=True)
class Profile:
    """A micro-ROS profile: components, and defaults for the axes (None: no opinion)."""

    name: str
    summary: str
    extends: tuple[Named, ...] = ()
    components: tuple[ComponentChange, ...] = ()
    entities: Named | None = None
    liveliness: Named | None = None
    transport: Named | None = None
    builtin: bool = False
    span: Span | None = None
