# SPDX-License-Identifier: Apache-2.0
"""A selection with its plan: pools, capabilities and types, each with its reason."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from typing import Any

import click

from microros_gen import compiler
from microros_gen.application.kinds import KINDS
from microros_gen.cli.generate import warnings_text
from microros_gen.cli.tables import format_selection, format_table, selection_data
from microros_gen.cli.terminal import echo_found
from microros_gen.client.plan.streams import StreamSizes
from microros_gen.client.views.presence import report_rows
from microros_gen.compiler import Planned
from microros_gen.typesupport.plan.layout import ILP32, models_of
from microros_gen.typesupport.plan.types import TypePlan


def print_selection(kind: str, options: Mapping[str, Any]) -> None:
    """Print what `options` of the command line select, as `table`, `json` or `dot`. Raises UserError as `plan` does."""
    resolved = compiler.resolve(compiler.read(compiler.Options(**options)))
    chosen = resolved.selection
    ready = all(c.component.ready for c in chosen.components)
    planned = compiler.plan(resolved) if ready else None
    echo_found(warnings_text((planned or resolved).warnings))
    if kind == "json":
        data = selection_data(chosen) | (_plan_data(planned) if planned else {})
        click.echo(json.dumps(data, indent=2, sort_keys=True, ensure_ascii=False))
        return
    click.echo(format_selection(chosen, kind), nl=False)
    if planned and kind == "table":
        click.echo()
        click.echo(format_table(("POOL", "SIZE", "WHY"), pool_rows(planned)), nl=False)
        click.echo()
        click.echo(
            format_table(("CAPABILITY", "PROVIDED BY", "ASKED FOR BY"), _capability_rows(planned)), nl=False
        )
        click.echo()
        click.echo(format_table(("TYPE", "LARGEST", "TYPE HASH"), _type_rows(planned)), nl=False)


def pool_rows(planned: Planned) -> list[tuple[str, str, str]]:
    """Return each pool with its size and what it follows from."""
    runtime, streams = planned.project.runtime, planned.project.streams
    source = "declared in nodes:" if runtime.entities.declared else "pools: or one for each interface"
    rows = [
        ("nodes", str(runtime.entities.nodes.max), source),
        *_entity_rows(planned),
        *_running_rows(planned),
        *_stream_rows(streams),
        *([("line", line.text, line.why)] if (line := planned.project.line) else []),
        (
            "error text",
            f"{runtime.errors.text_size} bytes",
            "errors: text" if runtime.errors.text_size else "errors: code",
        ),
        ("arena", f"{runtime.memory.arena_size} bytes", "memory.arena"),
        *_storage_rows(planned),
        *report_rows(planned.project),
    ]
    if not runtime.entities.declared:
        rows.insert(2, ("names", f"{runtime.entities.name_size} bytes each", "pools.name_size"))
    return rows


def _capability_rows(planned: Planned) -> list[tuple[str, str, str]]:
    """Return each capability of the platform with its provider; nobody: the application defines the functions."""
    return [
        (
            row.capability.name,
            row.provider or f"nobody: define {', '.join(row.capability.functions)}",
            ", ".join(row.asked_by) or "the application, if it wants",
        )
        for row in planned.project.provisions.rows
    ]


def _storage_rows(planned: Planned) -> list[tuple[str, str, str]]:
    """Return the blocks of messages that are sent: what they take on the target, on 32 bits for a host."""
    runtime, models = planned.project.runtime, models_of(planned.project.target.data_model)
    model = models.index(ILP32) if ILP32 in models else 0
    why = "memory.messages of each sender, under its limits; where a function that needs it is called"
    return [
        (
            f"storage of {pool.kind}",
            f"{', '.join(f'{b.count} x {b.elements}' for b in pool.blocks)}: {pool.bytes(model)} bytes",
            why,
        )
        for pool in runtime.memory.message_pools
        if not pool.of_messages
    ]


def _entity_rows(planned: Planned) -> list[tuple[str, str, str]]:
    runtime = planned.project.runtime
    rows = []
    for kind in KINDS:
        each = "pools: or one for each service" if kind.service_type else "pools: or one for each interface"
        places = runtime.entities.places(kind.name).max
        if places or not kind.receives:
            rows.append((kind.key, str(places), "declared in nodes:" if runtime.entities.declared else each))
    if runtime.input.queues:
        slots = f"{runtime.input.queue_slots} slots, {runtime.input.queues_size} bytes"
        shared = "queue_bytes:, else " if runtime.input.queue_mode == "bytes" else ""
        rows.append(("queues", slots, f"{shared}queue: or depth, times the largest sample"))
    return rows


def _running_rows(planned: Planned) -> list[tuple[str, str, str]]:
    runtime = planned.project.runtime
    source = "declared in nodes:, or pools:" if runtime.entities.declared else "pools: or one"
    rows = []
    if runtime.timers.any:
        rows.append(("timers", str(runtime.timers.max), source))
    if runtime.executor.any:
        rows.append(("executors", str(runtime.executor.max), source))
        rows.append(
            (
                "handles",
                f"{runtime.executor.handles_max} each",
                "one for each entity that an executor can run",
            )
        )
        rows.append(
            ("guard conditions", str(runtime.executor.guard_conditions_max), "pools.guard_conditions")
        )
    return rows


def _stream_rows(streams: StreamSizes) -> list[tuple[str, str, str]]:
    arriving = (
        "; larger samples come in fragments, straight into their queue"
        if streams.arrives_in_fragments
        else ""
    )
    arriving += f", and behind {streams.input_free} of them a sample that waits" if streams.input_slot else ""
    fragmented = f", sent in fragments of {streams.mtu} bytes" if streams.fragments else ""
    return [
        (
            "reliable output",
            f"{streams.reliable_slots} x {streams.reliable_slot_size} bytes",
            f"pools.history times the largest reliable message{fragmented}",
        ),
        (
            "best-effort output",
            f"{streams.best_effort_shown} bytes",
            "the largest CREATE or best-effort message"
            + (", times those that wait" if streams.best_effort_slots else ""),
        ),
        ("input", f"{streams.input_size} bytes", f"the largest message of the agent{arriving}"),
    ]


def _type_rows(planned: Planned) -> list[tuple[str, str, str]]:
    rows = []
    for plan in planned.project.types:
        rows.append(
            (str(plan.name), f"{plan.max_encoded_size} bytes" if plan.root else "part", plan.type_hash)
        )
        rows += [
            (f"  {entity.kind} on {entity.topic} of {entity.node}", f"{own.max_encoded_size} bytes", "")
            for own in plan.limit_sets
            for entity in own.entities
        ]
    return rows


def _own_limits(plan: TypePlan) -> list[dict[str, Any]]:
    """Return the entities whose limits are lower than those of their type."""
    return [
        {"kind": e.kind, "node": e.node, "topic": e.topic, "max_encoded_size": own.max_encoded_size}
        for own in plan.limit_sets
        for e in own.entities
    ]


def _plan_data(planned: Planned) -> dict[str, Any]:
    return {
        "capabilities": {
            row.capability.name: {
                "provider": row.provider or None,
                "asked_by": row.asked_by,
                "functions": row.capability.functions if row.of_application else (),
            }
            for row in planned.project.provisions.rows
        },
        "streams": dataclasses.asdict(planned.project.streams),
        "pools": {name: {"size": size, "reason": why} for name, size, why in pool_rows(planned)},
        "types": {
            str(t.name): {
                "hash": t.type_hash,
                "max_encoded_size": t.max_encoded_size,
                "root": t.root,
                "own_limits": _own_limits(t),
            }
            for t in planned.project.types
        },
    }
