# SPDX-License-Identifier: Apache-2.0
"""The file of pre-shared keys: in each line a client key and 64 hexadecimal digits; `#` begins a comment."""

from __future__ import annotations

import re
import stat
from collections.abc import Mapping
from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source, Span

LARGEST_BYTES = 1 << 20
_LINE = re.compile(r"\s*(0[xX][0-9a-fA-F]{1,8}|[0-9]{1,10})\s+([0-9a-fA-F]{64})\s*(?:#.*)?")
_EXAMPLE = "0xA1B2C3D4 and 64 hexadecimal digits; `openssl rand -hex 32` makes a key"


def read_keys(path: Path, diagnostics: Diagnostics, span: Span | None = None) -> Mapping[int, bytes]:
    """Return the key of 32 bytes of each client; what is wrong with the file goes to `diagnostics`.

    No text of a diagnostic has a part of a key. `span` is where the file is named.
    """
    try:
        mode = path.stat().st_mode
        if not stat.S_ISREG(mode) or path.stat().st_size > LARGEST_BYTES:
            diagnostics.error(
                f"{path} is no regular file of at most 1 MiB", span, "Name a file of keys", id="MG-3264"
            )
            return {}
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is no text"
        diagnostics.error(f"{path} cannot be read: {reason}", span, "Name a file of keys", id="MG-3274")
        return {}
    if mode & (stat.S_IRWXG | stat.S_IRWXO):
        message = f"other users may open the file of keys {path} (mode {stat.S_IMODE(mode):03o})"
        diagnostics.error(message, span, f"chmod 600 {path}", id="MG-3265")
    return _parse(str(path), text, diagnostics)


def _parse(name: str, text: str, diagnostics: Diagnostics) -> Mapping[int, bytes]:
    hidden = Source(name, "\n".join(_hide(line) for line in text.splitlines()))
    found: dict[int, bytes] = {}
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        place = Span(hidden, number, 1)
        match = _LINE.fullmatch(line)
        key = int(match.group(1), 0) if match and not re.fullmatch("0[0-9]+", match.group(1)) else 0
        if match is None or not 0 < key <= 0xFFFF_FFFF:
            diagnostics.error(
                "no client key with a key of 32 bytes", place, f"Write {_EXAMPLE}", id="MG-3266"
            )
        elif key in found:
            diagnostics.error(
                f"duplicate client key {key:#010x}", place, "Remove one of the lines", id="MG-3267"
            )
        elif len(set(match.group(2))) == 1:
            diagnostics.error(
                f"the key of {key:#010x} is not random", place, "openssl rand -hex 32", id="MG-3268"
            )
        else:
            found[key] = bytes.fromhex(match.group(2))
    if not found and not any(line.split("#")[0].strip() for line in text.splitlines()):
        diagnostics.error(f"no key in {name}", None, f"Write {_EXAMPLE}", id="MG-3272")
    return found


def _hide(line: str) -> str:
    """Return a line without what may be a part of a key."""
    begin = re.match(r"\s*(?:0[xX][0-9a-fA-F]{1,8}|[0-9]{1,10})(?=\s)", line)
    return f"{begin.group()} …" if begin else "…"
