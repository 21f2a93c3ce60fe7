# SPDX-License-Identifier: Apache-2.0
"""The way back: a rule with `recover_if` holds until that part is well, then its system gets the target of before.

A rule with `diagnostics` also holds as long as these do.

The rules that led to the present target since the last request, or command of the system above, are a history. Only the
last one can be undone. Rules that lead back to a target of before leave the history as it was then.
"""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.modes.model import Reported, Rule, Status

History = tuple[Rule, ...]


def extended(history: History, rule: Rule) -> History:
    """Return the history after a rule was applied."""
    path = (*history, rule)
    return next((path[:i] for i, r in enumerate(path) if r.if_target.is_same(rule.new_target)), path)


def recovery_of(history: History, statuses: Mapping[str, Status], reported: Reported) -> Rule | None:
    """Return the rule that is undone while the parts of its system have these statuses, and report these."""
    return history[-1] if history and history[-1].recovers(statuses, reported) else None
