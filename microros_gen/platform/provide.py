# SPDX-License-Identifier: Apache-2.0
"""Who provides each capability that a plan asks for: the application, a part of the platform, or nobody."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from microros_gen.platform.capabilities import Capability, capabilities
from microros_gen.records import dataclass
from microros_gen.selection.component import Ask, Component, Provision
from microros_gen.selection.contribution import Conditions

APPLICATION = "application"
"""The provider of what the target file leaves to the application (`provides:`)."""


@dataclass(frozen=True)
class Provided:
    """A capability, its provider (a component, APPLICATION; empty: nobody), and the components that ask for it."""

    capability: Capability
    provider: str
    asked_by: tuple[str, ...] = ()

    @property
    def of_application(self) -> bool:
        """Whether the application has to define its functions."""
        return self.provider in ("", APPLICATION)


@dataclass(frozen=True)
class Clash:
    """A file of a part that comes for the capability `kept`, and has another one that is taken from elsewhere."""

    part: str
    file: str
    kept: str
    taken: str


@dataclass(frozen=True)
class Provisions:
    """All capabilities of a plan, in their fixed order, and the files that parts bring for them: part and file."""

    rows: tuple[Provided, ...] = ()
    files: tuple[tuple[str, str], ...] = ()
    clashes: tuple[Clash, ...] = ()

    @property
    def missing(self) -> tuple[Provided, ...]:
        """The capabilities that nobody provides: the application must."""
        return tuple(row for row in self.rows if not row.provider)

    def functions(self, in_example: bool = False) -> tuple[str, ...]:
        """Return the C functions that the application defines; `in_example`: those alone that the example calls."""
        rows = [row for row in self.of_application if not (in_example and row.capability.of_application)]
        return tuple(name for row in rows for name in row.capability.functions)

    @property
    def of_application(self) -> tuple[Provided, ...]:
        """The capabilities whose functions the application defines."""
        return tuple(row for row in self.rows if row.of_application)


def provide(
    selected: Iterable[Component],
    order: tuple[str, ...],
    own: tuple[str, ...],
    holds: Callable[[Conditions], bool],
) -> Provisions:
    """Choose a provider for each capability that the selected components ask for.

    `order` names the parts of the platform, the first one wins; `own` are capabilities of the application. A part
    brings what it says to be there always, too, unless one before it has that. `holds` tells whether conditions do.
    """
    components = tuple(selected)
    by_name = {component.name: component for component in components}
    parts = tuple(by_name[name] for name in order if name in by_name)
    offers = _offers(parts, own, holds)
    requested: dict[str, list[str]] = {}
    waiting: list[tuple[str, Ask]] = [(c.name, ask) for c in components for ask in c.asks]
    for capability, (part, provision) in offers.items():
        if provision.always:
            requested.setdefault(capability, [])
            waiting += [(part, ask) for ask in provision.asks]
    while waiting:
        name, ask = waiting.pop(0)
        if not holds(ask.when):
            continue
        if ask.capability not in requested and ask.capability in offers:
            part, provision = offers[ask.capability]
            waiting += [(part, further) for further in provision.asks]
        askers = requested.setdefault(ask.capability, [])
        if name not in askers:
            askers.append(name)
    found = _provisions(offers, requested, own, holds)
    return replace(found, clashes=_clashes(found, parts, holds))


def _clashes(
    found: Provisions, parts: tuple[Component, ...], holds: Callable[[Conditions], bool]
) -> tuple[Clash, ...]:
    """Return the files that would define a capability for the second time."""
    provider = {row.capability.name: row.provider for row in found.rows}
    clashes = []
    for part in parts:
        has: dict[str, list[str]] = {}
        for provision in part.provides:
            for file in provision.sources:
                if (part.name, file.path) in found.files and holds(file.when):
                    has.setdefault(file.path, []).append(provision.capability)
        for path, names in has.items():
            kept = [name for name in names if provider.get(name) == part.name]
            taken = [name for name in names if provider.get(name, part.name) != part.name]
            clashes += [Clash(part.name, path, kept[0], name) for name in taken if kept]
    return tuple(clashes)


def _offers(
    parts: tuple[Component, ...], own: tuple[str, ...], holds: Callable[[Conditions], bool]
) -> dict[str, tuple[str, Provision]]:
    """Return for each capability the part that would provide it, and how."""
    found: dict[str, tuple[str, Provision]] = {}
    for part in parts:
        for provision in part.provides:
            available = any(holds(file.when) for file in provision.sources)
            if available and provision.capability not in own:
                found.setdefault(provision.capability, (part.name, provision))
    return found


def _provisions(
    offers: dict[str, tuple[str, Provision]],
    requested: dict[str, list[str]],
    own: tuple[str, ...],
    holds: Callable[[Conditions], bool],
) -> Provisions:
    rows, files = [], []
    for name, capability in capabilities().items():
        if name not in requested:
            continue
        part = offers[name][0] if name in offers else ""
        provider = APPLICATION if name in own or capability.of_application else part
        rows.append(Provided(capability, provider, tuple(sorted(requested[name]))))
        if part:
            files += [(part, file.path) for file in offers[name][1].sources if holds(file.when)]
    return Provisions(tuple(rows), tuple(dict.fromkeys(files)))
