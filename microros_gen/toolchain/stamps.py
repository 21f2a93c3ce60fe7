# SPDX-License-Identifier: Apache-2.0
"""Which objects of an output folder are up to date: digests of the command and of the files that it read."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

from microros_gen.documents.files import read_json
from microros_gen.toolchain.contents import Contents, joined


class Stamps:
    """The stamps of one output folder, stored in `path`."""

    def __init__(self, out: Path, path: Path, contents: Contents) -> None:
        """Read the stamps of the last run; if they cannot be read, nothing is up to date."""
        self._out = out
        self._path = path
        self._contents = contents
        self._stamps: dict[str, dict[str, object]] = {}
        try:
            kept = read_json(path, follow=False)
            self._stamps = kept if isinstance(kept, dict) else {}
        except (OSError, ValueError):
            self._stamps = {}

    def is_fresh(self, name: str, command: str) -> bool:
        """Return whether the object `name` exists and `command` would create it from unchanged files.

        `command` identifies the compiler and its call.
        """
        stamp = self._stamps.get(name)
        if not isinstance(stamp, dict) or not (self._out / name).is_file():
            return False
        files = stamp.get("files")
        return isinstance(files, list) and stamp.get("digest") == self._digest(command, files)

    def record(self, name: str, command: str, files: list[str]) -> None:
        """Record that `command` created the object `name` from `files`."""
        self._stamps[name] = {"digest": self._digest(command, files), "files": files}

    def save(self, names: Iterable[str]) -> None:
        """Write the stamps of these objects."""
        kept = {name: self._stamps[name] for name in names if name in self._stamps}
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self._path.write_text(json.dumps(kept, sort_keys=True), encoding="utf-8", newline="\n")

    def _digest(self, command: str, files: list[str]) -> str:
        return joined([command, self._contents.of_files(files)])
