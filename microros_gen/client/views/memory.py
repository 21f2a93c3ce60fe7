# SPDX-License-Identifier: Apache-2.0
"""The buffers of a plan and their sizes, as README.md of an output folder and packages show them."""

from __future__ import annotations

from microros_gen.client.plan.project import Project


def buffer_sizes(project: Project) -> tuple[tuple[str, int], ...]:
    """Return each kind of buffer with its bytes: streams, the serial line, queues."""
    streams, incoming, board = project.runtime.streams, project.runtime.input, project.board
    line = board.ring_size + board.output_size if board.has_serial_driver else 0
    return (
        ("reliable output", streams.reliable_slots * streams.reliable_slot_size),
        ("best-effort output", streams.best_effort_bytes),
        ("input", incoming.buffer_size),
        *((("serial line, both directions", line),) if line else ()),
        *((("queues", incoming.queues_size),) if incoming.queues else ()),
    )
