# SPDX-License-Identifier: Apache-2.0
"""Components and profiles, as their YAML files describe them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from pathlib import Path

from microros_gen.application.model import ComponentChange, LimitRule, NodeDecl, Qos
from microros_gen.diagnostics import Span
from microros_gen.documents.named import Named
from microros_gen.records import dataclass
from microros_gen.selection.contribution import NOTHING, Conditions, Contributions
from microros_gen.selection.presence import ABSENT, Presence

NOT_READY = "this version of microros-gen does not have yet"
"""Ends the sentence that says why something planned is refused."""


@dataclass(frozen=True)
class SourceFile:
    """A file below the component's src/, in a plan for which `when` holds."""

    path: str
    when: Conditions = ()


@dataclass(frozen=True)
class Ask:
    """A capability (a group of C functions) of the platform that a component calls where `when` holds."""

    capability: str
    when: Conditions = ()


@dataclass(frozen=True)
class Provision:
    """A capability that a part of a platform provides: the files that have it, and what these ask for.

    A plan in which none of the files has its place lacks the capability. `always`: the application may call it as
    well, so it is there even where no component asks for it. `waits_for_room`: of a transport that had none, room ends
    port_wait.
    """

    capability: str
    sources: tuple[SourceFile, ...]
    asks: tuple[Ask, ...] = ()
    always: bool = False
    waits_for_room: bool = False


@dataclass(frozen=True)
class Implied:
    """An endpoint that the library opens by itself: one in the first node, or one in every node.

    `name` is that of the topic or service; `{node}` and `{ns}` in it are replaced. `queue`: how many samples wait;
    None: follows from the depth. `limits` hold where the application has none for its type. `executed`: an executor
    of the application runs it. `stored`: the library has storage for what it receives; `streamed`: the component takes
    it piece by piece. `unless`: a component that opens another one instead. `outside_ros`: `name` is that of a topic in
    DDS.
    """

    kind: str
    name: str
    type: str
    qos: Qos = Qos()
    queue: int | None = None
    every_node: bool = False
    limits: tuple[LimitRule, ...] = ()
    executed: bool = False
    stored: bool = True
    unless: str = ""
    streamed: bool = False
    outside_ros: bool = False


@dataclass(frozen=True)
class Component:
    """One component: what it needs, what it adds to the wire, which files it brings.

    `layer` is `micro-ROS` for the components of D1.4 (4.10.3), `middleware` or `port` for the layers below.
    `ready` is false for a component that the resolver knows and the runtime does not have yet.
    `headers` are public headers below include/; they become an `#error` when the component is not selected.
    `sends`, `receives` name XRCE submessages; `objects` name XRCE object kinds that the client creates.
    `contributes` is what it adds to files that all share; `presence`, where the tool shows it.
    `asks` are capabilities of the platform; a component of layer `port` `provides` some. `folder` has its files.
    `implies`: what it opens by itself; the components that this takes are among its `needs`.
    `pools` are the keys of the application file's `pools` that have an effect with it. `fills_messages`: it sends
    messages as large as the transport takes, also where those of streams are smaller.
    `origin` says where a component is from that does not ship with the tool; `digest` changes with its files.
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
    sources: tuple[SourceFile, ...] = ()
    asks: tuple[Ask, ...] = ()
    provides: tuple[Provision, ...] = ()
    implies: tuple[Implied, ...] = ()
    pools: tuple[str, ...] = ()
    fills_messages: bool = False
    contributes: Contributions = NOTHING
    presence: Presence = ABSENT
    folder: Path = field(default_factory=Path, compare=False)
    origin: str = ""
    digest: str = ""

    @property
    def identity(self) -> str:
        """Its name; of a component from outside also its digest."""
        return f"{self.name} {self.digest}" if self.digest else self.name

    @property
    def files(self) -> tuple[SourceFile, ...]:
        """All files that the component can bring, each once."""
        provided = (source for provision in self.provides for source in provision.sources)
        return tuple(dict.fromkeys((*self.sources, *provided)))


@dataclass(frozen=True)
class Profile:
    """A micro-ROS profile: components, and defaults for the axes on which it has an opinion.

    `nodes` are those of its example; None: those of the profiles that it extends. `order`: see `in_lists`.
    """

    name: str
    summary: str
    extends: tuple[Named, ...] = ()
    components: tuple[ComponentChange, ...] = ()
    axes: Mapping[str, Named] = field(default_factory=dict)
    builtin: bool = False
    span: Span | None = None
    nodes: tuple[NodeDecl, ...] | None = None
    order: int | None = None


@dataclass(frozen=True)
class ProfileSet:
    """Profiles as they were read: what was requested, and everything that it extends.

    Keys of `profiles`, and the names in `requested` and in each profile's `extends`, are the name of a
    built-in profile or the path of a user's file.
    """

    requested: tuple[Named, ...]
    profiles: Mapping[str, Profile]


@dataclass(frozen=True)
class ResolvedProfile:
    """A profile with everything that it extends folded in; what stands nearer to it wins.

    `requested` is where the user asks for it; None: on the command line.

    `adds` and `drops` hold each component once, with the place that decided it. `axes` maps an axis
    to the value chosen and its place. `nodes` are those of
    its example.
    """

    name: str
    summary: str
    adds: tuple[Named, ...] = ()
    drops: tuple[Named, ...] = ()
    axes: Mapping[str, Named] = field(default_factory=dict)
    builtin: bool = False
    span: Span | None = None
    requested: Span | None = None
    nodes: tuple[NodeDecl, ...] = ()
    order: int | None = None

    def place(self, span: Span | None) -> Span | None:
        """Return where the user can change what stands at `span`: there, or where this profile is asked for.

        Built-in profiles are no files of the user's.
        """
        if self.builtin:
            return self.requested
        own = self.span is not None and span is not None and span.source.name == self.span.source.name
        return span if own else self.span


@dataclass(frozen=True)
class XrceProfile:
    """A profile of OMG DDS-XRCE 1.0, clause 2. `allows` names the submessages that a client may exchange."""

    name: str
    summary: str
    allows: frozenset[str] = frozenset()


@dataclass(frozen=True)
class AxisValue:
    """What one value of an axis brings (profiles/middleware.yaml).

    `component` is selected with it; `xrce` are XRCE profiles of the client, `agent` of the agent's side
    alone. `allows` names submessages that it adds to those of the XRCE profiles.
    """

    axis: str
    value: str
    component: str | None = None
    xrce: tuple[str, ...] = ()
    agent: tuple[str, ...] = ()
    allows: tuple[str, ...] = ()


@dataclass(frozen=True)
class Axis:
    """The values of an axis. `default` holds where nobody chose.

    `several`: an application can have several values at once, none of which excludes another; the default selects
    nothing by itself then.
    """

    values: Mapping[str, AxisValue]
    default: str
    several: bool = False


@dataclass(frozen=True)
class Middleware:
    """The middleware table (profiles/middleware.yaml): D1.4, 4.10.3.2 and OMG DDS-XRCE 1.0, clause 2.

    `components` maps a micro-ROS component to the XRCE profiles that it needs.
    """

    components: Mapping[str, tuple[str, ...]]
    xrce_profiles: Mapping[str, XrceProfile]
    axes: Mapping[str, Axis]


Catalogue = Mapping[str, Component]
"""All components by name, in the order of the names; cannot be changed."""


def in_lists(profile: Profile | ResolvedProfile) -> tuple[bool, int, str]:
    """Return the sort key of a profile: by the `order` of its file, then those without one; each by name."""
    return profile.order is None, profile.order or 0, profile.name
