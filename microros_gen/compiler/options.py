# SPDX-License-Identifier: Apache-2.0
"""What a caller selects; it imports nothing, for calls that end before anything is read."""

from __future__ import annotations

from pathlib import Path

from microros_gen.records import dataclass


@dataclass(frozen=True)
class SelectionOptions:
    """What the command line selects; empty means: the application file or the default decides."""

    config: Path | None
    profiles: tuple[str, ...]
    interfaces: tuple[str, ...]
    interface_paths: tuple[Path, ...]
    target: str | None
    agent: str | None
    components: tuple[str, ...] = ()
    default_target: str | None = None
