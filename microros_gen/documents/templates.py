# SPDX-License-Identifier: Apache-2.0
"""The Jinja2 environment of every template: strict, no escaping, no clean-up of the output afterwards."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemBytecodeCache, FileSystemLoader, StrictUndefined

_PACKAGE = Path(__file__).resolve().parent.parent
TEMPLATE_FOLDERS = (_PACKAGE / "templates", _PACKAGE / "components")
"""Where templates are found: `types/struct.h.j2`, `publish/src/rcl_publisher.c.j2`."""


def make_environment(folders: Sequence[Path] = TEMPLATE_FOLDERS, compiled: Path | None = None) -> Environment:
    """Return a new environment that finds templates below `folders`, and keeps them compiled in `compiled`.

    A name that a template uses and its view lacks is an error. The files of an installed package do not
    change during a run, so they are not looked at again once compiled.
    """
    return Environment(
        loader=FileSystemLoader([str(folder) for folder in folders]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
        auto_reload=False,
        bytecode_cache=FileSystemBytecodeCache(str(compiled)) if compiled else None,
    )


@cache
def shared_environment() -> Environment:
    """Return the environment over TEMPLATE_FOLDERS, made once: compiled templates are kept in it."""
    return make_environment()
