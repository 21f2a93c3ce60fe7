# SPDX-License-Identifier: Apache-2.0
"""Descriptions that the agent holds, and clients name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace

from microros_gen.agent.representation.description import Description, Participant
from microros_gen.agent.wire.constants import ObjectKind
from microros_gen.diagnostics import nearest
from microros_gen.records import dataclass

_LONGEST_COMPARED = 255
"""Characters of a name for which a similar one is looked for; the time for that grows with its square."""


class UnknownReferenceError(Exception):
    """A client named a description that the agent does not hold; the text is for people."""


@dataclass(frozen=True)
class References:
    """Named descriptions, by object kind and name; empty unless files give some (`reference_file`)."""

    known: Mapping[tuple[int, str], Description] = field(default_factory=dict)

    def find(self, kind: int, name: str, domain: int) -> Description:
        """Return the object of `kind` with this `name`; raise UnknownReferenceError if none has it.

        `domain` is what the client's CREATE says besides the name; a participant takes it from there.
        """
        found = self.known.get((kind, name))
        if found is None:
            raise UnknownReferenceError(self._explain(kind, name))
        return replace(found, domain=domain) if isinstance(found, Participant) else found

    def _explain(self, kind: int, name: str) -> str:
        if not self.known:
            return f"reference '{name}': this agent has none; start it with --references FILE"
        names = [known for k, known in self.known if k == kind]
        what = ObjectKind(kind).name.lower()
        hint = nearest(name, names) if len(name) <= _LONGEST_COMPARED else None
        return f"reference '{name}' is none of the {len(names)} of kind {what}" + (
            f". {hint}" if hint else ""
        )
