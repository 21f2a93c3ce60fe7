# SPDX-License-Identifier: Apache-2.0
"""The exception of all decoders: whatever the bytes, they raise no other."""

from __future__ import annotations


class MalformedError(Exception):
    """Received bytes are not a valid message. `kind` is a short stable name for counters, `detail` is for people."""

    def __init__(self, kind: str, detail: str = "") -> None:
        super().__init__(f"{kind}: {detail}" if detail else kind)
        self.kind = kind
        self.detail = detail
