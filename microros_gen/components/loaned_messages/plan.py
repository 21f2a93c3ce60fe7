# SPDX-License-Identifier: Apache-2.0
"""Which declared subscriptions can be taken from without a copy: where strings and numbers can stay in the queue."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.client.plan.declared import declarations
from microros_gen.client.plan.features import PlanContext
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.decode import DecodeStep, Messages, NumberSequence, Part, Strings
from microros_gen.typesupport.plan.names import include_path, type_files
from microros_gen.typesupport.plan.types import TypePlan


@dataclass(frozen=True)
class LoanPlan:
    """A subscription in the order of all; `c_types` has the struct of its message, or nothing without loans."""

    index: int
    topic: str
    c_types: tuple[str, ...]

    @property
    def initializer(self) -> str:
        """Its row in C."""
        return f"{{&loan_{self.index}, sizeof(loan_{self.index})}}" if self.c_types else "{NULL, 0u}"


@dataclass(frozen=True)
class LoansPlan:
    """All subscriptions, and the headers of their structs."""

    subscriptions: tuple[LoanPlan, ...]
    headers: tuple[str, ...]
    shown: str


def plan(context: PlanContext, diagnostics: Diagnostics) -> LoansPlan:
    """Return the subscriptions with loans: none where samples move (`queue_bytes`) or memory is lost in a sleep.

    A local subscription takes messages of the image as well, which are no bytes in its queue.
    """
    runtime = context.runtime
    stays = runtime.input.queue_mode == "slots" and not runtime.session.has_sleep
    subscriptions, headers, topics = [], set[str](), []
    ends = enumerate(end for _, _, end in declarations(context.application, "subscription"))
    local = {index for index, end in ends if end.local != "never"}
    for row in runtime.entities.subscriptions.declared:
        loans = stays and row.index not in local and bool(row.c_type) and _stays(row.type, context.types)
        subscriptions.append(LoanPlan(row.index, row.topic, (row.c_type,) if loans else ()))
        if loans:
            headers.add(include_path(type_files(row.type).struct))
            topics.append(row.topic)
    return LoansPlan(tuple(subscriptions), tuple(sorted(headers)), ", ".join(topics) or "none")


def record(part: LoansPlan) -> object:
    """Return what the plan id is made of."""
    return [bool(row.c_types) for row in part.subscriptions]


def _stays(name: TypeName, types: Mapping[TypeName, TypePlan]) -> bool:
    """Return whether all members of variable length can be used where they are in the body."""
    decoder = types[name].decoder
    return decoder is not None and all(_step_stays(step, types) for step in decoder.steps)


def _step_stays(step: DecodeStep, types: Mapping[TypeName, TypePlan]) -> bool:
    """Return the same of a step. Wide strings and converted numbers differ there; sequences of others need memory."""
    if isinstance(step, NumberSequence):
        return step.form.isdigit()
    if isinstance(step, Strings):
        return not step.wide and not step.sequence
    if isinstance(step, Messages):
        return step.count is not None and (step.row is not None or _stays(step.type, types))
    return not isinstance(step, Part) or _stays(step.type, types)
