# SPDX-License-Identifier: Apache-2.0
"""Explanations of diagnostics by id, from explanations.yaml."""

from __future__ import annotations

import re
from pathlib import Path

_FILE = Path(__file__).with_name("explanations.yaml")


def explanations() -> dict[str, str]:
    """Return one or two sentences for each id: when the diagnostic occurs, and what to do about it."""
    import yaml  # only `explain` and the documentation need this file

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    found = yaml.load(_FILE.read_text(encoding="utf-8"), Loader=loader)
    return {str(identity): str(text) for identity, text in found.items()}


def identities() -> tuple[str, ...]:
    """Return the ids that have an explanation, in their order, without reading the explanations."""
    return tuple(re.findall(r"^(MG-\d+):", _FILE.read_text(encoding="utf-8"), re.MULTILINE))
