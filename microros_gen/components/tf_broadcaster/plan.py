# SPDX-License-Identifier: Apache-2.0
"""How many transforms a message has, and how long the names of frames are: from the limits of TFMessage."""

from __future__ import annotations

from microros_gen.application.model import Application, LimitRule
from microros_gen.client.plan.features import PlanContext, refuse_own_limits
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass

TYPE = TypeName("tf2_msgs", "msg", "TFMessage")
TRANSFORMS, FRAME = 3, 31
"""Transforms of a message and bytes of a frame's name where the application has no limits for them."""


@dataclass(frozen=True, kw_only=True)
class TfPlan:
    """`frame`: bytes of the longest name of a frame, without its NUL."""

    transforms: int
    frame: int


def plan(context: PlanContext, diagnostics: Diagnostics) -> TfPlan:
    """Return the limits that hold."""
    refuse_own_limits(context, "tf_broadcaster", diagnostics)
    rules = {rule.path: rule for rule in context.application.limits}
    transforms = rules.get((str(TYPE), "transforms"))
    names = [rules[path].string for path in _NAMES if path in rules]
    return TfPlan(
        transforms=(transforms.sequence if transforms is not None else None) or TRANSFORMS,
        frame=min((name for name in names if name is not None), default=FRAME),
    )


def record(part: TfPlan) -> object:
    """Return what the plan id is made of."""
    return [part.transforms, part.frame]


def limits(application: Application) -> tuple[LimitRule, ...]:
    """Return the bounds of a message of both topics."""
    own = {rule.path for rule in application.limits}
    rules = (
        LimitRule((str(TYPE), "transforms"), None, TRANSFORMS),
        *(LimitRule(path, FRAME, None) for path in _NAMES),
    )
    return tuple(rule for rule in rules if rule.path not in own)


_NAMES = (
    (str(TYPE), "transforms", "header", "frame_id"),
    (str(TYPE), "transforms", "child_frame_id"),
)
