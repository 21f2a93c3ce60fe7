# SPDX-License-Identifier: Apache-2.0
"""Finds and reads the application file."""

from __future__ import annotations

from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.files import read_text

APPLICATION_FILE = "microros.yaml"


def read_application(config: Path | None, folder: Path, diagnostics: Diagnostics) -> Source | None:
    """Return the text of `config`, else of `microros.yaml` in `folder` where there is one, else None."""
    path = config if config is not None else folder / APPLICATION_FILE
    if config is None and not path.exists():
        return None
    shown = str(config) if config is not None else APPLICATION_FILE
    try:
        return Source(shown, read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is not UTF-8 text"
        hint = "Give the path of an application file with -c, or none to use --profile alone"
        if isinstance(error, UnicodeDecodeError):
            hint = "Save it as UTF-8"
        diagnostics.error(f"cannot read the application file '{shown}': {reason}", hint=hint, id="MG-3001")
        return None
