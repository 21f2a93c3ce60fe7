# SPDX-License-Identifier: Apache-2.0
"""Prints a proposed application file: YAML with comments that say what is for, and what could not be decided."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from textwrap import wrap

from microros_gen.application.kinds import KIND, KINDS
from microros_gen.diagnostics import Span
from microros_gen.migrate.draft import (
    Draft,
    DraftAction,
    DraftClient,
    DraftEndpoint,
    DraftNode,
    DraftTimer,
    DraftValue,
    Flow,
    Remark,
    Setting,
    place,
)

UNDECIDED = "UNDECIDED"
"""The word that marks what somebody must decide."""

TARGET = "target"
_WIDTH = 110
_PLAIN = re.compile(r"[A-Za-z_/][A-Za-z0-9_./-]*")
_NOT_TEXT = ("true", "false", "null")
_KINDS = {kind.name: kind.key for kind in KINDS}
_GROUPS = {
    "transport": "How it reaches its agent.",
    "session": "Its session with the agent.",
    "pools": "How many of each there can be, and how large its streams are.",
    "memory": "Memory, and what it may take at most: more refuses the build.",
}
_UNITS = (("s", 1_000_000_000), ("ms", 1_000_000), ("us", 1_000))


def draft_text(draft: Draft, heading: Iterable[str]) -> str:
    """Return the application file; `heading` are lines of its first comment, without the `#`."""
    lines = [f"# {line}".rstrip() for line in heading]
    lines += [*_remarks(draft.remarks), "version: 1"]
    sections = (_selection, _interfaces, _groups, _target, _nodes, _limits, _settings, _suggestions)
    for section in sections:
        block = list(section(draft))
        lines += ["", *block] if block else []
    return "\n".join([*lines, ""])


def _remarks(remarks: Iterable[Remark]) -> Iterator[str]:
    found = sorted(remarks, key=lambda r: not r.undecided)
    for undecided, title in (
        (True, f"{UNDECIDED}: to be decided by you."),
        (False, "Read, and not needed here:"),
    ):
        chosen = [remark for remark in found if remark.undecided is undecided]
        if chosen:
            yield "#"
            yield f"# {title}"
        for remark in chosen:
            yield from _comment(
                f"- {place(remark.span)}: {remark.text}" if remark.span else f"- {remark.text}", "# "
            )


def _comment(text: str, lead: str) -> Iterator[str]:
    first, *more = wrap(text, _WIDTH - len(lead), break_on_hyphens=False, break_long_words=False)
    yield lead + first
    yield from (f"{lead}  {line}" for line in more)


def _selection(draft: Draft) -> Iterator[str]:
    yield "# What it does (`microros-gen profiles`), and components on top of that (`microros-gen resolve`)."
    if draft.profiles:
        yield f"profiles: [{', '.join(draft.profiles)}]"
    if draft.components:
        yield f"components: [{', '.join(draft.components)}]"


def _interfaces(draft: Draft) -> Iterator[str]:
    if draft.interfaces:
        yield "# Its message, service and action types."
        yield f"interfaces: [{', '.join(draft.interfaces)}]"


def _groups(draft: Draft) -> Iterator[str]:
    for index, (name, values) in enumerate(draft.groups.items()):
        if index:
            yield ""
        if name in _GROUPS:
            yield f"# {_GROUPS[name]}"
        yield from _group(name, values)


def _group(name: str, values: Mapping[str, DraftValue]) -> Iterator[str]:
    if any(value.note for value in values.values()):
        yield f"{name}:"
        for key, value in values.items():
            yield f"  {_line(key, value)}"
    else:
        inside = ", ".join(f"{key}: {_scalar(value.value)}" for key, value in values.items())
        yield f"{name}: {{{inside}}}"


def _target(draft: Draft) -> Iterator[str]:
    if TARGET in draft.settings:
        yield _line(TARGET, draft.settings[TARGET])


def _settings(draft: Draft) -> Iterator[str]:
    yield from (_line(key, value) for key, value in draft.settings.items() if key != TARGET)


def _suggestions(draft: Draft) -> Iterator[str]:
    yield from (f"# {line}" for line in draft.suggestions)


def _line(key: str, value: DraftValue) -> str:
    return f"{key}: {_scalar(value.value)}{_note(value.note)}"


def _nodes(draft: Draft) -> Iterator[str]:
    if not draft.nodes:
        return
    yield "# Everything that it creates; the library has room for this and for nothing else."
    known = any(node.name for node in draft.nodes)
    yield "nodes:" if known else "# nodes:"
    for node in draft.nodes:
        lines = list(_node(node))
        yield from (lines if node.name else (f"# {line}" for line in lines))


def _node(node: DraftNode) -> Iterator[str]:
    yield from _undecided(node.remarks, "  ")
    yield f"  - name: {_scalar(node.name or '?')}{_note(place(node.span))}"
    if node.namespace not in ("", "/"):
        yield f"    namespace: {_scalar(node.namespace)}"
    if node.domain_id:
        yield f"    domain_id: {node.domain_id}"
    for kind, key in _KINDS.items():
        endpoints = [endpoint for endpoint in node.endpoints if endpoint.kind == kind]
        yield from _list(key, [(_endpoint(e), bool(e.name and e.type), e.span, e.remarks) for e in endpoints])
    timers = [(_timer(t), t.period_ns is not None, t.span, t.remarks) for t in node.timers]
    yield from _list("timers", timers)
    for key, is_client in (("actions", False), ("action_clients", True)):
        found = [action for action in node.actions if action.is_client == is_client]
        yield from _list(key, [(_action(a), bool(a.name and a.type), a.span, a.remarks) for a in found])
    clients = [(_client(c), bool(c.node), c.span, c.remarks) for c in node.clients]
    yield from _list("parameter_clients", clients)
    if node.at_agent:
        yield "    parameters: {at: agent}"
    elif node.may_be_at_agent:
        yield "    # A parameter server can hold them, also while the board is away (Let the agent hold parameters)."
        yield "    # parameters: {at: agent}"


def _list(key: str, entries: list[tuple[str, bool, Span | None, tuple[Remark, ...]]]) -> Iterator[str]:
    if entries:
        yield f"    {key}:" if any(known for _, known, _, _ in entries) else f"    # {key}:"
    for text, known, span, remarks in entries:
        yield from _undecided(remarks, "      ")
        yield f"      {'- ' if known else '# - '}{text}{_note(place(span))}"


def _undecided(remarks: Iterable[Remark], indent: str) -> Iterator[str]:
    for remark in remarks:
        word = UNDECIDED if remark.undecided else "Note"
        where = f"{place(remark.span)}: " if remark.span else ""
        yield from _comment(f"{word} {where}{remark.text}", f"{indent}# ")


def _endpoint(endpoint: DraftEndpoint) -> str:
    parts = [
        f"{KIND[endpoint.kind].name_key}: {_scalar(endpoint.name or '?')}",
        f"type: {_scalar(endpoint.type or '?')}",
    ]
    if endpoint.qos.settings:
        inside = ", ".join(f"{k}: {_scalar(v)}" for k, v in endpoint.qos.settings.items())
        parts.append(f"qos: {{{inside}}}")
    return "{" + ", ".join(parts) + "}"


def _timer(timer: DraftTimer) -> str:
    period = "?" if timer.period_ns is None else period_text(timer.period_ns)
    return f"{{name: {_scalar(timer.name)}, period: {period}}}"


def _action(action: DraftAction) -> str:
    goals = f", goals: {action.goals}" if action.goals != 1 else ""
    return f"{{name: {_scalar(action.name or '?')}, type: {_scalar(action.type or '?')}{goals}}}"


def _client(client: DraftClient) -> str:
    if not client.settings:
        return _scalar(client.node)
    inside = "".join(f", {key}: {_scalar(value)}" for key, value in client.settings.items())
    return f"{{node: {_scalar(client.node or '?')}{inside}}}"


def period_text(nanoseconds: int) -> str:
    """Return a time as the application file has it: whole microseconds, at least one."""
    for unit, size in _UNITS:
        if nanoseconds and nanoseconds % size == 0:
            return f"{nanoseconds // size} {unit}"
    return f"{max(1, nanoseconds // 1000)} us"


def _limits(draft: Draft) -> Iterator[str]:
    if draft.limits:
        yield "# Most that strings (bytes, without their end) and sequences (elements) hold."
        yield "limits:"
        yield from (f"  {_line(_scalar(path), value)}" for path, value in draft.limits.items())


def _note(note: str) -> str:
    return f" # {note}" if note else ""


def _scalar(value: Setting) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, Flow)):
        return str(value)
    plain = _PLAIN.fullmatch(value) and value.lower() not in _NOT_TEXT
    return value if plain else json.dumps(value, ensure_ascii=False)
