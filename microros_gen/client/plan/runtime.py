# SPDX-License-Identifier: Apache-2.0
"""The plan of the C client, as slices by subject: everything that the templates of components print."""

from __future__ import annotations

from dataclasses import field

from microros_gen.client.plan.entities import EntitiesPlan
from microros_gen.client.plan.feature_slices import NO_FEATURES, Features
from microros_gen.client.plan.messages import MessagesPlan
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

WAITED_KINDS = ("subscription", "guard_condition", "timer", "client", "service")
"""What one can wait for, in the order of rcl_wait_set_init."""
RECEIVERS = {"subscription": "subscription", "client": "requester", "service": "replier"}
"""Kind of entity that receives → its name in rmw."""
HANDLE_POINTERS = ("subscription", "timer", "client", "service")


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
    messages: MessagesPlan = field(default_factory=MessagesPlan)
    features: Features = NO_FEATURES

    @property
    def waited(self) -> tuple[str, ...]:
        """What one can wait for: the kinds that have places."""
        places = {
            "subscription": self.entities.subscriptions.max,
            "guard_condition": self.executor.guard_conditions_max,
            "timer": self.timers.max,
            "client": self.entities.clients.max,
            "service": self.entities.services.max,
        }
        return tuple(kind for kind in WAITED_KINDS if places[kind] > 0)

    @property
    def waited_receivers(self) -> tuple[tuple[str, str], ...]:
        """Those of them that wait for samples, and how functions of rmw name them."""
        return tuple((kind, RECEIVERS[kind]) for kind in RECEIVERS if kind in self.waited)

    @property
    def waited_clocked(self) -> tuple[str, ...]:
        """Those of them that a clock makes ready."""
        return tuple(kind for kind in self.waited if kind == "timer")

    @property
    def waited_entities(self) -> tuple[str, ...]:
        """Those of them to which a handle has a pointer of their name, in the order in which it is looked for."""
        return tuple(kind for kind in HANDLE_POINTERS if kind in self.waited)

    @property
    def wait_limits(self) -> tuple[tuple[str, str], ...]:
        """Every kind, and how many of it one wait set takes at most, as C."""
        return tuple((k, f"MICROROS_{k.upper()}S_MAX" if k in self.waited else "0") for k in WAITED_KINDS)

    @property
    def requests_max(self) -> int:
        """Requests of all clients that can be under way: as many as their replies have room."""
        queues = self.input.queues
        return sum(queue.slots for queue in queues[len(queues) - self.entities.clients.max :])
