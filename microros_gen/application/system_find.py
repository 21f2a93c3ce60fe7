# SPDX-License-Identifier: Apache-2.0
"""Reads the system file that an application names, and the applications of the boards that it is linked with."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path, PurePath

from microros_gen.application.find import APPLICATION_FILE
from microros_gen.application.kinds import other_end
from microros_gen.application.model import Application, Chip, ChipImage
from microros_gen.application.parser import parse_application
from microros_gen.application.system_can import bus_identifiers, can_ends, identifier
from microros_gen.application.system_decl import CanFrames, Link, LinkDecl, PeerEnd, SystemRef
from microros_gen.application.system_ends import check_other_ends, end_of, peer_ends
from microros_gen.application.system_file import SystemFile, parse_system
from microros_gen.diagnostics import Diagnostics, Source, Span, nearest
from microros_gen.documents.files import read_text, reason_of
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.derived import SERVICE_PARTS, derived_name
from microros_gen.interfaces.find import InterfaceFinder
from microros_gen.interfaces.types import Message, TypeName
from microros_gen.records import dataclass


def with_system(
    application: Application,
    config: Path | None,
    near: Path,
    diagnostics: Diagnostics,
    interface_paths: tuple[Path, ...] = (),
) -> tuple[Application, Mapping[str, Source]]:
    """Return the application with the links and the chip of its board, and the files that were read for them, by name.

    What the other applications say wrong is an error at its place there. `interface_paths` are those of this build.
    """
    reference = application.system
    if reference is None:
        return application, {}
    path = near / reference.file.name
    found = read_system(path, reference.file.span, diagnostics)
    if found is None:
        return application, {}
    system, source = found
    own = config or near / APPLICATION_FILE
    if not _is_board(system, reference, own, path, diagnostics):
        return application, {}
    files = {path.name: source}
    own_place = _Place(reference.board.name, system, path)
    _check_agent_id(own_place, application, diagnostics)
    links: list[Link] = []
    idle: list[Path] = []
    for link in system.links:
        for linked, other_source in _links(link, own_place, application, diagnostics):
            files[f"{linked.board}: {Path(other_source.name).name}"] = other_source
            if len(link.ends) == 2 or _exchanges(application, linked):
                links.append(linked)
            else:
                idle += linked.files
    check_other_ends(application, links, system, diagnostics)
    _check_pairs([link for link in links if _exchanges(application, link)], own_place.board, diagnostics)
    chip = _chip(own_place, interface_paths, files, diagnostics)
    return replace(application, links=tuple(links), bus_files=tuple(idle), chip=chip), files


@dataclass(frozen=True)
class _Place:
    """A board of a system, and the path of the system file."""

    board: str
    system: SystemFile
    path: Path


def read_system(path: Path, span: Span | None, diagnostics: Diagnostics) -> tuple[SystemFile, Source] | None:
    """Return the system of a file, and the file; None where `diagnostics` got errors. `span`: where it is named."""
    source = _read(path, "system file", span, diagnostics)
    system = parse_system(source, diagnostics) if source else None
    return None if source is None or system is None else (system, source)


def read_board(board: str, system: SystemFile, path: Path, diagnostics: Diagnostics) -> Application | None:
    """Return the application of a board of the system file `path`; None where it cannot be read.

    An application that does not name this system and its board is an error, too.
    """
    found = other_board(board, system, path, diagnostics)
    return None if found is None else found[0]


def system_paths(application: Application, near: Path) -> Iterator[Path]:
    """Yield the files that `with_system` reads."""
    if application.system is not None:
        yield near / application.system.file.name
    for link in application.links:
        yield from link.files
    yield from application.bus_files
    for image in application.chip.images if application.chip else ():
        yield from image.files


def exchanged(name: TypeName) -> tuple[TypeName, ...]:
    """Return the messages of a type: itself, or the request and the response of a service."""
    return tuple(derived_name(name, part) for part in SERVICE_PARTS) if name.kind == "srv" else (name,)


def client_key(application: Application) -> int | None:
    """Return the client key that an application declares; None where it has no agent, or the key is another one."""
    agent = bool(application.nodes) and has_agent(application)
    return application.session_key if agent and isinstance(application.session_key, int) else None


def _is_board(
    system: SystemFile, reference: SystemRef, own: Path, path: Path, diagnostics: Diagnostics
) -> bool:
    """Return whether the system has the board, with this application."""
    board = reference.board
    if board.name not in system.boards:
        hint = nearest(board.name, system.boards) or f"Available: {', '.join(sorted(system.boards))}"
        diagnostics.error(f"the system has no board '{board.name}'", board.span, hint, id="MG-3197")
        return False
    named = path.parent / system.boards[board.name].name
    if named.resolve() != own.resolve():
        other = os.path.normpath(named)
        message = f"the application of the board '{board.name}' is another file in the system: '{other}'"
        hint = "Name this application there, or another board here"
        diagnostics.error(message, board.span, hint, id="MG-3195")
        return False
    return True


def _exchanges(application: Application, link: Link) -> bool:
    """Return whether a board has an end of a topic or service of which the other board of a link has the other one."""
    wanted = {(other_end(end.kind), end.domain_id, end.topic) for _, _, end in peer_ends(application)}
    return any((end.kind, end.domain_id, end.topic) in wanted for end in link.ends)


def _links(
    link: LinkDecl, place: _Place, application: Application, diagnostics: Diagnostics
) -> Iterator[tuple[Link, Source]]:
    """Yield a link for each other board at the ends, and that board's application file."""
    boards = [board for board, _ in link.ends]
    if place.board not in boards:
        return
    own = boards.index(place.board)
    for other in (i for i in range(len(boards)) if i != own):
        linked = _link(link, (own, other), place, application, diagnostics)
        if linked is not None:
            yield linked


def _link(
    link: LinkDecl,
    pair: tuple[int, int],
    place: _Place,
    application: Application,
    diagnostics: Diagnostics,
) -> tuple[Link, Source] | None:
    """Return the link between the ends `pair`, of which the first is that of this board."""
    own, at = pair
    board = link.ends[at][0]
    found = other_board(board, place.system, place.path, diagnostics)
    if found is None:
        return None
    other, source, file = found
    ends = tuple(end for _, _, end in peer_ends(other))
    types = _types(other, ends, file.parent, diagnostics)
    linked = Link(
        kind=link.kind,
        board=board,
        position=int(own > at),
        own=_line(link, own),
        other=_line(link, at),
        mtu=link.mtu,
        history=link.history,
        baud=other.transport.baud,
        transport=other.transport.type,
        ends=tuple(replace(end, type_hash=types.hashes.get(end.type)) for end in ends),
        files=(file, *types.files),
        span=link.span,
        limits=other.limits,
        client_key=client_key(other),
        round_trip=other.times.round_trip,
        heartbeat=other.times.heartbeat,
        can=_frames(link, pair, other),
    )
    if linked.can is not None:
        _check_client_ids(application, other, linked, diagnostics)
    return linked, source


def _line(link: LinkDecl, at: int) -> Named:
    """Return the address of an end, or the name of its device."""
    place = link.ends[at][1]
    return Named(can_ends(link)[at].device, place.span) if link.kind == "canfd" else place


def _frames(link: LinkDecl, pair: tuple[int, int], other: Application) -> CanFrames | None:
    if link.kind != "canfd":
        return None
    own, at = (can_ends(link)[i] for i in pair)
    return CanFrames(identifier(link, own, at), identifier(link, at, own), other.transport.bitrate)


def has_agent(application: Application) -> bool:
    """Return whether anything of an application with nodes exists at an agent."""
    return not application.nodes or any(
        endpoint.exists_at_agent for node in application.nodes for endpoint in node.endpoints
    )


def _check_agent_id(place: _Place, application: Application, diagnostics: Diagnostics) -> None:
    """Report frames of a link with the identifier of those that a board exchanges with its agent on the same bus."""
    transport = application.transport
    if transport.can_id is None or not has_agent(application):
        return
    taken = bus_identifiers(place.system.links, place.board, transport.can_device)
    if transport.can_id in taken:
        message = (
            f"the identifier {transport.can_id:#x} is that of the frames from {taken[transport.can_id]}, too"
        )
        hint = "Write another `id` here, or at the link in the system file"
        diagnostics.error(message, application.spans.get("transport.id"), hint, id="MG-3251")


def _check_client_ids(
    application: Application, other: Application, link: Link, diagnostics: Diagnostics
) -> None:
    """Report two boards of a bus that an agent cannot tell apart."""
    own, its = application.transport, other.transport
    on_bus = (own.can_device, its.can_device) == (link.own.name, link.other.name)
    if not on_bus or own.can_id is None or own.can_id != its.can_id:
        return
    if has_agent(application) and has_agent(other):
        message = (
            f"the board '{link.board}' has the same identifier {own.can_id:#x} on the bus: both boards would read "
            "what the agent sends to one of them"
        )
        hint = "Give each board its own `transport: {id: N}`"
        diagnostics.error(message, application.spans.get("transport.id"), hint, id="MG-3252")


def other_board(
    board: str, system: SystemFile, path: Path, diagnostics: Diagnostics
) -> tuple[Application, Source, Path] | None:
    """Return the application of another board, its text, and its path; None where `diagnostics` got errors."""
    named = system.boards[board]
    file = path.parent / named.name
    source = _read(file, "application file", named.span, diagnostics)
    other = parse_application(source, diagnostics) if source else None
    if source is None or other is None:
        return None
    _check_names_system(other, board, named, file, path, diagnostics)
    return other, source, file


def _check_pairs(links: list[Link], board: str, diagnostics: Diagnostics) -> None:
    """Report a second link with a board: each message would arrive over both."""
    seen: dict[str, Link] = {}
    for link in links:
        first = seen.setdefault(link.board, link)
        if first is not link:
            where = f"; the first is in line {first.span.line}" if first.span else ""
            message = f"two links join '{board}' and '{link.board}'{where}: messages would arrive twice"
            diagnostics.error(message, link.span, "Remove one of them", id="MG-3253")


def _chip(
    place: _Place, interface_paths: tuple[Path, ...], files: dict[str, Source], diagnostics: Diagnostics
) -> Chip | None:
    """Return the chip that a board is an image of, with the others; their application files are added to `files`."""
    chip = next((chip for chip in place.system.chips if place.board in chip.names), None)
    if chip is None:
        return None
    places_all = len(chip.images) > 2
    images = []
    for position, name in enumerate(chip.names):
        found = None if name == place.board else other_board(name, place.system, place.path, diagnostics)
        if found is not None:
            other, source, file = found
            files[f"{name}: {Path(source.name).name}"] = source
            ends = tuple(end_of(node, e) for node in other.nodes for e in node.endpoints if e.local == "chip")
            types = _types(other, ends, file.parent, diagnostics, interface_paths if places_all else None)
            read = (file, *types.files)
            images.append(ChipImage(name, position, other, types.hashes, read, types.messages))
    return Chip(chip.names.index(place.board), tuple(images), chip.memory, chip.span)


def _check_names_system(
    other: Application, board: str, named: Named, file: Path, path: Path, diagnostics: Diagnostics
) -> None:
    """Report an application of the system that would be built without it, or as another board."""
    reference, span = other.system, named.span
    if reference is not None:
        span = reference.file.span
        if (file.parent / reference.file.name).resolve() == path.resolve():
            if reference.board.name == board:
                return
            span = reference.board.span
    own = PurePath(os.path.relpath(path.resolve(), file.parent.resolve())).as_posix()
    diagnostics.error(
        f"the application '{named.name}' does not name this system and its board '{board}'",
        span,
        f"Write `system: {{file: {own}, board: {board}}}` there",
        id="MG-3196",
    )


@dataclass(frozen=True)
class _Types:
    """What interface files define: hashes by name, messages (closed), and these files."""

    hashes: Mapping[str, str]
    messages: Mapping[TypeName, Message]
    files: tuple[Path, ...]


def _types(
    other: Application,
    ends: tuple[PeerEnd, ...],
    near: Path,
    diagnostics: Diagnostics,
    more_paths: tuple[Path, ...] | None = None,
) -> _Types:
    """Return the types of ends that interface files of the other application define.

    With `more_paths` all types of the ends: they are looked for there first, and where a build looks. The hash of a
    service is those of its request and its response.
    """
    paths = {near / path.name: path.span for path in other.interface_paths}
    if (not paths and more_paths is None) or not ends:
        return _Types({}, {}, ())
    finder = InterfaceFinder.from_environment((*(more_paths or ()), *paths))
    finder.check_paths(diagnostics, paths)
    spans: dict[str, Span | None] = {}
    for end in ends:
        spans.setdefault(end.type, end.span)
    wanted = tuple(Named(name, span) for name, span in spans.items())
    interfaces = resolve_interfaces(wanted, finder, diagnostics)
    if diagnostics.has_errors():
        return _Types({}, {}, ())
    hashes = {
        str(name): " ".join(interfaces.type_hash(message) for message in exchanged(name))
        for name in interfaces.roots
    }
    hashes |= {str(part): interfaces.type_hash(part) for name in interfaces.roots for part in exchanged(name)}
    return _Types(hashes, interfaces.messages, tuple(Path(entry.source.name) for entry in interfaces))


def _read(path: Path, what: str, span: Span | None, diagnostics: Diagnostics) -> Source | None:
    shown = os.path.normpath(path)
    try:
        return Source(shown, read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        message = f"cannot read the {what} '{shown}': {reason_of(error)}"
        hint = "Its path is relative to the folder of the file that names it" if span else None
        diagnostics.error(message, span, hint, id="MG-3190")
        return None
