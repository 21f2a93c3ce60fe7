# SPDX-License-Identifier: Apache-2.0
"""What the resolver hands on: everything that is selected, each with the reasons why."""

from __future__ import annotations

from dataclasses import dataclass

from microros_gen.model.component import Component


@dataclass(frozen=True)
class Chosen:
    """A name (XRCE profile, submessage or object kind) and why it is there."""

    name: str
    reasons: tuple[str, ...]


@dataclass(frozen=True)
class ChosenComponent:
    """A component and why it is there, for example `profile pure_sender` or `needed by publish`."""

    component: Component
    reasons: tuple[str, ...]


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

    def has(self, component: str) -> bool:
        """Return whether `component` is selected."""
        return any(c.component.name == component for c in self.components)
