# SPDX-License-Identifier: Apache-2.0
"""What a decoder raises; nothing else leaves it, whatever the bytes."""

from __future__ import annotations


class MalformedError(Exception):
    """Bytes that are no valid message. `kind` is a short stable name to count by, `detail` is for people."""

    def __init__(self, kind: str, detail: str = "") -> None:
        super().__init__(f"{kind}: {detail}" if detail else kind)
        self.kind = kind
        self.detail = detail
