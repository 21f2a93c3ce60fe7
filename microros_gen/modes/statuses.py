# SPDX-License-Identifier: Apache-2.0
"""`state[.MODE]` in a model file or a script → Status, or a diagnostic at its place."""

from __future__ import annotations

import re
from collections.abc import Collection
from difflib import get_close_matches

from microros_gen.diagnostics import Diagnostics, Span, nearest
from microros_gen.documents.tree_values import text_of
from microros_gen.documents.yaml_tree import YamlNode
from microros_gen.modes.model import ACTIVE, DEFAULT, INACTIVE, STATES, UNCONFIGURED, Status
from microros_gen.records import dataclass

_BEFORE_MODE = re.compile(r"[^\w.]+")
"""Other characters than the dot between `active` and a mode."""


@dataclass(frozen=True)
class Subject:
    """The part that a status is of: its name, whether it is a system, and its modes."""

    name: str
    is_system: bool
    modes: Collection[str]

    @property
    def commanded(self) -> tuple[str, ...]:
        """Return the states that the part can be commanded to be in."""
        return (ACTIVE, INACTIVE) if self.is_system else (ACTIVE, INACTIVE, UNCONFIGURED)


def parse_target(node: YamlNode, part: Subject, diagnostics: Diagnostics) -> Status | None:
    """Return a status that `part` can be commanded to be in; `active` alone means its mode `__DEFAULT__`."""
    status = parse_status(node, part, diagnostics)
    if status is None or status.state in part.commanded:
        return status
    kind = "system" if part.is_system else "node"
    message = f"a {kind} cannot be commanded to be {status.state}"
    diagnostics.error(message, node.span, f"Use {', '.join(part.commanded)}", id="MG-8815")
    return None


def parse_status(node: YamlNode, part: Subject, diagnostics: Diagnostics) -> Status | None:
    """Return a status that `part` can be in; `active` alone means its mode `__DEFAULT__`."""
    text = text_of(node)
    if text is None:
        hint = "Write a state such as inactive, or active.MODE"
        diagnostics.error("a state must be a text", node.span, hint, id="MG-8818")
        return None
    state, dot, mode = text.partition(".")
    if state not in STATES:
        hint = _meant(text, part) or nearest(state, STATES) or f"Known: {', '.join(STATES)}"
        diagnostics.error(f"unknown state '{state}'", node.span, hint, id="MG-8814")
        return None
    if dot and state != ACTIVE:
        message = f"the state {state} has no modes, and '{text}' names one"
        diagnostics.error(message, node.span, f"Write {state}, or active.{mode}", id="MG-8816")
        return None
    if state != ACTIVE:
        return Status(state)
    mode = mode if dot else DEFAULT
    return Status(ACTIVE, mode) if _is_known(mode, node.span, part, diagnostics) else None


def _meant(text: str, part: Subject) -> str | None:
    """Return a hint for a mode without its state, or with another character than a dot before it."""
    *before, mode = _BEFORE_MODE.split(text)
    is_active = not before or get_close_matches(" ".join(before), STATES, n=1) == [ACTIVE]
    return f"Write {ACTIVE}.{mode}" if mode in part.modes and is_active else None


def _is_known(mode: str, span: Span, part: Subject, diagnostics: Diagnostics) -> bool:
    if mode in part.modes or not part.modes or (mode == DEFAULT and DEFAULT not in part.modes):
        return True  # a part without modes, or without __DEFAULT__, is reported where it is declared
    hint = nearest(mode, part.modes) or f"Known: {', '.join(part.modes)}"
    diagnostics.error(f"unknown mode '{mode}' of '{part.name}'", span, hint, id="MG-8817")
    return False
