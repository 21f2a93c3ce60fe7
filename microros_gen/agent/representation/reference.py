# SPDX-License-Identifier: Apache-2.0
"""Descriptions that the agent holds, and clients name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from microros_gen.agent.representation.description import Description


class UnknownReferenceError(Exception):
    """A client named a description that the agent does not hold; the text is for people."""


@dataclass(frozen=True)
class References:
    """Named descriptions, by object kind and name; empty unless a configuration gives some."""

    known: Mapping[tuple[int, str], Description] = field(default_factory=dict)

    def find(self, kind: int, name: str, domain: int) -> Description:
        """Return what `name` stands for among objects of `kind`; UnknownReferenceError when there is nothing.

        `domain` is what the client's CREATE says beside the name; a participant takes it from there.
        """
        found = self.known.get((kind, name))
        if found is None:
            raise UnknownReferenceError(f"reference '{name}' is not known to this agent")
        return found
