# SPDX-License-Identifier: Apache-2.0
"""Plans with other times of the session."""

from __future__ import annotations

from microros_gen.application.model import SessionTimes
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.session_times import plan_times
from tests.support.plans import changed


def with_times(plan: RuntimePlan, times: SessionTimes, baud: int | None = None) -> RuntimePlan:
    return changed(plan, times=plan_times(times, baud, plan.streams.mtu, plan.input.size))
