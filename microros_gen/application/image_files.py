# SPDX-License-Identifier: Apache-2.0
"""Numbers that were found in an image for the tasks: the size of the stack with `stack: auto`, and with `lock: auto`
the instructions for which each holds the library's lock."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from microros_gen.application.model import Application
from microros_gen.diagnostics import Diagnostics, Source, Span, reads
from microros_gen.documents.files import is_file, read_text, reason_of
from microros_gen.documents.tree_values import entries, int_of
from microros_gen.documents.yaml_tree import MappingNode, parse_yaml
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Kind:
    """A file with a number for each task. Its `suffix` replaces that of the application file, `command` writes it; no
    number is above `largest`. `what` and `unit` are for messages."""

    suffix: str
    command: str
    largest: int
    what: str
    unit: str


STACKS = Kind(".stacks.yaml", "stacks", 1 << 30, "sizes of stacks", "bytes")
LOCKS = Kind(".locks.yaml", "locks", 10**12, "holds of the lock", "instructions")


def file_path(config: Path, kind: Kind) -> Path:
    """Return where the numbers for an application file are."""
    return config.with_suffix(kind.suffix)


def image_paths(application: Application, config: Path) -> Iterator[Path]:
    """Yield the files that the tasks ask for, whether they exist or not."""
    if any(task.stack_auto for task in application.tasks):
        yield file_path(config, STACKS)
    if any(task.lock_auto for task in application.tasks):
        yield file_path(config, LOCKS)


def with_image_files(
    application: Application, config: Path, diagnostics: Diagnostics
) -> tuple[Application, dict[str, bytes]]:
    """Return the application with the numbers of the files, and these by what they have; those that do not exist, and
    that no task asks for, are left out.

    A file that cannot be read, or is no mapping of tasks to numbers, is an error.
    """
    spans = {t.name: t.stack_span for t in application.tasks if t.stack_auto}
    sizes, stacks = _read(spans, config, STACKS, diagnostics)
    spans = {t.name: t.lock_span for t in application.tasks if t.lock_auto}
    holds, locks = _read(spans, config, LOCKS, diagnostics)
    tasks = (replace(t, stack=sizes.get(t.name)) if t.stack_auto else t for t in application.tasks)
    tasks = (replace(t, lock_instructions=holds.get(t.name, 0)) if t.lock_auto else t for t in tasks)
    return replace(application, tasks=tuple(tasks)), {**stacks, **locks}


def _read(
    spans: Mapping[str, Span | None], config: Path, kind: Kind, diagnostics: Diagnostics
) -> tuple[dict[str, int], dict[str, bytes]]:
    """Return the numbers of the file and its content; `spans` are where the tasks ask for it."""
    path = file_path(config, kind)
    if not spans or not is_file(path):
        return {}, {}
    try:
        source = Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        message = f"cannot read the {kind.what} in '{path}': {reason_of(error)}"
        span = next(iter(spans.values()))
        diagnostics.error(message, span, f"Write it again: `microros-gen {kind.command}`", id="MG-3291")
        return {}, {}
    return parse_numbers(source, kind, diagnostics), {kind.what: source.text.encode()}


@reads
def parse_numbers(source: Source, kind: Kind, diagnostics: Diagnostics) -> dict[str, int]:
    """Return the number of each task; what is wrong goes to `diagnostics`."""
    found = Diagnostics()
    tree = parse_yaml(source, found)
    numbers = {entry.key: int_of(entry.value) or 0 for entry in entries(tree)}
    wrong = [entry for entry in entries(tree) if not 0 < numbers[entry.key] <= kind.largest]
    if not found.has_errors() and (wrong or not isinstance(tree, MappingNode)):
        span = wrong[0].value.span if wrong else Span(source, 1, 1)
        message = f"the {kind.what} are no mapping of tasks to {kind.unit}"
        found.error(message, span, f"Write the file again: `microros-gen {kind.command}`", id="MG-3292")
    diagnostics.extend(found)
    return {} if found.has_errors() else numbers
