# SPDX-License-Identifier: Apache-2.0
"""What a caller selects; it imports nothing, for calls that end before anything is read."""

from __future__ import annotations

from pathlib import Path

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Options:
    """Selection by the caller. Omitted values come from the application file or a default.

    `config`: the application file (None: `microros.yaml` of the current folder where there is one). `profiles` and
    `target` replace those of the file, `components` (`timers`, `-ping`) and `interfaces` (`pkg`, `pkg/msg/Type`) add to
    them. `interface_paths` are searched before the ament index, pip and the shipped set. `agent` is `HOST:PORT` or a
    device. `default_target` is taken where neither file nor `target` names one and a built-in target has this name.
    """

    config: Path | None = None
    profiles: tuple[str, ...] = ()
    interfaces: tuple[str, ...] = ()
    interface_paths: tuple[Path, ...] = ()
    target: str | None = None
    agent: str | None = None
    components: tuple[str, ...] = ()
    default_target: str | None = None
