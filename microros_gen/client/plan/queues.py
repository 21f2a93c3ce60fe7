# SPDX-License-Identifier: Apache-2.0
"""Queues of received samples whose bytes the application file bounds (`queue_bytes`).

Samples of such a queue lie one after the other and each takes its own size, so as many fit as their sizes add up to.
"""

from __future__ import annotations

from microros_gen.application.model import Application, EndpointDecl
from microros_gen.client.plan.runtime_entities import QueuePlan
from microros_gen.client.plan.streams import slot_of
from microros_gen.diagnostics import Diagnostics, Span

POOL_KEY = "pools.queue_bytes"


def declared_queue(
    endpoint: EndpointDecl, slots: int, slot_size: int, label: str, diagnostics: Diagnostics
) -> QueuePlan:
    """Return the queue of a declared endpoint; `label` says what waits in it."""
    span = endpoint.queue_bytes_span or endpoint.span
    queue = _queue("queue_bytes", endpoint.queue_bytes, QueuePlan(slots, slot_size), label, span, diagnostics)
    if endpoint.queue_bytes is not None and queue.requested_bytes is None:
        samples = "1 sample takes" if slots == 1 else f"{slots} of the largest samples take"
        diagnostics.warning(
            f"'queue_bytes' has no effect: {samples} {queue.size} bytes",
            span,
            "Remove it, or let more samples wait (`queue`)",
            id="MG-7016",
        )
    return queue


def pooled_queue(
    application: Application, slots: int, slot_size: int, label: str, diagnostics: Diagnostics
) -> QueuePlan:
    """Return the queue of each place of a pool."""
    requested, span = application.pools.get("queue_bytes"), application.spans.get(POOL_KEY)
    return _queue(POOL_KEY, requested, QueuePlan(slots, slot_size), label, span, diagnostics)


def check_pool_key(application: Application, queues: tuple[QueuePlan, ...], diagnostics: Diagnostics) -> None:
    """Warn of a `pools.queue_bytes` that makes no queue smaller."""
    if application.nodes:
        return  # parse_application has said so
    if "queue_bytes" in application.pools and all(queue.requested_bytes is None for queue in queues):
        largest = max((queue.size for queue in queues), default=0)
        diagnostics.warning(
            f"'{POOL_KEY}' has no effect: no queue takes more than {largest} bytes",
            application.spans.get(POOL_KEY),
            "Remove it, or let more samples wait (`pools.queue`)",
            id="MG-7017",
        )


def _queue(
    key: str, requested: int | None, whole: QueuePlan, label: str, span: Span | None, diagnostics: Diagnostics
) -> QueuePlan:
    """Return `whole`, or a queue of the bytes that are asked for, where these are fewer."""
    size = whole.size if requested is None else slot_of(requested)
    if size >= whole.size:
        return whole
    if size < whole.slot_size:
        diagnostics.error(
            f"'{key}' is {requested} and the largest sample takes {whole.slot_size} bytes ({label})",
            span,
            f"Set queue_bytes: {whole.slot_size} or more, or lower its limits",
            id="MG-7018",
        )
    return QueuePlan(whole.slots, whole.slot_size, max(size, whole.slot_size))
