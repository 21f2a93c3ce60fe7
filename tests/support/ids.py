# SPDX-License-Identifier: Apache-2.0
"""What a test of words compares: a diagnostic without its id, which has tests of its own."""

from __future__ import annotations

import re


def without_id(text: str) -> str:
    """Return `text` without the ids of diagnostics (` [MG-3012]`)."""
    return re.sub(r" \[MG-\d{4}\]", "", text)
