# SPDX-License-Identifier: Apache-2.0
"""The lines of an application file that make another application of it, to be pasted."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from microros_gen.application.model import Application, EndpointDecl
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.unset import type_line


@dataclass(frozen=True)
class ChangedLine:
    """A line of the application file; `place` says where it goes, empty: anywhere at the top level."""

    line: str
    place: str

    def text(self, remark: str) -> str:
        """Return the line with its place and a remark as a comment."""
        return f"{self.line}  # {self.place}{', ' if self.place else ''}{remark}"


def changed_lines(before: Application, after: Application) -> Iterator[ChangedLine]:
    """Yield the lines that differ: pools, limits, and the queues of endpoints."""
    if after.pools != before.pools:
        span = before.spans.get("pools")
        pools = ", ".join(f"{key}: {value}" for key, value in after.pools.items())
        yield ChangedLine(f"pools: {{{pools}}}", f"instead of `pools:` in line {span.line}" if span else "")
    yield from _limits(before, after)
    for node_before, node_after in zip(before.nodes, after.nodes, strict=True):
        for old, new in zip(node_before.endpoints, node_after.endpoints, strict=True):
            yield from _queues(old, new)


def joined(lines: Iterable[ChangedLine]) -> ChangedLine:
    """Return several lines that belong together as one text, at the place of the last."""
    found = tuple(lines)
    return ChangedLine("\n".join(line.line for line in found), found[-1].place)


def _limits(before: Application, after: Application) -> Iterator[ChangedLine]:
    types = {rule.path[0] for rule in after.limits if rule not in before.limits}
    below = "below `limits:`" if before.limits else ""
    if types and not before.limits:
        yield ChangedLine("limits:", "")
    for name in sorted(types):
        line, instead = type_line(name, before.limits, after.limits)
        yield ChangedLine(line, instead or below)


def _queues(old: EndpointDecl, new: EndpointDecl) -> Iterator[ChangedLine]:
    at = f"at the {old.kind} {old.declared_as or old.topic}{f', line {old.span.line}' if old.span else ''}"
    for key, known, value in (
        ("queue", old.queue, new.queue),
        ("queue_bytes", old.queue_bytes, new.queue_bytes),
    ):
        if known != value:
            yield ChangedLine(
                f"{key}: {value}", f"{at}, instead of `{key}: {known}`" if known is not None else at
            )
