# SPDX-License-Identifier: Apache-2.0
"""What `doctor` finds out: a fact about this machine, what needs it, and the command that provides it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from enum import Enum
from pathlib import Path

from microros_gen.records import dataclass

_DEBIAN = Path("/etc/debian_version")


class State(Enum):
    """`BROKEN`: it is there, but does not work."""

    OK = "ok"
    MISSING = "missing"
    BROKEN = "broken"


@dataclass(frozen=True)
class Finding:
    """`remedy` is the command to run where the state is not OK; `fix` does the same, None: only its user may."""

    name: str
    state: State
    needed_for: str
    detail: str = ""
    remedy: str = ""
    fix: Callable[[], None] | None = None


def install(packages: Sequence[str], debian: Path = _DEBIAN) -> str:
    """Return the command that installs Debian packages; elsewhere a sentence with their names."""
    names = " ".join(packages)
    return f"apt-get install {names}" if debian.exists() else f"install what Debian calls {names}"
