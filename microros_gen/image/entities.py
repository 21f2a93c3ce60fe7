# SPDX-License-Identifier: Apache-2.0
"""Static memory by what it is for: entities, streams and their slots, session; and what each entity takes."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from microros_gen.application.kinds import KINDS, RECEIVING, EntityKind
from microros_gen.image.attribution import Chunk
from microros_gen.image.dwarf import Facts
from microros_gen.image.folder import Folder
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.own_limits import without_topic

MESSAGE_STORAGE = "storage of messages sent"
_SOURCES = {"error_state": "error text", "message_pools": MESSAGE_STORAGE}
INPUT_BUFFER = "input buffer"
SHARED_STREAMS = ("reliable stream", "best-effort stream", "input stream", INPUT_BUFFER)


@dataclass(frozen=True)
class RamPart:
    """Static memory. `use` says what for: `publisher 0`, `reliable stream, slot 2`, `session`, `alignment`."""

    symbol: str
    path: str
    size: int
    group: str
    owner: str
    use: str


@dataclass(frozen=True)
class Share:
    """What an entity uses together with others: how many bytes, and how many entities use them."""

    what: str
    bytes: int
    users: int


@dataclass(frozen=True)
class Entity:
    """A node or an endpoint. `ram`: its own places in the library; `flash`: of its type's support, used by
    `type_users` entities; `message`: messages of its type (with their storage) that the application keeps.
    """

    kind: str
    name: str
    type: str | None
    ram: int
    flash: int
    type_users: int
    message: int
    shares: tuple[Share, ...]


_CONSTANTS = ".rodata"
"""How sections of constants begin."""
_INDEXED = (
    (re.compile(r"(?:^|\.)(?:participants|nodes)\[(\d+)\]"), "node"),
    (re.compile(r"(?:^|\.)(?:publishers|topics)\[(\d+)\]"), "publisher"),
    (re.compile(r"(?:^|\.)subscriptions\[(\d+)\]"), "subscription"),
    (re.compile(r"(?:^|\.)(?:clients|requesters)\[(\d+)\]"), "client"),
)
_RECEIVERS = re.compile(r"(?:^|\.)receivers\[(\d+)\]")
_SERVICES = re.compile(r"(?:^|\.)services\[(\d+)\]")
_ENDPOINTS = re.compile(r"(?:^|\.)endpoints\[(\d+)\]")
_STATES = re.compile(r"(?:^|\.)states\[(\d+)\]")
_CLIENT = "xrce_client_t"
_MEMBERS = {
    "reliable": "reliable stream",
    "reliable_input": "input stream",
    "latest": INPUT_BUFFER,
    "requests": "requests under way",
}


def ram_parts(folder: Folder, chunks: Iterable[Chunk], facts: Facts) -> tuple[RamPart, ...]:
    """Split all static memory; the sizes add up to data and bss."""
    return tuple(part for chunk in chunks if chunk.ram for part in _of_chunk(folder, chunk, facts))


def entities(folder: Folder, chunks: Iterable[Chunk], parts: Iterable[RamPart]) -> tuple[Entity, ...]:
    """Return nodes and publishers with what they take; the places of pools where nothing is declared."""
    by_use: dict[str, int] = {}
    for part in parts:
        by_use[part.use] = by_use.get(part.use, 0) + part.size
    flash: dict[str, int] = {}
    for chunk in chunks:
        if chunk.owner.group == "type support":
            flash[chunk.owner.name] = flash.get(chunk.owner.name, 0) + chunk.flash
    return (
        *_nodes(folder.manifest, by_use),
        *_publishers(folder.manifest, by_use, flash),
        *(e for kind in RECEIVING for e in _receivers(folder.manifest, kind, by_use, flash)),
    )


def library_ram(parts: Iterable[RamPart]) -> int:
    """Return the static memory of the library itself: what `memory.ram_budget` bounds."""
    return sum(p.size for p in parts if p.group in ("component", "type support"))


def _of_chunk(folder: Folder, chunk: Chunk, facts: Facts) -> Iterator[RamPart]:
    symbol, group, owner = chunk.symbol or chunk.input or chunk.section, chunk.owner.group, chunk.owner.name
    kind = facts.types.get(chunk.address, "")
    found = facts.parts.get(chunk.address, ()) if chunk.symbol else ()
    if group == "application" and chunk.symbol:
        yield RamPart(symbol, "", chunk.size, group, owner, _of_application(folder, kind))
        return
    used = 0
    for part in found:
        if part.size and part.offset >= used and part.offset + part.size <= chunk.size:
            if part.offset > used:
                yield RamPart(symbol, "", part.offset - used, group, owner, "alignment")
            use = _use(folder.manifest, chunk, kind, part.path)
            yield RamPart(symbol, part.path, part.size, group, owner, use)
            used = part.offset + part.size
    if used < chunk.size:
        rest = _use(folder.manifest, chunk, kind, "") if not used else "alignment"
        yield RamPart(symbol, "", chunk.size - used, group, owner, rest)


def _use(manifest: Mapping[str, Any], chunk: Chunk, kind: str, path: str) -> str:
    symbol = (chunk.symbol or "").split(".")[0]
    own = _own_use(manifest, chunk.owner.name, symbol, kind, path)
    if own:
        return own
    for text in (path, f"{symbol}{path}"):
        for pattern, name in _INDEXED:
            match = pattern.search(text)
            if match:
                return f"{name} {match[1]}"
        match = _STATES.search(text)
        if match:
            place, nodes = int(match[1]), int(manifest["pools"]["nodes"])
            return f"node {place}" if place < nodes else _endpoint(manifest, place - nodes)
        for pattern, name in (
            (_RECEIVERS, "subscription"),
            (_SERVICES, "service"),
            (_ENDPOINTS, "publisher"),
        ):
            match = pattern.search(text)
            if match:
                return _endpoint(manifest, int(match[1]), name)
    if kind == _CLIENT or (chunk.owner.name == "support" and path.startswith(".session")):
        member = path.removeprefix(".").partition(".")[0].partition("[")[0]
        return _MEMBERS.get(member, member.replace("_", " ") or "client")
    if chunk.owner.group == "component":
        return _SOURCES.get((chunk.source or "").rpartition("/")[2][:-2], chunk.owner.name)
    return chunk.owner.name if chunk.owner.group == "start-up" else chunk.owner.group


def _own_use(manifest: Mapping[str, Any], owner: str, symbol: str, kind: str, path: str) -> str:
    """Return what a component says that its variable, or its member of the client, is for; empty: none says it."""
    is_client = kind == _CLIENT
    for component, feature in manifest.get("features", {}).items():
        text = path.removeprefix(".") if is_client else f"{symbol}{path}" if owner == component else ""
        # A part of a variable has a longer name than the variable.
        for variable, use in sorted(feature.get("size", {}).items(), key=lambda item: -len(item[0])):
            match = re.match(_pattern(variable), text)
            if match:
                return str(use).replace("{}", match[1]) if match.groups() else str(use)
    return ""


def _pattern(variable: str) -> str:
    """Return the expression for a name: `x[]` is each element, `x*` each name that begins so, up to `__`."""
    name = re.escape(variable.removesuffix("[]").removesuffix("*"))
    if variable.endswith("*"):
        return rf"{name}(\w+?)(?:__\w*)?(?!\w)"
    return rf"{name}\[(\d+)\](?!\w)" if variable.endswith("[]") else rf"{name}(?!\w)"


def constant_uses(folder: Folder, chunks: Iterable[Chunk]) -> dict[tuple[str, str], tuple[int, int]]:
    """Return the bytes of constants in flash and in RAM by component and by what it says that they are for.

    They take RAM as well where the processor cannot read data in its flash (AVR).
    """
    found: dict[tuple[str, str], tuple[int, int]] = {}
    for chunk in chunks:
        is_constant = not chunk.ram or chunk.input.startswith(_CONSTANTS)
        if chunk.owner.group == "component" and chunk.flash and is_constant and chunk.symbol:
            owner, symbol = chunk.owner.name, chunk.symbol.split(".")[0]
            use = "" if chunk.function else _own_use(folder.manifest, owner, symbol, "", "")
            if use:
                flash, ram = found.get((owner, use), (0, 0))
                found[owner, use] = flash + chunk.flash, ram + chunk.ram
    return found


def _endpoint(manifest: Mapping[str, Any], index: int, first: str = "publisher") -> str:
    """Return whose place this is, in a table that begins with those of `first`."""
    pools = manifest["pools"]
    counts = {kind.name: int(pools.get(kind.key, 0)) for kind in KINDS}
    counts[KINDS[0].name] += 0 if any(counts.values()) else 1
    kinds = list(counts)
    for kind in kinds[kinds.index(first) :]:
        if index < counts[kind]:
            return f"{kind} {index}"
        index -= counts[kind]
    return "client"


def _of_application(folder: Folder, kind: str) -> str:
    name = without_topic(kind.removesuffix("__Storage").removesuffix("__Sequence"))
    return f"message of {folder.c_types[name]}" if name in folder.c_types else "application"


def _nodes(manifest: Mapping[str, Any], by_use: Mapping[str, int]) -> Iterator[Entity]:
    declared = manifest["entities"]["nodes"]
    for index in range(int(manifest["pools"]["nodes"])):
        node = declared[index] if index < len(declared) else None
        name = f"{node['namespace'].rstrip('/')}/{node['name']}" if node else f"node {index} of the pool"
        yield Entity("node", name, None, by_use.get(f"node {index}", 0), 0, 0, 0, ())


def _publishers(
    manifest: Mapping[str, Any], by_use: Mapping[str, int], flash: Mapping[str, int]
) -> Iterator[Entity]:
    declared = manifest["entities"]["publishers"]
    count = int(manifest["pools"]["publishers"])
    users = {reliable: sum(1 for p in declared if p["reliable"] == reliable) for reliable in (True, False)}
    for index in range(count):
        known = declared[index] if index < len(declared) else None
        kinds = {known["type"]} if known else set(manifest["types"])
        parts = {part for kind in kinds for part in manifest["types"][kind]["parts"]} | kinds
        reliable = (known["reliable"],) if known else (True, False)
        shares = tuple(
            Share(what, size, users[is_reliable] if known else count)
            for is_reliable in reliable
            for what, size in [_stream(by_use, is_reliable)]
            if size
        )
        yield Entity(
            "publisher",
            known["topic"] if known else f"publisher {index} of the pool",
            known["type"] if known else None,
            by_use.get(f"publisher {index}", 0),
            sum(flash.get(part, 0) for part in parts),
            sum(1 for p in declared if p["type"] == known["type"]) if known else count,
            sum(by_use.get(f"message of {kind}", 0) for kind in kinds),
            shares,
        )


def _receivers(
    manifest: Mapping[str, Any], kind: EntityKind, by_use: Mapping[str, int], flash: Mapping[str, int]
) -> Iterator[Entity]:
    """Yield what receives, of one kind; the bytes of its queue are its own, unless it waits in the input buffer."""
    declared = manifest["entities"].get(kind.key, [])
    count = int(manifest["pools"].get(kind.key, 0))
    places = sum(int(manifest["pools"].get(other.key, 0)) for other in RECEIVING)
    for index in range(count):
        known = declared[index] if index < len(declared) else None
        kinds = messages_of(known["type"], manifest) if known else set(manifest["types"])
        parts = with_parts(kinds, manifest)
        in_input_buffer = known is not None and known.get("slot") == INPUT_BUFFER
        queue = _queue_size(known) if known else by_use.get("queues", 0) // places
        yield Entity(
            kind.name,
            shown_endpoint(known) if known else f"{kind.name} {index} of the pool",
            known["type"] if known else None,
            by_use.get(f"{kind.name} {index}", 0) + (0 if in_input_buffer else queue),
            sum(flash.get(part, 0) for part in parts),
            sum(1 for other in declared if other["type"] == known["type"]) if known else count,
            sum(by_use.get(f"message of {name}", 0) for name in kinds),
            (Share(INPUT_BUFFER, by_use.get(INPUT_BUFFER, 0), places),) if in_input_buffer else (),
        )


def _queue_size(known: Mapping[str, Any]) -> int:
    """Return the bytes of a declared endpoint's queue."""
    return int(known.get("queue_bytes", known["queue"] * known["slot_size"]))


def messages_of(type_: str, manifest: Mapping[str, Any]) -> set[str]:
    """Return the messages of a type: itself, or what a service exchanges."""
    return {name for name in (type_, f"{type_}_Request", f"{type_}_Response") if name in manifest["types"]}


def with_parts(names: set[str], manifest: Mapping[str, Any]) -> set[str]:
    """Return messages with all that they are made of."""
    return names | {part for name in names for part in manifest["types"][name]["parts"]}


def shown_endpoint(entity: Mapping[str, Any]) -> str:
    """Return the topic of an entity of the manifest, or the name of its service."""
    return str(entity.get("topic") or entity["name"])


def _stream(by_use: Mapping[str, int], reliable: bool) -> tuple[str, int]:
    name = "reliable stream" if reliable else "best-effort stream"
    return name, sum(size for use, size in by_use.items() if use == name or use.startswith(f"{name},"))
