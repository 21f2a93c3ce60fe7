# SPDX-License-Identifier: Apache-2.0
"""Sizes of stacks that `microros-gen stacks` found in an image, for the tasks with `stack: auto`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from microros_gen.application.model import Application
from microros_gen.diagnostics import Diagnostics, Source, Span, reads
from microros_gen.documents.files import is_file, read_text, reason_of
from microros_gen.documents.tree_values import entries, int_of
from microros_gen.documents.yaml_tree import MappingNode, parse_yaml

SUFFIX = ".stacks.yaml"
"""In place of the suffix of the application file."""
LARGEST = 1 << 30
"""Bytes that a stack may have."""


def stack_path(config: Path) -> Path:
    """Return where the sizes for an application file are."""
    return config.with_suffix(SUFFIX)


def with_stacks(
    application: Application, config: Path, diagnostics: Diagnostics
) -> tuple[Application, Source | None]:
    """Return the application with the sizes of the file, and that as it was read; None: it does not exist, or no task
    asks for it.

    A file that cannot be read, or is no mapping of tasks to bytes, is an error.
    """
    automatic = [task for task in application.tasks if task.stack_auto]
    path = stack_path(config)
    if not automatic or not is_file(path):
        return application, None
    try:
        source = Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        message = f"cannot read the sizes of stacks in '{path}': {reason_of(error)}"
        diagnostics.error(
            message, automatic[0].stack_span, "Write it again: `microros-gen stacks`", id="MG-3291"
        )
        return application, None
    sizes = parse_stacks(source, diagnostics)
    tasks = (replace(t, stack=sizes.get(t.name)) if t.stack_auto else t for t in application.tasks)
    return replace(application, tasks=tuple(tasks)), source


@reads
def parse_stacks(source: Source, diagnostics: Diagnostics) -> dict[str, int]:
    """Return the bytes of each task's stack; what is wrong goes to `diagnostics`."""
    found = Diagnostics()
    tree = parse_yaml(source, found)
    sizes = {entry.key: int_of(entry.value) or 0 for entry in entries(tree)}
    wrong = [entry for entry in entries(tree) if not 0 < sizes[entry.key] <= LARGEST]
    if not found.has_errors() and (wrong or not isinstance(tree, MappingNode)):
        span = wrong[0].value.span if wrong else Span(source, 1, 1)
        message = "the sizes of stacks are no mapping of tasks to bytes"
        found.error(message, span, "Write the file again: `microros-gen stacks`", id="MG-3292")
    diagnostics.extend(found)
    return {} if found.has_errors() else sizes
