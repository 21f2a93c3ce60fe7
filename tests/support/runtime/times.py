# SPDX-License-Identifier: Apache-2.0
"""Plans with other times of the session."""

from __future__ import annotations

from dataclasses import replace

from microros_gen.application.model import SessionTimes
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.session_times import plan_times


def with_times(plan: RuntimePlan, times: SessionTimes, baud: int | None = None) -> RuntimePlan:
    return replace(plan, **vars(plan_times(times, baud, plan.mtu, plan.input_size)))
