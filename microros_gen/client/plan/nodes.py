# SPDX-License-Identifier: Apache-2.0
"""The declared nodes."""

from __future__ import annotations

from microros_gen.application.model import Application
from microros_gen.client.plan.runtime_entities import NodePlan
from microros_gen.interfaces.dds_names import participant_name


def plan_nodes(application: Application) -> tuple[NodePlan, ...]:
    """Plan the nodes of `nodes:`; none where the application creates them at run time."""
    return tuple(
        NodePlan(
            i,
            n.name,
            n.namespace,
            participant_name(n.name, n.namespace),
            n.domain_id,
            n.given_name,
            n.given_namespace,
        )
        for i, n in enumerate(application.nodes)
    )
