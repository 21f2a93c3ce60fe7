# SPDX-License-Identifier: Apache-2.0
"""The output folder on the disk: who owns it, and how a run replaces its files.

Every file is replaced atomically and only when its bytes differ. Before the first change a journal names all
files that the run will write; it is removed after the manifest is written. So an interrupted run leaves each
file old or new, and the next run knows which files are its own.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from microros_gen.diagnostics import Diagnostic, UserError

MANIFEST = "manifest.json"
JOURNAL = ".microros-gen-journal.json"
TEMPORARY_SUFFIX = ".microros-gen-tmp"
# Written by `build`, never part of the rendered tree.
BUILD_FOLDERS = ("lib", "bin", ".build")


@dataclass(frozen=True)
class WriteReport:
    """What a run did to the folder: relative POSIX paths, sorted."""

    written: tuple[str, ...]
    unchanged: tuple[str, ...]
    removed: tuple[str, ...]


def write_tree(out: Path, files: Mapping[str, bytes]) -> WriteReport:
    """Make `out` hold exactly `files` (relative POSIX path → bytes; the manifest among them).

    Raises UserError when the folder cannot be written or holds something that this tool did not write.
    """
    with _told_as_user_error(out):
        owned = _owned_files(out)
        out.mkdir(parents=True, exist_ok=True)
        changed = tuple(sorted(p for p in files if _differs(out / p, files[p])))
        stale = tuple(sorted(p for p in owned if p not in files and (out / p).is_file()))
        if changed or stale or (out / JOURNAL).exists():
            _replace_all(out, files, changed, stale, owned)
    unchanged = tuple(sorted(set(files) - set(changed)))
    return WriteReport(changed, unchanged, stale)


def write_files(folder: Path, files: Mapping[str, bytes]) -> tuple[str, ...]:
    """Write `files` (relative POSIX path → bytes) into a folder of the user's; return those that changed, sorted.

    Nothing is removed. Raises UserError when the folder cannot be written.
    """
    with _told_as_user_error(folder):
        changed = tuple(sorted(name for name in files if _differs(folder / name, files[name])))
        for name in changed:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            _replace(folder / name, files[name])
    return changed


def check_owned(out: Path) -> None:
    """Raise UserError when `out` exists and holds something that this tool did not write."""
    with _told_as_user_error(out):
        _owned_files(out)


def owned_paths(folder: Path) -> frozenset[str]:
    """Return the files of a folder that this tool wrote, from its manifest and journal."""
    manifest, journal = _ours(folder / MANIFEST), _ours(folder / JOURNAL)
    owned = set(_names(manifest.get("outputs"))) | set(_names(journal.get("files")))
    return frozenset(owned | {MANIFEST} if manifest else owned)


def _owned_files(out: Path) -> frozenset[str]:
    if out.exists() and not out.is_dir():
        raise UserError([Diagnostic(f"{out} is not a folder", hint="Choose another output folder with -o")])
    if not out.exists():
        return frozenset()
    owned = owned_paths(out)
    if not owned and not (out / JOURNAL).exists() and any(out.iterdir()):
        found = min(p.name for p in out.iterdir())
        raise UserError(
            [
                Diagnostic(
                    f"the output folder {out} holds files that microros-gen did not write ({found}, …)",
                    hint="Choose an empty or a new folder with -o; nothing was changed",
                )
            ]
        )
    return owned


def _ours(path: Path) -> dict[str, object]:
    """Return the JSON mapping of a file that this tool wrote, else an empty one."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    generator = data.get("generator") if isinstance(data, dict) else None
    return data if isinstance(generator, dict) and generator.get("name") == "microros-gen" else {}


def _names(listed: object) -> Iterator[str]:
    if isinstance(listed, (dict, list)):
        yield from (name for name in listed if isinstance(name, str) and _is_inside(name))


def _is_inside(name: str) -> bool:
    path = PurePosixPath(name)
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts


def _differs(path: Path, content: bytes) -> bool:
    try:
        return path.stat().st_size != len(content) or path.read_bytes() != content
    except FileNotFoundError:
        return True


def _replace_all(
    out: Path,
    files: Mapping[str, bytes],
    changed: tuple[str, ...],
    stale: tuple[str, ...],
    owned: frozenset[str],
) -> None:
    journal = {"files": sorted(set(files) | owned), "generator": {"name": "microros-gen"}}
    _replace(out / JOURNAL, (json.dumps(journal, indent=1) + "\n").encode())
    _remove_temporaries(out, set(files) | owned)
    for folder in sorted({(out / name).parent for name in changed}):
        folder.mkdir(parents=True, exist_ok=True)
    for name in changed:
        if name != MANIFEST:
            _replace(out / name, files[name])
    for name in stale:
        (out / name).unlink(missing_ok=True)
        _remove_empty_parents(out, out / name)
    if MANIFEST in changed:
        _replace(out / MANIFEST, files[MANIFEST])
    (out / JOURNAL).unlink()


def _replace(path: Path, content: bytes) -> None:
    temporary = path.with_name(f".{path.name}.{os.getpid()}{TEMPORARY_SUFFIX}")
    try:
        temporary.write_bytes(content)
        temporary.replace(path)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise


def _remove_temporaries(out: Path, names: set[str]) -> None:
    for folder in sorted({(out / n).parent for n in names} | {out}):
        if folder.is_dir():
            for leftover in folder.glob(f".*{TEMPORARY_SUFFIX}"):
                leftover.unlink(missing_ok=True)


def _remove_empty_parents(out: Path, path: Path) -> None:
    for parent in path.parents:
        if parent == out or any(parent.iterdir()):
            return
        parent.rmdir()


@contextmanager
def _told_as_user_error(out: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        where = error.filename or out
        raise UserError(
            [
                Diagnostic(
                    f"cannot write the output folder {out}: {error.strerror or error} ({where})",
                    hint="Make it writable or choose another with -o",
                )
            ]
        ) from error
