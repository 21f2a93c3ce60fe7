# SPDX-License-Identifier: Apache-2.0
"""Keeps compiled objects by the content of what they were made from, so that no build compiles the same twice.

An object is found in two steps, without running a preprocessor: the compiler, its arguments and the content of the
source lead to the lists of files that such a compilation has read before; the content of the files of a list leads to
the object. Anything that cannot be read, is damaged or differs means that the compiler runs.

Entries appear complete, by rename, and carry a digest of their bytes: any number of builds may share a store, and one
that was killed leaves nothing that counts.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from microros_gen.documents.files import LARGEST_IMAGE, read_bytes, read_json
from microros_gen.output.runs import cache_folder
from microros_gen.records import dataclass

VARIABLE = "MICROROS_GEN_OBJECTS"
"""`off` in this variable of the environment: nothing is kept, and nothing that was kept is used. A path: the folder."""

LARGEST_STORE = 256 << 20
"""Bytes that a store may take; beyond that, what was not used for longest is removed."""

_KEPT_AFTER_CLEARING = 0.75
_LISTS = 8  # of files read, for one source and command: one for each way in which its headers include others
_JOURNAL = "sizes"
_Digest = Callable[[Sequence[str]], str]


@dataclass(frozen=True)
class Found:
    """A compilation that was found: the files that it read, and its outputs by ending (`.o`, `.d`, `.ci`)."""

    files: list[str]
    outputs: Mapping[str, bytes]


class ObjectStore:
    """The objects in `folder`, which is created when the first one is kept."""

    def __init__(self, folder: Path, largest: int = LARGEST_STORE) -> None:
        """Use `folder`, up to `largest` bytes; nothing is read or written yet."""
        self._folder = folder
        self._largest = largest
        self._added = 0

    @staticmethod
    def of_user(environ: Mapping[str, str]) -> ObjectStore | None:
        """Return the store in the user's cache folder or in that of `environ`; None if it is disabled."""
        chosen = environ.get(VARIABLE, "")
        if chosen == "off":
            return None
        return ObjectStore(Path(chosen) if chosen else cache_folder(environ) / "objects")

    def find(self, key: str, digest: _Digest) -> Found | None:
        """Return the outputs of an earlier compilation with this key and the same contents; None if none exists.

        `key` identifies compiler, arguments and source; `digest` returns that of the current contents of `files`.
        """
        for files in self._lists(key):
            path = self._object(key, digest(files))
            outputs = _unpacked(path)
            if outputs is not None:
                with suppress(OSError):
                    os.utime(path)
                    os.utime(self._list_path(key))
                return Found(files, outputs)
        return None

    def keep(self, key: str, digest: _Digest, found: Found) -> None:
        """Store the outputs of a compilation. Write errors are ignored: the compiler will run again."""
        files = found.files
        others = [other for other in self._lists(key) if other != files]
        lists = json.dumps([files, *others][:_LISTS]).encode()
        packed = _packed(found.outputs)
        with suppress(OSError):
            _write(self._object(key, digest(files)), packed)
            _write(self._list_path(key), lists)
            self._added += len(packed) + len(lists)

    def close(self) -> None:
        """Record how much was added, and remove the least recently used entries if the store is too large."""
        if not self._added:
            return
        line, self._added = f"{self._added}\n".encode(), 0
        with suppress(OSError, ValueError):
            with (self._folder / _JOURNAL).open("ab", buffering=0) as journal:
                journal.write(line)
            sizes = read_bytes(self._folder / _JOURNAL)
            if sum(map(int, sizes.split())) + len(sizes) > self._largest:
                self._clear()

    def _clear(self) -> None:
        """Remove the oldest entries; the journal then starts with the size of those that stay."""
        entries = sorted(self._entries(), key=lambda entry: entry[0], reverse=True)
        total, room = 0, int(self._largest * _KEPT_AFTER_CLEARING)
        for _, size, path in entries:
            if total + size <= room:
                total += size
            else:
                room = total  # nothing that is older than what was removed stays
                with suppress(OSError):
                    path.unlink()
        _write(self._folder / _JOURNAL, f"{total}\n".encode())

    def _entries(self) -> Iterator[tuple[int, int, Path]]:
        """Yield age, size and path of every file except for the journal, including those of interrupted builds."""
        for path in self._folder.glob("??/*"):
            with suppress(OSError):
                found = path.stat()
                yield found.st_mtime_ns, found.st_size, path

    def _lists(self, key: str) -> list[list[str]]:
        try:
            lists = read_json(self._list_path(key))
        except (OSError, ValueError):
            return []
        is_good = isinstance(lists, list) and all(
            isinstance(files, list) and all(isinstance(name, str) for name in files) for files in lists
        )
        return lists if is_good else []

    def _list_path(self, key: str) -> Path:
        return self._folder / key[:2] / f"{key}.json"

    def _object(self, key: str, digest: str) -> Path:
        name = hashlib.sha256(f"{key} {digest}".encode()).hexdigest()
        return self._folder / name[:2] / f"{name}.bin"


def _packed(outputs: Mapping[str, bytes]) -> bytes:
    """Return the bytes of an entry: a line with the digest of the rest, one with endings and sizes, the contents."""
    sizes = json.dumps({ending: len(content) for ending, content in outputs.items()}).encode()
    body = b"".join((sizes, b"\n", *outputs.values()))
    return hashlib.sha256(body).hexdigest().encode() + b"\n" + body


def _unpacked(path: Path) -> dict[str, bytes] | None:
    """Return the contents of an entry by ending; None if it does not exist or is damaged."""
    try:
        digest, _, body = read_bytes(path, LARGEST_IMAGE).partition(b"\n")
    except OSError:
        return None
    if digest.decode("ascii", "replace") != hashlib.sha256(body).hexdigest():
        return None
    sizes, _, contents = body.partition(b"\n")
    outputs, at = {}, 0
    for ending, size in json.loads(sizes).items():
        outputs[ending] = contents[at : at + size]
        at += size
    return outputs


def _write(path: Path, content: bytes) -> None:
    """Write a file that appears complete under its name."""
    path.parent.mkdir(parents=True, exist_ok=True)
    fresh = path.with_suffix(f".{os.urandom(8).hex()}")
    try:
        fresh.write_bytes(content)
        fresh.replace(path)
    except OSError:
        fresh.unlink(missing_ok=True)
        raise
