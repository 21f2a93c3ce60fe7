# SPDX-License-Identifier: Apache-2.0
"""A system file: the boards, the applications and the links of a system without an agent."""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Mapping
from pathlib import Path

from microros_gen.application.system_can import CANFD_LINK_MTU, DEFAULT_ID, check_buses, check_end
from microros_gen.application.system_decl import ChipDecl, LinkDecl
from microros_gen.diagnostics import Diagnostics, Source, Span, nearest, reads
from microros_gen.documents.named import Named
from microros_gen.documents.schema import load_schema, validate
from microros_gen.documents.tree_values import (
    child,
    entries,
    int_of,
    items,
    named_of,
    size_of,
    span_of,
    text_of,
)
from microros_gen.documents.yaml_tree import MappingNode, YamlNode, parse_yaml
from microros_gen.records import dataclass

SCHEMA = Path(__file__).with_name("system.schema.json")
DEFAULT_MTU, DEFAULT_HISTORY = 512, 4
LARGEST_MTU = 16384
"""Of a link, bytes; system.schema.json says it too."""
MOST_IMAGES = 16
"""Of a chip: the position of one is in four bits of what its publishers and clients write (rmw_shared_sign.h)."""
UART = "uart"
"""What a serial link calls the line of a board without an operating system."""


@dataclass(frozen=True)
class SystemFile:
    """`boards`: the path of the application file of each, relative to the system file.

    `chips`: boards that are images of one chip.
    """

    boards: Mapping[str, Named]
    links: tuple[LinkDecl, ...]
    chips: tuple[ChipDecl, ...] = ()


@reads
def parse_system(source: Source, diagnostics: Diagnostics) -> SystemFile | None:
    """Return the system that `source` describes; None where `diagnostics` got errors from it."""
    found = Diagnostics()
    tree = parse_yaml(source, found)
    if tree is not None or not found.has_errors():
        validate(tree, source, load_schema(SCHEMA), found)
    system = None
    if isinstance(tree, MappingNode) and not found.has_errors():
        boards = {
            e.key: n for e in entries(child(tree, "boards")) if (n := named_of(child(e.value, "application")))
        }
        links = tuple(_link(item, boards, found) for item in items(child(tree, "links")))
        _check_twins(links, found)
        if not found.has_errors():
            check_buses(links, found)
        chips = tuple(_chip(item, boards, found) for item in items(child(tree, "chips")))
        _check_chips(chips, found)
        system = SystemFile(boards, links, chips)
    diagnostics.extend(found)
    return None if found.has_errors() else system


def address_of(text: str) -> tuple[str, int] | None:
    """Return host and port of `192.168.1.20:7500` or `[fd00::1]:7500`; None: it is no address."""
    host, _, port = text.rpartition(":")
    if not re.fullmatch(r"[0-9]{1,5}", port) or not 1 <= int(port) <= 65535:
        return None
    try:
        if host.startswith("[") and host.endswith("]"):
            found = ipaddress.IPv6Address(host[1:-1])
            return (host[1:-1], int(port)) if found.scope_id is None else None
        return (str(ipaddress.IPv4Address(host)), int(port))
    except ValueError:
        return None


def _link(item: YamlNode, boards: Mapping[str, Named], diagnostics: Diagnostics) -> LinkDecl:
    kind, ends = text_of(child(item, "type")) or "", entries(child(item, "ends"))
    if len(ends) > 2 and kind != "canfd":
        message = f"a {kind} link joins two boards; this one has {len(ends)} ends"
        diagnostics.error(message, ends[2].key_span, "Write a link for each pair of boards", id="MG-3192")
    for position, end in enumerate(ends):
        _check_board(end.key, end.key_span, boards, diagnostics)
        named = named_of(end.value)
        if kind == "canfd" and named is not None:
            check_end(end.key, named, position, diagnostics)
        if kind == "udp":
            _check_address(text_of(end.value) or "", end.value.span, diagnostics)
    _check_keys(item, kind, diagnostics)
    can_id = int_of(child(item, "id"))
    return LinkDecl(
        kind=kind,
        ends=tuple((end.key, named) for end in ends if (named := named_of(end.value)) is not None),
        mtu=CANFD_LINK_MTU if kind == "canfd" else int_of(child(item, "mtu")) or DEFAULT_MTU,
        history=int_of(child(item, "history")) or DEFAULT_HISTORY,
        span=item.span,
        can_id=DEFAULT_ID if can_id is None else can_id,
    )


def _check_address(text: str, span: Span | None, diagnostics: Diagnostics) -> None:
    """Report an end of a UDP link that is no address, or none of one board."""
    address = address_of(text)
    if address is None:
        wrong, example = "no IPv4 or IPv6 address with a port", "192.168.1.20:7500"
    else:
        host = ipaddress.ip_address(address[0])
        if isinstance(host, ipaddress.IPv6Address):
            host = host.ipv4_mapped or host
        is_reserved = host.version == 4 and host.is_reserved  # RFC 1112, 4; of IPv6 it would be `::1`, too
        if not (host.is_unspecified or host.is_multicast or is_reserved):
            return
        wrong, example = "not the address of one board", f"192.168.1.20:{address[1]}"
    hint = f"Write the address of this board as {example}"
    diagnostics.error(f"'{text}' is {wrong}", span, hint, id="MG-3193")


def _check_keys(item: YamlNode, kind: str, diagnostics: Diagnostics) -> None:
    """Report a key that the links of a kind do not have."""
    for key, is_wrong, why in (
        ("mtu", kind == "canfd", f"a frame of CAN FD carries {CANFD_LINK_MTU} bytes"),
        ("id", kind != "canfd", "only frames of CAN FD have identifiers"),
    ):
        node = child(item, key)
        if node is not None and is_wrong:
            message = f"a {kind} link has no `{key}`: {why}"
            diagnostics.error(message, node.span, f"Remove `{key}`", id="MG-3250")


def _check_board(name: str, span: Span | None, boards: Mapping[str, Named], diagnostics: Diagnostics) -> None:
    if name not in boards:
        hint = nearest(name, boards) or f"Available: {', '.join(sorted(boards))}"
        diagnostics.error(f"the system has no board '{name}'", span, hint, id="MG-3191")


def _chip(item: YamlNode, boards: Mapping[str, Named], diagnostics: Diagnostics) -> ChipDecl:
    """Return a chip: a list of boards, or a mapping with `images` and `memory`."""
    listed = child(item, "images") or item
    images = tuple(named for image in items(listed) if (named := named_of(image)) is not None)
    for image in images:
        _check_board(image.name, image.span, boards, diagnostics)
    if not 2 <= len(images) <= MOST_IMAGES:
        message = f"a chip has 2 to {MOST_IMAGES} images; this one has {len(images)}"
        hint = "Name the boards that share a memory; further images exchange messages with them by `links`"
        diagnostics.error(message, listed.span, hint, id="MG-3199")
    memory = child(item, "memory")
    return ChipDecl(images, size_of(memory), span_of(memory))


def _check_chips(chips: tuple[ChipDecl, ...], diagnostics: Diagnostics) -> None:
    """Report a board that is named twice."""
    seen: dict[str, Named] = {}
    for image in (image for chip in chips for image in chip.images):
        first = seen.setdefault(image.name, image)
        if first is not image:
            where = f", first in line {first.span.line}" if first.span else ""
            message = f"the board '{image.name}' is named twice in `chips`{where}"
            diagnostics.error(
                message,
                image.span,
                "Name it once: it shares a memory with the images of one chip, and is joined with others by `links`",
                id="MG-3198",
            )


def _check_twins(links: tuple[LinkDecl, ...], diagnostics: Diagnostics) -> None:
    """Report an address or line that two ends have: of a board, or an address of two boards."""
    seen: dict[tuple[str, str], Span | None] = {}
    for link in links:
        for board, place in link.ends if link.kind != "canfd" else ():
            key = ("" if link.kind == "udp" else board, place.name)
            if key in seen:
                first = seen[key]
                where = f"; the first is in line {first.line}" if first else ""
                message = f"'{place.name}' is the end of two links{where}"
                diagnostics.error(message, place.span, "Give each end its own port or line", id="MG-3194")
            seen.setdefault(key, place.span)
