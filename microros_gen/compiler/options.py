# SPDX-License-Identifier: Apache-2.0
"""What a caller selects; it imports nothing, for calls that end before anything is read."""

from __future__ import annotations

from pathlib import Path

from microros_gen.records import dataclass


@dataclass(frozen=True)
class Options:
    """Selection by the caller; omitted values come from the application file or a default.

    `config`: path of the application file (None: microros.yaml of the current folder, if it exists). `profiles` and
    `target` replace those of the file; `components` (`timers`, `-ping`) and `interfaces` (`pkg`, `pkg/msg/Type`) add
    to it. `interface_paths` are searched before the ament index, pip and the shipped interfaces.
    `agent` is `HOST:PORT` or a device path. `default_target` applies if neither the file nor `target` names a target
    and a built-in target has this name. `selftest`: the output has the sources of the self-test, too.
    """

    config: Path | None = None
    profiles: tuple[str, ...] = ()
    interfaces: tuple[str, ...] = ()
    interface_paths: tuple[Path, ...] = ()
    target: str | None = None
    agent: str | None = None
    components: tuple[str, ...] = ()
    default_target: str | None = None
    selftest: bool = False
