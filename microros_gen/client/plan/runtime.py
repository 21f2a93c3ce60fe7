# SPDX-License-Identifier: Apache-2.0
"""The plan of the C client, as slices by subject: everything that the templates of components print."""

from __future__ import annotations

from dataclasses import field

from microros_gen.client.plan.entities import EntitiesPlan
from microros_gen.client.plan.running import ClockPlan, ExecutorPlan, TimersPlan
from microros_gen.client.plan.session_times import TimesPlan
from microros_gen.client.plan.slices import (
    CreationPlan,
    ErrorsPlan,
    InputPlan,
    MemoryPlan,
    OutputPlan,
    SessionPlan,
    TransportPlan,
)
from microros_gen.records import dataclass


@dataclass(frozen=True, kw_only=True)
class RuntimePlan:
    """The slices, and what follows from several of them. `plan_id`: see plan_id.py."""

    plan_id: str
    session: SessionPlan
    transport: TransportPlan
    streams: OutputPlan
    input: InputPlan
    entities: EntitiesPlan
    memory: MemoryPlan
    errors: ErrorsPlan
    times: TimesPlan = field(default_factory=TimesPlan)
    creation: CreationPlan = field(default_factory=CreationPlan)
    timers: TimersPlan = field(default_factory=TimersPlan)
    executor: ExecutorPlan = field(default_factory=ExecutorPlan)
    clock: ClockPlan = field(default_factory=ClockPlan)

    @property
    def waited_kinds(self) -> tuple[tuple[str, bool], ...]:
        """What one can wait for, and whether there are places for any."""
        return (
            ("subscription", self.entities.subscriptions.any),
            ("guard_condition", self.executor.guard_conditions_max > 0),
            ("timer", self.timers.any),
            ("client", self.entities.clients.any),
            ("service", self.entities.services.any),
        )

    @property
    def requests_max(self) -> int:
        """Requests of all clients that can be under way: as many as their replies have room."""
        queues = self.input.queues
        return sum(queue.slots for queue in queues[len(queues) - self.entities.clients.max :])
