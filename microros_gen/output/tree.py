# SPDX-License-Identifier: Apache-2.0
"""The output folder on the disk: who owns it, and how a run replaces its files.

Every file is replaced atomically and only when its bytes differ. Before the first change a journal names all
files that the run will write; it is removed after the manifest is written. So an interrupted run leaves each
file old or new, and the next run knows which files are its own.

Nothing outside the folder is read, written or removed, whatever lies in it: names in the manifest are checked, no
symbolic link inside the folder is followed, and a file that is no longer selected is removed only if its content is
what this tool wrote.
"""

from __future__ import annotations

import hashlib
import json
import os
import stat
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path, PurePosixPath
from threading import Thread

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.documents.files import read_bytes, read_json
from microros_gen.records import dataclass

MANIFEST = "manifest.json"
JOURNAL = ".microros-gen-journal.json"
TEMPORARY_SUFFIX = ".microros-gen-tmp"
# Written by `build`, never part of the rendered tree.
BUILD_FOLDERS = ("lib", "bin", ".build")
_LARGEST_FILE = 1 << 30
_WORTH_A_THREAD = 64


@dataclass(frozen=True)
class WriteReport:
    """What a run did to the folder: relative POSIX paths, sorted.

    `kept`: no longer selected, and not removed since somebody else changed them.
    """

    written: tuple[str, ...]
    unchanged: tuple[str, ...]
    removed: tuple[str, ...]
    kept: tuple[str, ...] = ()


def write_tree(out: Path, files: Mapping[str, bytes]) -> WriteReport:
    """Make `out` hold exactly `files` (relative POSIX path → bytes; the manifest among them).

    Raises UserError when the folder cannot be written, holds something that this tool did not write, or a symbolic
    link where one of its folders belongs; then nothing was changed.
    """
    with _as_user_error(out):
        owned = _owned_files(out)
        _refuse_links(out, files)
        out.mkdir(parents=True, exist_ok=True)
        changed = _changed(out, files) if any(out.iterdir()) else tuple(sorted(files))
        others = sorted(p for p in owned if p not in files and os.path.lexists(out / p) and not _link(out, p))
        stale = tuple(p for p in others if _is_as_written(out / p, owned[p]))
        if changed or stale or (out / JOURNAL).exists():
            _replace_all(out, files, changed, stale, owned)
    unchanged = tuple(sorted(set(files) - set(changed)))
    return WriteReport(changed, unchanged, stale, tuple(sorted(set(others) - set(stale))))


def check_build_folders(out: Path) -> None:
    """Raise UserError when compiling in `out` would write through a symbolic link, or into a FIFO or device."""
    for name in BUILD_FOLDERS:
        for folder, folders, files in os.walk(out / name):
            _refuse_links(
                out, ((Path(folder) / f).relative_to(out).as_posix() for f in (*folders, *files)), True
            )
            for place in (Path(folder) / name for name in files):
                if place.exists() and not place.is_file():
                    message = f"{place} is not a regular file"
                    raise UserError(
                        [Diagnostic(message, hint="Remove it; nothing was compiled", id="MG-8005")]
                    )
    _refuse_links(out, BUILD_FOLDERS, True)


def write_files(folder: Path, files: Mapping[str, bytes]) -> tuple[str, ...]:
    """Write `files` (relative POSIX path → bytes) into a folder of the user's; return those that changed, sorted.

    Nothing is removed. Raises UserError when the folder cannot be written.
    """
    with _as_user_error(folder):
        changed = _changed(folder, files)
        for name in changed:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            _replace(f"{folder}/{name}", files[name])
    return changed


def check_owned(out: Path) -> None:
    """Raise UserError when `out` exists and holds something that this tool did not write."""
    with _as_user_error(out):
        _owned_files(out)


def _owned_by(folder: Path) -> dict[str, frozenset[str]]:
    """Return the files of a folder that this tool wrote, each with the digests of what it wrote."""
    manifest, journal = _ours(folder / MANIFEST), _ours(folder / JOURNAL)
    owned: dict[str, frozenset[str]] = {MANIFEST: frozenset()} if manifest else {}
    for name, digests in (*_named(manifest.get("outputs")), *_named(journal.get("files"))):
        owned[name] = owned.get(name, frozenset()) | digests
    return owned


def _owned_files(out: Path) -> dict[str, frozenset[str]]:
    if out.exists() and not out.is_dir():
        raise UserError(
            [Diagnostic(f"{out} is not a folder", hint="Choose another output folder with -o", id="MG-8006")]
        )
    if not out.exists():
        return {}
    owned = _owned_by(out)
    if not owned and not (out / JOURNAL).exists() and any(out.iterdir()):
        found = min(p.name for p in out.iterdir())
        raise UserError(
            [
                Diagnostic(
                    f"the output folder {out} holds files that microros-gen did not write ({found}, …)",
                    hint="Choose an empty or a new folder with -o; nothing was changed",
                    id="MG-8007",
                )
            ]
        )
    return owned


def _ours(path: Path) -> dict[str, object]:
    """Return the JSON mapping of a file that this tool wrote, else an empty one."""
    try:
        data = read_json(path, follow=False)
    except (OSError, ValueError):
        return {}
    generator = data.get("generator") if isinstance(data, dict) else None
    return data if isinstance(generator, dict) and generator.get("name") == "microros-gen" else {}


def _named(listed: object) -> Iterator[tuple[str, frozenset[str]]]:
    """Yield each name of a manifest or journal that lies in the folder, with its digest or list of digests."""
    for name, entry in listed.items() if isinstance(listed, dict) else ():
        digests = entry if isinstance(entry, list) else [entry]
        if isinstance(name, str) and _is_inside(name):
            yield name, frozenset(d for d in digests if isinstance(d, str))


def _is_inside(name: str) -> bool:
    path = PurePosixPath(name)
    is_plain = not any(c in name for c in "\\:\0")  # what is a separator, a drive or the end elsewhere
    return is_plain and bool(path.parts) and not path.is_absolute() and ".." not in path.parts


def _link(out: Path, name: str) -> Path | None:
    """Return the first folder on the way to `name` that is a symbolic link."""
    parents = [out / parent for parent in reversed(PurePosixPath(name).parents) if parent.parts]
    return next((parent for parent in parents if parent.is_symlink()), None)


def _refuse_links(out: Path, names: Iterable[str], themselves: bool = False) -> None:
    """Raise UserError where a folder on the way to one of `names` (or the name itself) is a symbolic link."""
    folders = set(names) if themselves else _folders_of(names)
    found = {link for folder in folders if (link := _link(out, f"{folder}/file")) is not None}
    if found:
        hint = "Remove it; nothing outside the output folder is touched, and nothing was changed"
        raise UserError(
            [Diagnostic(f"{link} is a symbolic link", hint=hint, id="MG-8008") for link in sorted(found)]
        )


def _is_as_written(path: Path, digests: frozenset[str]) -> bool:
    try:
        return hashlib.sha256(read_bytes(path, _LARGEST_FILE, follow=False)).hexdigest() in digests
    except OSError:
        return False


def _folders_of(names: Iterable[str]) -> set[str]:
    """Return the folders below the output folder that hold these files: far fewer than files."""
    return {name.rpartition("/")[0] for name in names} - {""}


def _changed(folder: Path, files: Mapping[str, bytes]) -> tuple[str, ...]:
    """Return the names of the files that are not there with these bytes, sorted."""
    base = f"{folder}/"
    return tuple(sorted(name for name, content in files.items() if _differs(base + name, content)))


def _differs(path: str, content: bytes) -> bool:
    try:
        found = os.lstat(path)
        if not stat.S_ISREG(found.st_mode) or found.st_size != len(content):
            return True
        return read_bytes(Path(path), _LARGEST_FILE, follow=False) != content
    except FileNotFoundError:
        return True


def _replace_all(
    out: Path,
    files: Mapping[str, bytes],
    changed: tuple[str, ...],
    stale: tuple[str, ...],
    owned: Mapping[str, frozenset[str]],
) -> None:
    digests = {name: {*owned.get(name, ()), hashlib.sha256(files[name]).hexdigest()} for name in changed}
    listed = {name: sorted(digests.get(name, owned.get(name, ()))) for name in sorted({*files, *owned})}
    journal = {"files": listed, "generator": {"name": "microros-gen"}}
    _replace(f"{out}/{JOURNAL}", (json.dumps(journal) + "\n").encode())
    _remove_temporaries(out, [f for f in _folders_of(listed) if _link(out, f"{f}/file") is None])
    for folder in sorted(_folders_of(changed)):
        (out / folder).mkdir(parents=True, exist_ok=True)
    _replace_each(out, [name for name in changed if name != MANIFEST], files)
    for name in stale:
        (out / name).unlink(missing_ok=True)
        _remove_empty_parents(out, out / name)
    if MANIFEST in changed:
        _replace(f"{out}/{MANIFEST}", files[MANIFEST])
    (out / JOURNAL).unlink()


def _replace_each(out: Path, names: Sequence[str], files: Mapping[str, bytes]) -> None:
    """Write these files, half of many in a second thread: the system takes most of the time, and has two processors."""
    failures: list[BaseException] = []

    def write(part: Sequence[str]) -> None:
        try:
            for name in part:
                _replace(f"{out}/{name}", files[name])
        except BaseException as failure:  # an interruption, too: neither thread may be left alone
            failures.append(failure)

    half = len(names) // 2 if len(names) >= _WORTH_A_THREAD else 0
    other = Thread(target=write, args=(names[:half],))
    if half:
        other.start()
    write(names[half:])
    if half:
        other.join()
    if failures:
        raise failures[0]


def _replace(path: str, content: bytes) -> None:
    """Write a file so that it appears whole. A Path for each of a thousand files takes longer than to write them."""
    folder, _, name = path.rpartition("/")
    temporary = f"{folder}/.{name}.{os.getpid()}{TEMPORARY_SUFFIX}"
    try:
        with open(temporary, "wb", buffering=0) as file:  # noqa: PTH123
            written = file.write(content)
            while written < len(content):
                written += file.write(content[written:])
        os.replace(temporary, path)  # noqa: PTH105
    except BaseException:
        with suppress(OSError):
            os.unlink(temporary)  # noqa: PTH108
        raise


def _remove_temporaries(out: Path, folders: Iterable[str]) -> None:
    for folder in (out, *(out / name for name in sorted(folders))):
        if folder.is_dir():
            for leftover in folder.glob(f".*{TEMPORARY_SUFFIX}"):
                leftover.unlink(missing_ok=True)


def _remove_empty_parents(out: Path, path: Path) -> None:
    for parent in path.parents:
        if parent == out or any(parent.iterdir()):
            return
        parent.rmdir()


@contextmanager
def _as_user_error(out: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        where = error.filename or out
        raise UserError(
            [
                Diagnostic(
                    f"cannot write the output folder {out}: {error.strerror or error} ({where})",
                    hint="Make it writable or choose another with -o",
                    id="MG-8009",
                )
            ]
        ) from error
