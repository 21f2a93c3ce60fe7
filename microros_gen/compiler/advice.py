# SPDX-License-Identifier: Apache-2.0
"""What would bring static memory down: built again with one value of the application file changed, and measured."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice
from pathlib import Path

from microros_gen.application.model import Application
from microros_gen.client.plan.changed_lines import changed_lines, joined
from microros_gen.client.plan.levers import history_lever, limit_levers, queue_levers, shared_queue_levers
from microros_gen.compiler.pipeline import Planned, plan_request, render_request
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.image.budget import Advice
from microros_gen.image.folder import Folder, read_folder
from microros_gen.image.report import static_memory
from microros_gen.output.tree import write_tree
from microros_gen.records import dataclass
from microros_gen.toolchain.compile import OBJECTS, compile_project
from microros_gen.toolchain.toolchain import Toolchain, find_toolchain

_LOWERED = 4
"""A limit is tried at a quarter of what it is."""
_LIMITS = 4
_QUEUES = 3
_SHOWN = 5


@dataclass(frozen=True)
class _Trial:
    """A folder in which one plan after another is built; objects that a change does not reach stay."""

    folder: Path
    tools: Toolchain

    def ram(self, planned: Planned) -> int:
        """Return the static memory of the library in the example that is built of this plan, bytes."""
        write_tree(self.folder, render_request(planned))
        compile_project(self.folder, planned.project, self.tools)
        return static_memory(read_folder(self.folder))


def plan_advice(planned: Planned, folder: Folder) -> tuple[Advice, ...]:
    """Return the changes of queues, pools and limits that save most, the largest saving first.

    Each is built as the example of the application and measured; `folder` lends its objects. Nothing where there
    is no tool chain for that.
    """
    try:
        tools = find_toolchain(planned.project.target, os.environ)
        with tempfile.TemporaryDirectory(prefix="microros-gen-") as name:
            trial = _Trial(Path(name) / "out", tools)
            if (folder.path / OBJECTS / "stamps.json").is_file():
                shutil.copytree(folder.path, trial.folder, symlinks=True)
            now = trial.ram(planned)
            found = list(_tried(planned, trial, now))
    except (UserError, OSError):
        return ()
    return tuple(sorted(found, key=lambda a: (-a.saves, a.change, a.place))[:_SHOWN])


def _tried(planned: Planned, trial: _Trial, now: int) -> Iterator[Advice]:
    before = planned.resolved.request.application
    for application in _changes(planned):
        request = replace(planned.resolved.request, application=application)
        try:
            other = plan_request(replace(planned.resolved, request=request), Diagnostics())
        except UserError:
            continue  # a smaller number is not always possible
        saves = now - trial.ram(other)
        if saves > 0:
            changed = joined(changed_lines(before, application))
            yield Advice(changed.line, changed.place, saves, exact=True)


def _changes(planned: Planned) -> Iterator[Application]:
    """Yield what is tried: queues of one sample, or of the bytes of one; a shorter history; limits at a quarter."""
    application = planned.resolved.request.application
    history = history_lever(planned.project)
    tried = [(lever, 1) for lever in islice(queue_levers(planned.project), _QUEUES)]
    tried += islice(shared_queue_levers(planned.project), 1)
    tried += [(history, history.now - 1)] if history is not None else []
    tried += [
        (lever, lever.now // _LOWERED)
        for lever in islice(limit_levers(planned.capacities), _LIMITS)
        if lever.now >= _LOWERED
    ]
    for lever, value in tried:
        yield lever.put(application, value)
