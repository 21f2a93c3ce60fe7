# SPDX-License-Identifier: Apache-2.0
"""Who has the cryptography of sealed datagrams, and what they exclude."""

from __future__ import annotations

from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

OVERHEAD_BYTES = 32
"""Bytes of a record around its message."""
LARGEST_DATAGRAM = 65_507
_OTHERS = {
    "discovery": 'anyone can answer a search; write `transport: {agent: "192.168.1.10:8888"}`',
    "peer": "links between boards are not sealed",
    "sleep_cycles": "the keys of a session do not outlast a sleep",
}
"""Components that use the socket in another way, and why."""


@dataclass(frozen=True)
class SealPlan:
    """`provider`: psa or application."""

    provider: str

    @property
    def is_psa(self) -> bool:
        """Whether the PSA Crypto API has it."""
        return self.provider == "psa"


def plan(context: PlanContext, diagnostics: Diagnostics) -> SealPlan:
    """Return the plan; what excludes sealed datagrams is an error."""
    application, selection = context.application, context.selection
    provider = application.transport.seal
    place = application.spans.get("transport.seal") or application.spans.get("components")
    if not provider:
        message = "the component 'seal' is for sealed datagrams, and the application has none"
        diagnostics.error(message, place, "Write `transport: {seal: psa}`", id="MG-3260")
    if not isinstance(application.session_key, int):
        message = "sealed datagrams need a client key, under which the agent has the key of this device"
        diagnostics.error(message, place, "Write `session: {key: 0xA1B2C3D4}`", id="MG-3261")
    if selection.liveliness == "none":
        message = "sealed datagrams contradict 'liveliness: none': the client does not notice a restart of its agent"
        diagnostics.error(message, place, "Write `liveliness: ping`", id="MG-3262")
    for name, why in _OTHERS.items():
        if selection.has(name):
            message = f"sealed datagrams contradict the component '{name}': {why}"
            diagnostics.error(message, place, f"Remove `seal`, or what selects '{name}'", id="MG-3263")
    wanted = application.transport.mtu or 0
    largest = max(wanted, context.runtime.streams.mtu, context.runtime.input.size) + OVERHEAD_BYTES
    if largest > LARGEST_DATAGRAM:
        message = f"the largest sealed message takes {largest} bytes; a UDP datagram holds {LARGEST_DATAGRAM}"
        hint = f"Set `transport: {{mtu: {LARGEST_DATAGRAM - OVERHEAD_BYTES}}}` or less"
        diagnostics.error(message, place, hint, id="MG-3270")
    return SealPlan(provider or "psa")


def record(part: SealPlan) -> object:
    """Return what the plan id is made of."""
    return part.provider
