# SPDX-License-Identifier: Apache-2.0
"""What the other boards of a CAN bus send to each other and to their agents: it takes time of the same bus."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import permutations
from pathlib import Path

from microros_gen.application.kinds import TOPIC_KINDS
from microros_gen.application.model import Application
from microros_gen.application.system_can import CANFD_LINK_MTU, bus_boards, bus_links, can_ends
from microros_gen.application.system_decl import BusSender, PeerEnd
from microros_gen.application.system_ends import end_of, peer_ends
from microros_gen.application.system_file import SystemFile
from microros_gen.application.system_find import has_agent, other_board, read_system
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder
from microros_gen.interfaces.types import Message, TypeName
from microros_gen.records import dataclass

_WRITER, _READER = TOPIC_KINDS


@dataclass(frozen=True)
class _Board:
    """Another board of a system with its application; `folder` is that of the application file."""

    application: Application
    source: Source
    folder: Path


def with_bus_senders(
    application: Application, near: Path, interface_paths: tuple[Path, ...], diagnostics: Diagnostics
) -> tuple[Application, Mapping[str, Source]]:
    """Return the application with what others send on the buses of its links, and the files that were read for it.

    The system file and the boards of these links were read before, without errors. `interface_paths` are searched
    before those of each board.
    """
    devices = dict.fromkeys(link.own.name for link in application.links if link.can is not None)
    if application.system is None or not devices:
        return application, {}
    path = near / application.system.file.name
    found = read_system(path, None, Diagnostics())
    if found is None:
        return application, {}
    system, own = found[0], application.system.board.name
    boards = _boards(own, system, path, diagnostics)
    senders: list[BusSender] = []
    files: list[Path] = []
    for sender in (sender for device in devices for sender in _senders(own, device, system, boards)):
        messages, read = _messages(sender, boards[sender.board], interface_paths, diagnostics)
        senders.append(replace(sender, messages=messages))
        files += read
    files += [Path(board.source.name) for board in boards.values()]
    application = replace(
        application, bus_senders=tuple(senders), bus_files=(*application.bus_files, *dict.fromkeys(files))
    )
    return application, {f"{name}: {Path(b.source.name).name}": b.source for name, b in boards.items()}


def _boards(own: str, system: SystemFile, path: Path, diagnostics: Diagnostics) -> Mapping[str, _Board]:
    """Return all other boards of the buses; faults of those that no link joins with this one are reported here."""
    known = {board for link in system.links for board, _ in link.ends if own in dict(link.ends)}
    names = bus_boards(system.links, own)
    boards: dict[str, _Board] = {}
    for name in names:
        found = other_board(name, system, path, Diagnostics() if name in known else diagnostics)
        if found is not None:
            application, source, file = found
            boards[name] = _Board(application, source, file.parent)
    return boards


def _senders(own: str, device: str, system: SystemFile, boards: Mapping[str, _Board]) -> Iterator[BusSender]:
    """Yield what has a rate on a bus and is neither from this board nor for it; types are not known yet."""
    links = bus_links(system.links, own, device)
    for link in links:
        for sender, receiver in permutations(can_ends(link), 2):
            if own not in (sender.board, receiver.board) and {sender.board, receiver.board} <= boards.keys():
                application = boards[sender.board].application
                wanted = {
                    (end.domain_id, end.topic)
                    for _, _, end in peer_ends(boards[receiver.board].application)
                    if end.kind == _READER
                }
                ends = [end for _, _, end in peer_ends(application) if (end.domain_id, end.topic) in wanted]
                yield from _sender(device, sender.board, receiver.board, application, ends)
    places = dict.fromkeys((end.board, end.device) for link in links for end in can_ends(link))
    for board, its_device in places:
        if board in boards and _has_agent_at(boards[board].application, its_device):
            application = boards[board].application
            ends = [
                end_of(node, e) for node in application.nodes for e in node.endpoints if e.exists_at_agent
            ]
            yield from _sender(device, board, None, application, ends)


def _has_agent_at(application: Application, device: str) -> bool:
    transport = application.transport
    return transport.can_id is not None and transport.can_device == device and has_agent(application)


def _sender(
    device: str, board: str, receiver: str | None, application: Application, ends: list[PeerEnd]
) -> Iterator[BusSender]:
    rated = tuple(end for end in ends if end.kind == _WRITER and end.interval_us is not None)
    if rated:
        mtu = CANFD_LINK_MTU if receiver is not None else application.transport.mtu
        times = application.times
        yield BusSender(
            device=device,
            board=board,
            receiver=receiver,
            publishers=rated,
            messages={},
            mtu=mtu or CANFD_LINK_MTU,
            limits=application.limits,
            round_trip=times.round_trip,
            heartbeat=times.heartbeat,
        )


def _messages(
    sender: BusSender, board: _Board, interface_paths: tuple[Path, ...], diagnostics: Diagnostics
) -> tuple[Mapping[TypeName, Message], tuple[Path, ...]]:
    """Return the types of what a board sends, and their files; a type that is not found is an error there."""
    own = (board.folder / path.name for path in board.application.interface_paths)
    finder = InterfaceFinder.from_environment((*interface_paths, *own))
    wanted = {end.type: Named(end.type, end.span) for end in reversed(sender.publishers)}
    interfaces = resolve_interfaces(tuple(wanted.values()), finder, diagnostics)
    if diagnostics.has_errors():
        return {}, ()
    return interfaces.messages, tuple(Path(entry.source.name) for entry in interfaces)
