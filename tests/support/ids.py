# SPDX-License-Identifier: Apache-2.0
"""Diagnostics without their id, for tests that compare texts; the ids have separate tests."""

from __future__ import annotations

import re


def without_id(text: str) -> str:
    """Return `text` without the ids of diagnostics (` [MG-3012]`)."""
    return re.sub(r" \[MG-\d{4}\]", "", text)
