# SPDX-License-Identifier: Apache-2.0
"""Links over CAN FD: the boards of a bus, and the identifiers of the frames between each two of them.

An identifier is that of the link (`id`), plus 256 times the number of the sender, plus the number of the receiver: no
two boards send frames with one identifier, and a controller filters what is for it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import permutations

from microros_gen.application.system_decl import LinkDecl
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.records import dataclass

CANFD_LINK_MTU = 63
"""Bytes of a message: a frame has 64, and the first is the length."""
DEFAULT_ID = 0x10000
LARGEST_ID = 0x1FFF0000
"""Of a link; system.schema.json says it too."""
_MOST_NUMBER = 255
_SENDER = 256
_END = re.compile(r"(?P<device>unix:[^\s]+?|[^\s:]+)(?::(?P<number>0x[0-9a-fA-F]{1,2}|[0-9]{1,3}))?")


@dataclass(frozen=True)
class CanEnd:
    """A board of a bus: what its port knows the controller by, and its number there, 1 to 255."""

    board: str
    device: str
    number: int


def can_end(board: str, text: str, position: int) -> CanEnd | None:
    """Return the end `can0:0x21` or `can0` of a link; without a number that is its position in `ends`, from 1 on.

    None: it is neither.
    """
    found = _END.fullmatch(text)
    if found is None:
        return None
    number = int(found["number"], 0 if "x" in found["number"] else 10) if found["number"] else position + 1
    return CanEnd(board, found["device"], number) if 1 <= number <= _MOST_NUMBER else None


def can_ends(link: LinkDecl) -> tuple[CanEnd, ...]:
    """Return the boards of a link over CAN FD that is checked."""
    found = (can_end(board, place.name, i) for i, (board, place) in enumerate(link.ends))
    return tuple(end for end in found if end is not None)


def identifier(link: LinkDecl, sender: CanEnd, receiver: CanEnd) -> int:
    """Return the extended identifier of the frames from one board to another one, 29 bits."""
    return link.can_id + _SENDER * sender.number + receiver.number


def bus_identifiers(links: Sequence[LinkDecl], board: str, device: str) -> dict[int, str]:
    """Return the identifiers on the bus at a controller of a board, and which boards exchange frames with each."""
    bus = bus_links(links, board, device)
    return {number: f"{s.board} to {r.board}" for link in bus for number, s, r in _frames(link)}


def bus_links(links: Sequence[LinkDecl], board: str, device: str) -> Sequence[LinkDecl]:
    """Return the links of the bus at a controller of a board, those of other boards among them."""
    return next((b for b in _buses(links) if any(_is_at(link, board, device) for link in b)), ())


def bus_boards(links: Sequence[LinkDecl], board: str) -> tuple[str, ...]:
    """Return the other boards of all buses of a board, in the order of the links."""
    devices = dict.fromkeys(end.device for link in links for end in can_ends(link) if end.board == board)
    buses = (bus_links(links, board, device) for device in devices)
    found = dict.fromkeys(end.board for bus in buses for link in bus for end in can_ends(link))
    return tuple(name for name in found if name != board)


def check_end(board: str, end: Named, position: int, diagnostics: Diagnostics) -> None:
    """Report an end that is no controller with a number."""
    if can_end(board, end.name, position) is None:
        message = f"'{end.name}' is no CAN device with a number of 1 to {_MOST_NUMBER}"
        diagnostics.error(
            message, end.span, "Write it as can0:0x21, or as can0 without a number", id="MG-3247"
        )


def check_buses(links: Sequence[LinkDecl], diagnostics: Diagnostics) -> None:
    """Report boards of one number, and links of one bus with the same identifiers."""
    for link in links:
        if link.kind == "canfd":
            _check_numbers(link, diagnostics)
    for bus in _buses(links):
        first: dict[int, LinkDecl] = {}
        for link in bus:
            clash = next((n for n, _, _ in _frames(link) if first.setdefault(n, link) is not link), None)
            if clash is None:
                continue
            message = (
                f"frames of this link and of that in line {first[clash].span.line} have the same identifier "
                f"{clash:#x}, and a board joins their buses"
            )
            hint = f"Write another `id:` at one of them, such as {_next_free(bus):#x}"
            diagnostics.error(message, link.span, hint, id="MG-3249")


def _check_numbers(link: LinkDecl, diagnostics: Diagnostics) -> None:
    taken: dict[int, str] = {}
    free = next(n for n in range(1, 256) if n not in {end.number for end in can_ends(link)})
    for end, (_, place) in zip(can_ends(link), link.ends, strict=True):
        if end.number in taken:
            message = (
                f"the boards '{taken[end.number]}' and '{end.board}' have the number {end.number} on one bus"
            )
            hint = f"Write another one: {end.device}:{free}"
            diagnostics.error(message, place.span, hint, id="MG-3248")
        taken.setdefault(end.number, end.board)


def _frames(link: LinkDecl) -> Iterator[tuple[int, CanEnd, CanEnd]]:
    """Yield each identifier of a link with its sender and its receiver."""
    for sender, receiver in permutations(can_ends(link), 2):
        yield identifier(link, sender, receiver), sender, receiver


def _is_at(link: LinkDecl, board: str, device: str) -> bool:
    return any((end.board, end.device) == (board, device) for end in can_ends(link))


def _buses(links: Sequence[LinkDecl]) -> list[list[LinkDecl]]:
    """Return the links over CAN FD, those of one bus together: a controller is on one bus."""
    buses: list[list[LinkDecl]] = []
    for link in (link for link in links if link.kind == "canfd"):
        places = {(end.board, end.device) for end in can_ends(link)}
        joined = [bus for bus in buses if any(_is_at(other, *p) for other in bus for p in places)]
        buses = [bus for bus in buses if bus not in joined]
        buses.append([other for bus in joined for other in bus] + [link])
    return buses


def _next_free(bus: list[LinkDecl]) -> int:
    """Return an `id` whose identifiers no link of a bus has."""
    possible = range(DEFAULT_ID, LARGEST_ID, DEFAULT_ID)
    return next(each for each in possible if all(abs(each - link.can_id) >= DEFAULT_ID for link in bus))
