# SPDX-License-Identifier: Apache-2.0
"""What waits for a client, as a worker process reports it."""

from __future__ import annotations

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Queue:
    """The output that waits on reliable streams: for an acknowledgement, or to be sent."""

    messages: int = 0
    bytes: int = 0
    """With the samples that are kept in case that the client opens a new session."""
    fill: float = 0.0
    """0 to 1; 1: the window of messages without acknowledgement is full, or the space of those to be sent."""
