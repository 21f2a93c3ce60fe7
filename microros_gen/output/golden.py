# SPDX-License-Identifier: Apache-2.0
"""Compares what would be generated with a golden copy, as unified diffs."""

from __future__ import annotations

import difflib
import json
from collections.abc import Iterator, Mapping
from pathlib import Path

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.output.tree import BUILD_FOLDERS, JOURNAL, MANIFEST


def golden_differences(golden: Path, files: Mapping[str, bytes]) -> tuple[str, ...]:
    """Return one unified diff for each file that differs, is missing or is too many; empty when all agree.

    The generator's version in the manifest is left out. Raises UserError when `golden` is not a folder.
    """
    if not golden.is_dir():
        raise UserError(
            [
                Diagnostic(
                    f"no golden folder {golden}", hint="Write it with --update and commit it", id="MG-8002"
                )
            ]
        )
    held = dict(_golden_files(golden))
    diffs = []
    for name in sorted(set(held) | set(files)):
        old, new = held.get(name), files.get(name)
        if name == MANIFEST:
            old, new = without_version(old), without_version(new)
        if old != new:
            diffs.append(_diff(name, old, new))
    return tuple(diffs)


def without_version(manifest: bytes | None) -> bytes | None:
    """Return the manifest without the generator's version (unchanged where it is not a manifest)."""
    if manifest is None:
        return None
    try:
        data = json.loads(manifest)
        data["generator"].pop("version", None)
    except (ValueError, KeyError, TypeError, AttributeError):
        return manifest
    return (json.dumps(data, indent=2, sort_keys=True, ensure_ascii=False) + "\n").encode()


def _golden_files(golden: Path) -> Iterator[tuple[str, bytes]]:
    for path in sorted(golden.rglob("*")):
        name = path.relative_to(golden).as_posix()
        if path.is_file() and name != JOURNAL and name.split("/")[0] not in BUILD_FOLDERS:
            yield name, path.read_bytes()


def _diff(name: str, old: bytes | None, new: bytes | None) -> str:
    before = [] if old is None else old.decode("utf-8", "replace").splitlines(keepends=True)
    after = [] if new is None else new.decode("utf-8", "replace").splitlines(keepends=True)
    from_name = "/dev/null" if old is None else f"golden/{name}"
    to_name = "/dev/null" if new is None else f"generated/{name}"
    text = "".join(
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
        for line in difflib.unified_diff(before, after, from_name, to_name)
    )
    return text or f"--- {from_name}\n+++ {to_name}\n(an empty file on one side)\n"
