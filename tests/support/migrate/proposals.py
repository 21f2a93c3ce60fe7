# SPDX-License-Identifier: Apache-2.0
"""What an application file declares, without names that sources do not have."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from microros_gen.application.model import Application
from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source

Init = Callable[..., tuple[int, str, str]]
Entity = tuple[str, str, str, str]


def application_in(path: Path) -> Application:
    """Return the application of a file; it must hold."""
    diagnostics = Diagnostics()
    application = parse_application(Source(str(path), path.read_text(encoding="utf-8")), diagnostics)
    diagnostics.check()
    assert application is not None
    return application


def entities_of(application: Application) -> set[Entity]:
    """Return nodes, endpoints with their reliability, and timers by their period."""
    found: set[Entity] = set()
    for node in application.nodes:
        found.add(("node", node.name, node.namespace, str(node.domain_id)))
        found |= {(e.kind, e.topic, e.type, e.qos.reliability) for e in node.endpoints}
        found |= {("timer", str(timer.period_us), "", "") for timer in node.timers}
    return found


def undecided_in(path: Path) -> list[str]:
    """Return the lines of an application file that somebody must look at."""
    return [line.strip("# ") for line in path.read_text(encoding="utf-8").splitlines() if "UNDECIDED" in line]
