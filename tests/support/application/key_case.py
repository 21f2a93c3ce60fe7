# SPDX-License-Identifier: Apache-2.0
"""What a test knows of a key of the application file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from microros_gen.application.model import Application


@dataclass(frozen=True)
class KeyCase:
    """`good` parses to an application whose `read` gives `value`; `bad` is refused at `place` with `reported`."""

    good: str
    read: Callable[[Application], Any]
    value: Any
    bad: str
    place: str
    reported: str
