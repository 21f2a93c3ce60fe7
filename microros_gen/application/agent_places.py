# SPDX-License-Identifier: Apache-2.0
"""Where agents are: addresses, devices, or a search."""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Sequence

from microros_gen.application.model import DISCOVERY_PORT
from microros_gen.diagnostics import Diagnostics, Span

MOST_AGENTS = 8
"""Agents in a list: `connect_timeout` is at least ten round trips, which is one for each of them."""

Places = Sequence[tuple[str, Span | None]]
"""Texts of a list of agents, with their places."""


def parse_discover(text: str, span: Span | None, diagnostics: Diagnostics) -> int | None:
    """Return the port of `discover` or `discover:7401`, which agents are searched for with; None: it is an address."""
    word, separator, port = text.partition(":")
    if word != "discover":
        return None
    if separator and not (re.fullmatch(r"[0-9]{1,5}", port) and 1 <= int(port) <= 65535):
        message = f"the port of the search must be a whole number between 1 and 65535; it is '{port}'"
        diagnostics.error(message, span, "Write `agent: discover`: agents listen at 7400", id="MG-3017")
        return DISCOVERY_PORT
    return int(port) if separator else DISCOVERY_PORT


def parse_agents(texts: Places, span: Span | None, diagnostics: Diagnostics) -> tuple[tuple[str, int], ...]:
    """Return address and port of each agent of a list with their places; none and errors where it is no such list."""
    found: list[tuple[str, int]] = []
    for text, place in texts:
        if text.partition(":")[0] == "discover":
            message = "a list of agents cannot contain 'discover'"
            diagnostics.error(message, place, "Write `agent: discover` instead of `agents`", id="MG-3181")
            return ()
        address = parse_agent_address(text, place, diagnostics)
        if address is None:
            return ()
        if address in found:
            _report_twice(text, place, diagnostics)
        found.append(address)
    _check_count(len(found), span, diagnostics)
    if len({":" in host for host, _ in found}) > 1:
        message = "the agents have IPv4 and IPv6 addresses"
        diagnostics.error(message, span, "Give all of them addresses of one kind", id="MG-3184")
    return tuple(found)


def are_devices(texts: Places) -> bool:
    """Return whether a list of agents has paths of devices, and no addresses."""
    return all(text.startswith("/") for text, _ in texts)


def parse_agent_devices(texts: Places, span: Span | None, diagnostics: Diagnostics) -> tuple[str, ...]:
    """Return the serial device of each agent of a list; one that is in the list twice is an error."""
    found: list[str] = []
    for text, place in texts:
        if text in found:
            _report_twice(text, place, diagnostics)
        found.append(text)
    _check_count(len(found), span, diagnostics)
    return tuple(found)


def _report_twice(text: str, place: Span | None, diagnostics: Diagnostics) -> None:
    diagnostics.error(f"the agent '{text}' is in the list twice", place, "Remove it", id="MG-3182")


def _check_count(count: int, span: Span | None, diagnostics: Diagnostics) -> None:
    if count > MOST_AGENTS:
        message = f"the list has {count} agents; it may have {MOST_AGENTS}"
        diagnostics.error(message, span, f"Keep {MOST_AGENTS} of them", id="MG-3183")


def parse_agent_address(text: str, span: Span | None, diagnostics: Diagnostics) -> tuple[str, int] | None:
    """Return host and port of `192.168.1.10:8888` or `[fd00::1]:8888`; None and an error where it is neither."""
    if text.count(":") > 1 and not re.fullmatch(r"\[.*\]:[^:\]]*", text):
        message = f"the agent '{text}' has an IPv6 address that is not in brackets, or has no port"
        diagnostics.error(message, span, 'Write it as "[::1]:8888"', id="MG-3018")
        return None
    host, separator, port = text.rpartition(":")
    if not separator:
        diagnostics.error(
            f"missing port in the agent address '{text}'", span, f'Write "{text}:8888"', id="MG-3019"
        )
        return None
    valid = _check_host(host, span, diagnostics)
    if not re.fullmatch(r"[0-9]{1,5}", port) or not 1 <= int(port) <= 65535:
        message = f"the agent's port must be a whole number between 1 and 65535; it is '{port}'"
        diagnostics.error(message, span, "The public agent's examples use 8888", id="MG-3020")
        return None
    return (host.strip("[]"), int(port)) if valid else None


def _check_host(host: str, span: Span | None, diagnostics: Diagnostics) -> bool:
    if host.startswith("["):
        return _check_ipv6(host.strip("[]"), span, diagnostics)
    try:
        ipaddress.IPv4Address(host)
    except ValueError as fault:
        if re.fullmatch(r"[0-9.]*", host):
            reason = str(fault).split(" in ")[0]
            hint = f"Write four numbers from 0 to 255 without leading zeros ({reason})"
            diagnostics.error(
                f"the agent's address '{host}' is not an IPv4 address", span, hint, id="MG-3021"
            )
        else:
            hint = "A device has no DNS to resolve it: write the IPv4 address"
            diagnostics.error(f"the agent's address '{host}' is a host name", span, hint, id="MG-3022")
        return False
    return True


def _check_ipv6(host: str, span: Span | None, diagnostics: Diagnostics) -> bool:
    try:
        zone = ipaddress.IPv6Address(host).scope_id
    except ValueError as fault:
        hint = f"Write up to eight groups of hexadecimal digits ({str(fault).split(' in ')[0]})"
        diagnostics.error(f"the agent's address '{host}' is not an IPv6 address", span, hint, id="MG-3023")
        return False
    if zone is not None:
        message = f"the agent's address '{host}' names the interface '{zone}' of one machine"
        diagnostics.error(message, span, "Write an address that the device can use without it", id="MG-3024")
    return zone is None
