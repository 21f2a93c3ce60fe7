# SPDX-License-Identifier: Apache-2.0
"""The largest CREATE that the client sends, from the names of its entities."""

from __future__ import annotations

from microros_gen.application.model import Application
from microros_gen.client.plan.creation import CreateNames, create_size, create_text, participant_reference
from microros_gen.client.plan.runtime_entities import NodePlan, PublisherPlan, SubscriptionPlan
from microros_gen.client.plan.serving import Serving
from microros_gen.interfaces.dds_names import dds_type
from microros_gen.interfaces.types import TypeName
from microros_gen.selection.model import Selection

DEFAULT_NAME_SIZE = 64


def largest_create(
    application: Application,
    selection: Selection,
    nodes: tuple[NodePlan, ...],
    endpoints: tuple[PublisherPlan | SubscriptionPlan, ...],
    roots: tuple[TypeName, ...],
    serving: Serving,
    services: tuple[TypeName, ...],
) -> tuple[int, int]:
    """Return the size of the largest CREATE and how much of it is text; 0: the client creates nothing."""
    if selection.entities == "preconfigured":
        return 0, 0
    if not nodes:
        size = application.pools.get("name_size", DEFAULT_NAME_SIZE) - 1
        # A namespace takes `size` with its slash in front, which its reference does not have.
        reference = participant_reference("x" * 2 * size, application.pools.get("nodes", 1))
        places = serving.services_max + serving.clients_max
        of_service = (size, longest_type(services)) if places else (0, 0)
        names = CreateNames(2 * size + 1, size + len("rt"), longest_type(roots), len(reference), *of_service)
    else:
        names = CreateNames(
            max(len(n.participant_name) for n in nodes),
            max((len(p.dds_topic) for p in endpoints), default=len("rt/")),
            max((len(p.dds_type) for p in endpoints), default=0),
            max(len(participant_reference(n.participant_name, len(nodes))) for n in nodes),
            max((len(s.name) for s in (*serving.services, *serving.clients)), default=0),
            max((len(s.dds_type) for s in (*serving.services, *serving.clients)), default=0),
        )
    size = create_size(names, selection.entities)
    return size, create_text(size, names, selection.entities)


def longest_type(roots: tuple[TypeName, ...]) -> int:
    """Return the length of the longest DDS name of the types; 0 without types."""
    return max((len(dds_type(r)) for r in roots), default=0)
