# SPDX-License-Identifier: Apache-2.0
"""Whether files can exist on Windows, and on file systems that ignore case.

Windows takes a name for a device whatever follows its first dot, in upper and lower case (Microsoft, "Naming Files,
Paths, and Namespaces").
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import fields

from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.interfaces.interface_set import Interface
from microros_gen.typesupport.plan.names import type_files

_DEVICES = frozenset(
    ("con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in "123456789"))
)


def device_in(path: str) -> str | None:
    """Return the part of `path` (POSIX) that Windows takes for a device; None: no part."""
    return next((p for p in path.split("/") if p.partition(".")[0].rstrip(" ").lower() in _DEVICES), None)


def equal_but_for_case(paths: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Yield pairs of `paths` that are one file where case does not count: folders of different spelling, too."""
    seen: dict[str, str] = {}
    for path in sorted(set(paths)):
        parts = path.split("/")
        for end in range(1, len(parts) + 1):
            part = "/".join(parts[:end])
            other = seen.setdefault(part.lower(), part)
            if other != part:
                yield other, part


def check_file_names(interfaces: Iterable[Interface], diagnostics: Diagnostics) -> None:
    """Warn of types whose files Windows cannot have."""
    for interface in interfaces:
        files = type_files(interface.name)
        paths = (getattr(files, field.name) for field in fields(files))
        device = next((d for d in map(device_in, paths) if d is not None), None)
        if device is not None:
            message = (
                f"Windows cannot have the file '{device}' of {interface.name}: it is the name of a device"
            )
            hint = "Rename the type or its package if somebody builds on Windows"
            diagnostics.warning(message, Span(interface.source, 1, 1), hint, id="MG-9242")
