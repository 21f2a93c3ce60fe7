# SPDX-License-Identifier: Apache-2.0
"""Modes that devices change to by themselves: the manager does not work against them."""

from __future__ import annotations

from microros_gen.mode_manager.calls import Link
from microros_gen.mode_manager.leaf import Leaf
from microros_gen.mode_manager.settings import Settings
from microros_gen.modes.model import ACTIVE, Status


def note_reaction(leaf: Leaf, before: Status, after: Status, was_settled: bool) -> str:
    """Note that a node left its target for a mode that nobody commanded, and return what to log; empty: it did not.

    It has declared the mode as a contingency, or reports an error. What it is commanded to be for the first time is
    not reached yet, and so is not left.
    """
    if leaf.link is not Link.MODES or leaf.is_settled(after) or after.state != ACTIVE or not after.mode:
        return ""
    is_reaction = after.mode in leaf.part.contingencies or leaf.has_new_problem
    is_new = after != before or not leaf.failure
    if not (is_reaction and is_new and (leaf.has_reached or was_settled or leaf.reaction)):
        return ""
    leaf.reaction, leaf.failure = after.mode, f"it went to {after} by itself"
    leaf.deviates, leaf.attempts, leaf.restores, leaf.wait_until = False, 0, False, 0.0
    return leaf.failure


def await_reaction(leaf: Leaf, after: Status, now: float, settings: Settings) -> None:
    """Let a node that may be reconfiguring itself arrive in a mode before anything is commanded."""
    if (
        leaf.link is Link.MODES
        and after.state != ACTIVE
        and (leaf.part.contingencies or leaf.has_new_problem)
    ):
        leaf.stale |= leaf.queries
        leaf.wait_until = now + settings.grace_s
