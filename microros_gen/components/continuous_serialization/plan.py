# SPDX-License-Identifier: Apache-2.0
"""The size of a fragment of a message that is written while it is sent: as large as the transport takes at once."""

from __future__ import annotations

from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.transport_sizes import DEFAULT_MTU, most_in_buffer
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass


@dataclass(frozen=True)
class ContinuousPlan:
    """`size`: bytes of a message with a fragment, headers included."""

    size: int


def plan(context: PlanContext, diagnostics: Diagnostics) -> ContinuousPlan:
    """Return the MTU, or what the send buffer of a serial line holds with every byte stuffed."""
    runtime = context.runtime
    kind = runtime.transport.kind
    largest = context.application.transport.mtu or max(DEFAULT_MTU[kind], runtime.streams.mtu)
    if kind == "serial":
        largest = min(largest, most_in_buffer(runtime.transport.send_buffer, context.application))
    return ContinuousPlan(largest)


def record(part: ContinuousPlan) -> object:
    """Return what the plan id is made of."""
    return {"size": part.size}
