# SPDX-License-Identifier: Apache-2.0
"""The memory that the system leaves to this process: that of the machine, of its container, or of its service."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

_OWN_GROUP = Path("/proc/self/cgroup")
_GROUPS = Path("/sys/fs/cgroup")
_MACHINE = Path("/proc/meminfo")


def system_bytes(own: Path = _OWN_GROUP, groups: Path = _GROUPS, machine: Path = _MACHINE) -> int | None:
    """Return the bytes that all processes of this control group may take (cgroup-v2); None: the system does not say."""
    found = [number for path in _limit_files(own, groups) if (number := _number(_text(path))) is not None]
    total = [line.split()[1] for line in _text(machine).splitlines() if line.startswith("MemTotal:")]
    kib = _number(total[0]) if total else None
    return min([*found, *([kib * 1024] if kib is not None else [])], default=None)


def _limit_files(own: Path, groups: Path) -> Iterator[Path]:
    """Yield the files with the limits of the own group and of those around it."""
    line = next((line for line in _text(own).splitlines() if line.startswith("0::/")), "0::/")
    group = groups / line.removeprefix("0::/")
    for folder in (group, *group.parents):
        if folder.is_relative_to(groups):
            yield folder / "memory.max"


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="ascii", errors="replace")
    except OSError:
        return ""


def _number(text: str) -> int | None:
    """Return the number of a text; None if it is another text, such as `max`."""
    return int(text) if text.strip().isdecimal() else None
