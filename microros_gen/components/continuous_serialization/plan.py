# SPDX-License-Identifier: Apache-2.0
"""The size of a fragment of a message that is written while it is sent: as large as the transport takes at once."""

from __future__ import annotations

from microros_gen.client.plan.features import PlanContext
from microros_gen.client.plan.transport_sizes import part_size
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass


@dataclass(frozen=True)
class ContinuousPlan:
    """`size`: bytes of a message with a fragment, headers included."""

    size: int


def plan(context: PlanContext, diagnostics: Diagnostics) -> ContinuousPlan:
    """Return the size that the largest message of the plan was given for it (client/plan/project.py)."""
    runtime = context.runtime
    kind, send_buffer = runtime.transport.kind, runtime.transport.send_buffer
    return ContinuousPlan(part_size(kind, runtime.streams.mtu, send_buffer, context.application))


def record(part: ContinuousPlan) -> object:
    """Return what the plan id is made of."""
    return {"size": part.size}
