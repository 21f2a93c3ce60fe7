# SPDX-License-Identifier: Apache-2.0
"""Folders of what ships with the tool and is selected by name: profiles, targets, components."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]

TARGETS = _PACKAGE / "targets"
COMPONENTS = _PACKAGE / "components"


def profiles_folder() -> Path:
    """Return the folder of the profiles that ship with the tool: in a wheel, else in the repository."""
    installed = _PACKAGE / "profiles"
    return installed if installed.is_dir() else _PACKAGE.parent / "profiles"
