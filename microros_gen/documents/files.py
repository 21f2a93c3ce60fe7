# SPDX-License-Identifier: Apache-2.0
"""Reads files that somebody else wrote: only regular files, and only up to a size that such a file can have.

A FIFO never ends, /dev/zero never stops, and a text of gigabytes is an accident or an attack. Each is an OSError
with its reason as `strerror`, so whoever reports a file that cannot be read reports these too.
"""

from __future__ import annotations

import errno
import json
import os
import stat
from collections.abc import Callable
from pathlib import Path
from typing import Any

LARGEST_TEXT = 1 << 20
"""Bytes of a text that is read (interface, YAML, C source); the largest interface of ROS 2 has 30 kB."""

LARGEST_RECORD = 64 << 20
"""Bytes of a record that this tool wrote itself (manifest, stamps) or of a map file."""

LARGEST_IMAGE = 1 << 30
"""Bytes of an image or library that a compiler made, debugging information included."""

_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
_NO_LINK = getattr(os, "O_NOFOLLOW", 0)


def read_bytes(path: Path, largest: int = LARGEST_TEXT, follow: bool = True) -> bytes:
    """Return the bytes of a regular file of at most `largest` bytes.

    `follow` false: a symbolic link is refused instead of followed. Raises OSError, with the path as `filename`.
    """
    try:
        found = path.stat() if follow else path.lstat()
    except ValueError as error:  # a NUL in the name
        raise OSError(errno.EINVAL, str(error), str(path)) from error
    _check_regular(path, found)  # opening a device may already do something
    with os.fdopen(os.open(path, _FLAGS if follow else _FLAGS | _NO_LINK), "rb") as file:
        _check_regular(path, os.fstat(file.fileno()))
        data = file.read(largest + 1)
    if len(data) > largest:
        raise OSError(errno.EFBIG, f"it is larger than {largest} bytes", str(path))
    return data


def read_text(
    path: Path,
    errors: str = "strict",
    largest: int = LARGEST_TEXT,
    follow: bool = True,
    encoding: str = "utf-8",
) -> str:
    """Return the text of a regular file, each line end as LF. Raises OSError, and UnicodeDecodeError if strict."""
    text = read_bytes(path, largest, follow).decode(encoding, errors)
    return text.replace("\r\n", "\n").replace("\r", "\n")


def read_json(path: Path, largest: int = LARGEST_RECORD, follow: bool = True) -> Any:
    """Return the value of a JSON file. Raises OSError, and ValueError for what is no JSON or nested too deeply."""
    try:
        return json.loads(read_text(path, largest=largest, follow=follow))
    except RecursionError as error:
        raise ValueError(f"{path} is nested too deeply") from error


def reason_of(error: OSError | ValueError) -> str:
    """Return why a file could not be read, without its path."""
    return error.strerror or str(error) if isinstance(error, OSError) else str(error)


def is_file(path: Path) -> bool:
    """Return whether a regular file has this name; a name that no file can have is none."""
    return _is(path, stat.S_ISREG)


def is_folder(path: Path) -> bool:
    """Return whether a folder has this name; a name that no folder can have is none."""
    return _is(path, stat.S_ISDIR)


def _is(path: Path, judge: Callable[[int], bool]) -> bool:
    try:
        return judge(path.stat().st_mode)
    except (OSError, ValueError):
        return False


def _check_regular(path: Path, found: os.stat_result) -> None:
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    if stat.S_ISLNK(found.st_mode):
        raise OSError(errno.ELOOP, "it is a symbolic link", str(path))
    if not stat.S_ISREG(found.st_mode):
        raise OSError(errno.EINVAL, "it is not a regular file", str(path))
