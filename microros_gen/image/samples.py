# SPDX-License-Identifier: Apache-2.0
"""How large the samples of a type are at most, which an image decodes: larger ones are dropped when they arrive."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from microros_gen.image.folder import Folder

_RECEIVE = ("subscriptions", "services", "clients")
_PLAN = "src/read/xrce_read_plan.c"
_ROW = re.compile(r"^\s*\{[^{}]+\},\s*$", re.MULTILINE)
_DECODER = re.compile(r"^(\w+?)__(msg|srv)__(\w+)__decode$")


class Samples:
    """The queues of an output: each has the size of its largest sample."""

    def __init__(self, folder: Folder) -> None:
        """Take an output. Places without a declared endpoint may have any type: then no size is known."""
        rows = list(_rows(folder.manifest))
        try:
            plan = (folder.path / _PLAN).read_text(encoding="utf-8")
        except OSError:
            plan = ""
        self._sizes: dict[str, int] = {}
        if rows and len(_ROW.findall(plan)) == len(rows):
            for name, size in rows:
                self._sizes[name] = max(self._sizes.get(name, 0), size)

    def size(self, decoder: str) -> int | None:
        """Return the bytes of the largest sample that a generated decoder gets, or any where its type has no endpoint.

        None: unknown.
        """
        match = _DECODER.match(decoder)
        if match is None:
            return None
        name = match[3] if match[2] == "msg" else re.sub(r"_(?:Request|Response|Event)$", "", match[3])
        largest = max(self._sizes.values(), default=None)
        return self._sizes.get(f"{match[1]}/{match[2]}/{name}", largest)


def _rows(manifest: Mapping[str, Any]) -> Iterator[tuple[str, int]]:
    entities: Mapping[str, Any] = manifest.get("entities", {})
    for kind in _RECEIVE:
        for row in entities.get(kind, ()):
            if "slot_size" in row:
                yield row["type"], int(row["slot_size"])
