# SPDX-License-Identifier: Apache-2.0
"""Hand-made plans of the client."""

from __future__ import annotations

from dataclasses import is_dataclass, replace
from typing import Any, TypeVar, cast

from microros_gen.client.plan.entities import EntitiesPlan, Places
from microros_gen.client.plan.messages import MessagesPlan, number_sequences
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import NodePlan, PublisherPlan, QueuePlan
from microros_gen.client.plan.session_times import TimesPlan
from microros_gen.client.plan.slices import (
    ErrorsPlan,
    InputPlan,
    MemoryPlan,
    OutputPlan,
    SessionPlan,
    TransportPlan,
)
from microros_gen.interfaces.types import Primitive, TypeName

INT32 = TypeName("std_msgs", "msg", "Int32")
Plan = TypeVar("Plan")

ALL_MESSAGES = MessagesPlan(
    number_sequences=number_sequences(p for p in Primitive if p is not Primitive.LONG_DOUBLE),
    text_sequences=True,
    wide_texts=True,
    wide_text_sequences=True,
)
"""Messages with every kind of member that an interface file can have."""

POOL = RuntimePlan(
    plan_id="0123456789abcdef",
    session=SessionPlan(id=0x81, client_key=0xA1B2C3D4),
    transport=TransportPlan(agent_host="127.0.0.1", agent_port=8888),
    streams=OutputPlan(
        mtu=128,
        best_effort_size=128,
        reliable_slots=4,
        reliable_slot_size=64,
        on_full="error",
        on_full_block_ms=0,
    ),
    input=InputPlan(size=64),
    entities=EntitiesPlan(
        declared=False, nodes=Places(2), publishers=Places(3), name_size=32, type_name_size=32
    ),
    memory=MemoryPlan(arena_size=0),
    errors=ErrorsPlan(text_size=160),
    messages=ALL_MESSAGES,
    times=TimesPlan(
        connect_timeout_ms=400,
        create_timeout_ms=400,
        close_timeout_ms=200,
        liveliness_period_ms=100,
        liveliness_wait_ms=100,
        retry_first_ms=40,
        retry_most_ms=160,
    ),
)
"""An application that names its entities itself: two nodes, three publishers, UDP."""


def changed(plan: Plan, **changes: object) -> Plan:
    """Return `plan` with other values of fields, each named by its path: `changed(POOL, streams__mtu=64)`."""
    assert is_dataclass(plan), plan
    own: dict[str, Any] = {}
    of_slices: dict[str, dict[str, object]] = {}
    for path, value in changes.items():
        name, _, rest = path.partition("__")
        if rest:
            of_slices.setdefault(name, {})[rest] = value
        else:
            own[name] = value
    own |= {name: changed(getattr(plan, name), **inner) for name, inner in of_slices.items()}
    changed_plan: Plan = replace(cast(Any, plan), **own)
    return changed_plan


DECLARED = changed(
    POOL,
    entities__declared=True,
    entities__type_name_size=0,
    entities__nodes__max=1,
    entities__publishers__max=2,
    entities__name_size=0,
    entities__nodes__declared=(NodePlan(0, "imu", "/arm", "/arm/imu", 77),),
    entities__publishers__declared=(
        PublisherPlan(0, 0, "/arm/chatter", "rt/arm/chatter", INT32, True),
        PublisherPlan(1, 0, "/arm/imu/fast", "rt/arm/imu/fast", INT32, False),
    ),
)

READER = changed(
    POOL,
    entities__subscriptions__max=2,
    input__queues=(QueuePlan(3, 16), QueuePlan(3, 16)),
    input__reliable_slots=2,
    input__reliable_slot_size=64,
)

SERVER = changed(
    POOL,
    streams__mtu=256,
    streams__best_effort_size=256,
    entities__publishers__max=1,
    entities__services__max=1,
    entities__clients__max=2,
    input__queues=(QueuePlan(2, 40), QueuePlan(3, 20), QueuePlan(2, 20)),
    input__reliable_slots=2,
    input__reliable_slot_size=64,
)

EXECUTOR = changed(
    READER,
    timers__max=3,
    executor__max=2,
    executor__handles_max=5,
    executor__guard_conditions_max=2,
    executor__wait_sets_max=1,
    clock__ros_clocks_max=2,
    clock__jump_callbacks_max=2,
)

# The first subscription is that of /clock.
ROS_TIME = changed(
    EXECUTOR,
    clock__has_ros_time=True,
    entities__type_name_size=40,
    entities__subscriptions__max=3,
    input__queues=(QueuePlan(1, 8), QueuePlan(3, 16), QueuePlan(3, 16)),
)
