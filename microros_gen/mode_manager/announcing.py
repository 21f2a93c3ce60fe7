# SPDX-License-Identifier: Apache-2.0
"""What is published of requests and of changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from microros_gen.mode_manager.calls import Announcement, Link, Topic
from microros_gen.mode_manager.leaf import Leaf
from microros_gen.modes.model import ACTIVE, Status


def announce_request(name: str, actual: Status, goal: Status) -> Iterator[Announcement]:
    """Yield what announces that a part, which is `actual`, is commanded to be `goal`."""
    if actual.state != goal.state:
        yield Announcement(Topic.TRANSITION_REQUEST, name, actual, goal)
    if goal.state == ACTIVE and not actual.is_same(goal):
        yield Announcement(Topic.MODE_REQUEST, name, actual, goal)


def announce_change(name: str, leaf: Leaf | None, before: Status, after: Status) -> Iterator[Announcement]:
    """Yield the events of a part, as far as it does not publish them itself; `leaf` None: it is a system."""
    if leaf is None and before.state != after.state:
        yield Announcement(Topic.TRANSITION_EVENT, name, before, after)
    has_no_events = leaf is None or leaf.link in (Link.PARAMETERS, Link.PLAIN)
    if has_no_events and after.state == ACTIVE and before != after:
        yield Announcement(Topic.MODE_EVENT, name, before, after)


def changes(
    leaves: Mapping[str, Leaf], before: Mapping[str, Status], after: Mapping[str, Status]
) -> Iterator[Announcement]:
    """Yield the events of all parts of `after`."""
    for name, status in after.items():
        yield from announce_change(name, leaves.get(name), before[name], status)
