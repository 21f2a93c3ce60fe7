# SPDX-License-Identifier: Apache-2.0
"""What the resolver hands on: everything that is selected, each with the reasons why."""

from __future__ import annotations

from microros_gen.documents.named import Named
from microros_gen.records import dataclass
from microros_gen.selection.component import Component


@dataclass(frozen=True)
class Chosen:
    """A name (XRCE profile, submessage or object kind) and why it is there."""

    name: str
    reasons: tuple[str, ...]


@dataclass(frozen=True)
class ChosenComponent:
    """A component and why it is there, for example `profile pure_sender` or `needed by publish`.

    `causes` are the choices of the user at the end of those reasons (profiles, keys, declarations), with
    places.
    """

    component: Component
    reasons: tuple[str, ...]
    causes: tuple[Named, ...] = ()


@dataclass(frozen=True)
class ChosenAxis:
    """The value of an axis and who chose it."""

    axis: str
    value: str
    reason: str


@dataclass(frozen=True)
class Selection:
    """The resolved selection; every tuple is in a fixed order that does not depend on the input's order.

    `agent_profiles` are XRCE profiles that only the agent's side needs (file configuration).
    """

    profiles: tuple[str, ...]
    components: tuple[ChosenComponent, ...]
    entities: str
    transport: str
    liveliness: str
    xrce_profiles: tuple[Chosen, ...]
    agent_profiles: tuple[Chosen, ...]
    sends: tuple[Chosen, ...]
    receives: tuple[Chosen, ...]
    objects: tuple[Chosen, ...]
    axes: tuple[ChosenAxis, ...] = ()

    @property
    def name(self) -> str:
        """The profiles, joined by `+`; `application` where components alone were selected."""
        return "+".join(self.profiles) or "application"

    def has(self, component: str) -> bool:
        """Return whether `component` is selected."""
        return any(c.component.name == component for c in self.components)

    def serves_only(self, component: str, other: str) -> bool:
        """Return whether `component` is selected because `other` needs it, and for no other reason."""
        reasons = [c.reasons for c in self.components if c.component.name == component]
        return reasons == [(f"needed by {other}",)]
