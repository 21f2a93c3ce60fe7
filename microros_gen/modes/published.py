# SPDX-License-Identifier: Apache-2.0
"""Which statuses on /diagnostics a node of an application file can have."""

from __future__ import annotations

from microros_gen.application.model import Application
from microros_gen.documents.shipped import COMPONENTS, profiles_folder

LIBRARY_STATUSES = (
    "executor",
    "timers",
    "stack",
    "reset",
    "supply",
    "tasks",
    "session",
    "lifecycle",
    "log",
    "time",
    "errors",
)
"""What the library reports of itself, each as far as it is in the image."""
_SESSION_TASKS = ("session", "line_and_session")
"""Names of the task of the session where the application file does not name it."""
_TYPE = "diagnostic_msgs/msg/DiagnosticArray"


def published_of(application: Application, node: int) -> tuple[str, ...] | None:
    """Return the names of the statuses of a node, by its index; None: they are not known.

    Without `diagnosis:` in the file, with a component or profile from outside, which may report more counters,
    and with a publisher of such messages, they are not.
    """
    declared = application.diagnosis
    if declared is None or _is_open(application):
        return None
    checks = tuple(check.name for check in declared.checks if check.node == node)
    if node:
        return checks
    callbacks = (f"callback {callback.name}" for callback in declared.callbacks)
    tasks = (f"task {name}" for name in (*(task.name for task in application.tasks), *_SESSION_TASKS))
    return (*checks, *callbacks, *(tasks if application.tasks else ()), *LIBRARY_STATUSES)


def _is_open(application: Application) -> bool:
    """Return whether something else can publish statuses, too."""
    profiles = profiles_folder()
    is_shipped = all(
        (profiles / f"{profile.name}.yaml").is_file() for profile in application.profiles
    ) and all((COMPONENTS / change.name).is_dir() for change in application.components if change.add)
    endpoints = (endpoint for node in application.nodes for endpoint in node.endpoints)
    return not is_shipped or any(e.type == _TYPE and not e.of_the_library for e in endpoints)
