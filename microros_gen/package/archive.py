# SPDX-License-Identifier: Apache-2.0
"""Archives of a package: the same files give the same bytes (order, times and modes are fixed)."""

from __future__ import annotations

import gzip
import io
import tarfile
import zipfile
from collections.abc import Mapping

_MODE = 0o644
_ZIP_EPOCH = (1980, 1, 1, 0, 0, 0)
"""The earliest time that a ZIP archive can hold."""
_UNIX = 3
_LEVEL = 9


def archive(files: Mapping[str, bytes], root: str, kind: str) -> bytes:
    """Return an archive, `zip` or `tar.gz`, of `files` (relative POSIX path → bytes) below the folder `root`."""
    named = [(f"{root}/{name}", content) for name, content in sorted(files.items())]
    return _zip(named) if kind == "zip" else _tar(named)


def _zip(named: list[tuple[str, bytes]]) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as container:
        for name, content in named:
            entry = zipfile.ZipInfo(name, _ZIP_EPOCH)
            entry.create_system = _UNIX
            entry.external_attr = (0o100000 | _MODE) << 16
            container.writestr(entry, content, zipfile.ZIP_DEFLATED, _LEVEL)
    return buffer.getvalue()


def _tar(named: list[tuple[str, bytes]]) -> bytes:
    buffer = io.BytesIO()
    with (
        gzip.GzipFile("", "wb", _LEVEL, buffer, mtime=0) as packed,
        tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as container,
    ):
        for name, content in named:
            entry = tarfile.TarInfo(name)
            entry.size, entry.mode, entry.mtime = len(content), _MODE, 0
            container.addfile(entry, io.BytesIO(content))
    return buffer.getvalue()
