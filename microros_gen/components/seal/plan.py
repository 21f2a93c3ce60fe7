# SPDX-License-Identifier: Apache-2.0
"""Who has the cryptography of sealed messages, and what they exclude."""

from __future__ import annotations

from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.transport_sizes import SEAL_OVERHEAD
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

_LARGEST = {
    "udp": (65_507, "a UDP datagram"),
    "tcp": (65_533, "a message over TCP"),
    "serial": (65_535, "a frame of a serial line"),
}
"""Transports whose messages can be sealed, the largest message of each in bytes, and its name."""
_OTHERS = {
    "discovery": 'anyone can answer a search; write `transport: {agent: "192.168.1.10:8888"}`',
    "peer": "links between boards are not sealed",
    "sleep_cycles": "the keys of a session do not outlast a sleep",
}
"""Components that use the transport in another way, and why."""


@dataclass(frozen=True)
class SealPlan:
    """`provider`: psa or application. `arrives_in_parts`: the transport receives a stream of bytes."""

    provider: str
    arrives_in_parts: bool = False

    @property
    def is_psa(self) -> bool:
        """Whether the PSA Crypto API has it."""
        return self.provider == "psa"


def plan(context: PlanContext, diagnostics: Diagnostics) -> SealPlan:
    """Return the plan; what excludes sealed messages is an error."""
    application, selection = context.application, context.selection
    provider = application.transport.seal
    place = application.spans.get("transport.seal") or application.spans.get("components")
    if not provider:
        message = "the component 'seal' is for sealed messages, and the application has none"
        diagnostics.error(message, place, "Write `transport: {seal: psa}`", id="MG-3260")
    if not isinstance(application.session_key, int):
        message = "sealed messages need a client key, under which the agent has the key of this device"
        diagnostics.error(message, place, "Write `session: {key: 0xA1B2C3D4}`", id="MG-3261")
    if selection.liveliness == "none":
        message = (
            "sealed messages contradict 'liveliness: none': the client does not notice a restart of its agent"
        )
        diagnostics.error(message, place, "Write `liveliness: ping`", id="MG-3262")
    for name, why in _OTHERS.items():
        if selection.has(name):
            message = f"sealed messages contradict the component '{name}': {why}"
            diagnostics.error(message, place, f"Remove `seal`, or what selects '{name}'", id="MG-3263")
    if selection.transport not in _LARGEST:
        message = f"messages over the transport '{selection.transport}' are not sealed"
        hint = f"Remove `seal`, or write `transport: {{type: udp}}` ({', '.join(_LARGEST)})"
        diagnostics.error(message, place, hint, id="MG-3275")
        return SealPlan(provider or "psa")
    most, name = _LARGEST[selection.transport]
    wanted = application.transport.mtu or 0
    largest = max(wanted, context.runtime.streams.mtu, context.runtime.input.size) + SEAL_OVERHEAD
    if largest > most:
        message = f"the largest sealed message takes {largest} bytes; {name} holds {most}"
        hint = f"Set `transport: {{mtu: {most - SEAL_OVERHEAD}}}` or less"
        diagnostics.error(message, place, hint, id="MG-3270")
    return SealPlan(provider or "psa", selection.transport != "udp")


def record(part: SealPlan) -> object:
    """Return what the plan id is made of."""
    return part.provider
