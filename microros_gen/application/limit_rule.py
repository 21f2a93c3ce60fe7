# SPDX-License-Identifier: Apache-2.0
"""A limit that an application declares: how long a string or a sequence may be."""

from __future__ import annotations

from microros_gen.diagnostics import Span
from microros_gen.records import dataclass


@dataclass(frozen=True)
class LimitRule:
    """One capacity rule. `path` is `*`, a type (`sensor_msgs/msg/Imu`) or a type and a field path below it.

    `path` for a field is `("sensor_msgs/msg/Imu", "header", "frame_id")`. `string` counts bytes without the
    terminator, `sequence` counts elements; None where the rule says nothing of it. `single` is true for a
    field that got one number (`position: 6`): then both hold it, and it means whichever of the two the field
    is; for a sequence of strings it is ambiguous. In the own limits of an endpoint, `*` holds for all of its
    message.
    """

    path: tuple[str, ...]
    string: int | None = None
    sequence: int | None = None
    span: Span | None = None
    single: bool = False
