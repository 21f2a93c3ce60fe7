# SPDX-License-Identifier: Apache-2.0
"""Descriptions that the agent holds and that clients refer to by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace

from microros_gen.agent.representation.description import Description, Participant
from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.diagnostics import nearest
from microros_gen.records import dataclass

_LONGEST_COMPARED = 255
"""Longest name, in characters, for which a similar one is suggested: the time for that grows with the square."""


class UnknownReferenceError(Exception):
    """A client referred to a description that the agent does not have; the text is for people."""


@dataclass(frozen=True)
class References:
    """Named descriptions, by object kind and name, as read from files (`reference_file`)."""

    known: Mapping[tuple[int, str], Description] = field(default_factory=dict)

    def find(self, kind: int, name: str, domain: int) -> Description:
        """Return the description of `kind` with this `name`. Raises UnknownReferenceError if it does not exist.

        `domain` is that of the client's CREATE (0 to 232); a participant gets it.
        """
        found = self.known.get((kind, name))
        if found is None:
            raise UnknownReferenceError(self._explain(kind, name))
        return replace(found, domain=domain) if isinstance(found, Participant) else found

    def _explain(self, kind: int, name: str) -> str:
        if not self.known:
            return f"reference '{name}': the agent has no references; start it with --references FILE"
        names = [known for k, known in self.known if k == kind]
        what = ObjectKind(kind).name.lower()
        hint = nearest(name, names) if len(name) <= _LONGEST_COMPARED else None
        return f"unknown reference '{name}' among {len(names)} of kind {what}" + (f". {hint}" if hint else "")
