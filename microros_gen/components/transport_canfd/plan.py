# SPDX-License-Identifier: Apache-2.0
"""Device and identifier of a client on a CAN FD bus."""

from __future__ import annotations

from microros_gen.application.system_find import has_agent
from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.records import dataclass

DEVICE_SIZE = 64
"""Bytes of a device's name with its NUL: RMW_UXRCE_MAX_CAN_DEVICE_SIZE."""


@dataclass(frozen=True)
class CanPlan:
    """`device`: what the port knows the controller by; `id`: the extended identifier of its frames, 29 bits."""

    device: str
    id: int

    @property
    def shown(self) -> str:
        """Return the identifier as CAN tools write it; 0: there is no agent."""
        return f"{self.device}, identifier {self.id:#x}" if self.id else f"{self.device}, no agent"


def plan(context: PlanContext, diagnostics: Diagnostics) -> CanPlan:
    """Return both; a client without an identifier is an error, since no two of a bus may have the same.

    An image that exchanges nothing with an agent needs none.
    """
    transport = context.application.transport
    if transport.can_id is None and has_agent(context.application):
        diagnostics.error(
            "transport: canfd needs the identifier of this client's frames",
            transport.type_span or transport.span,
            "Write `transport: {type: canfd, id: 0x7f}`; each client of a bus needs its own",
            id="MG-7184",
        )
    if len(transport.can_device.encode()) >= DEVICE_SIZE:
        diagnostics.error(
            f"the CAN device '{transport.can_device}' has more than {DEVICE_SIZE - 1} bytes",
            context.application.spans.get("transport.device"),
            "Name a network interface such as can0",
            id="MG-7185",
        )
    return CanPlan(device=transport.can_device, id=transport.can_id or 0)


def record(part: CanPlan) -> object:
    """Return what the plan id is made of."""
    return {"device": part.device, "id": part.id}
