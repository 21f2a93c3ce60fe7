# SPDX-License-Identifier: Apache-2.0
"""Whether the agent's core was compiled when this package was installed (hatch_build.py): what it does is the same."""

from __future__ import annotations

from microros_gen.agent import core

SOURCE = ".py"


def core_kind() -> str:
    """Return what the modules that handle each message are: `compiled` or `python`."""
    return "python" if (core.__file__ or "").endswith(SOURCE) else "compiled"
