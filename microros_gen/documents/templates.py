# SPDX-License-Identifier: Apache-2.0
"""The Jinja2 environment of every template: strict, no escaping, no clean-up of the output afterwards."""

from __future__ import annotations

import marshal
import os
from collections.abc import Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path

from jinja2 import BytecodeCache, Environment, FileSystemLoader, StrictUndefined
from jinja2.bccache import Bucket

_PACKAGE = Path(__file__).resolve().parent.parent
TEMPLATE_FOLDERS = (_PACKAGE / "templates", _PACKAGE / "components", _PACKAGE / "platform")
"""Where templates are found: `types/struct.h.j2`, `publish/src/rcl_publisher.c.j2`, `os/NAME/src/image.ld.j2`."""


def make_environment(folders: Sequence[Path] = TEMPLATE_FOLDERS, compiled: Path | None = None) -> Environment:
    """Return a new environment that finds templates below `folders`.

    `compiled` is a file with what earlier runs have compiled; `keep_compiled` writes it. A name that a template uses
    and its view lacks is an error. The files of an installed package do not change during a run, so they are not
    looked at again once compiled.
    """
    return Environment(
        loader=FileSystemLoader([str(folder) for folder in folders]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
        optimized=False,  # folding constants takes longer than it saves: most templates are printed once
        auto_reload=False,
        bytecode_cache=_CompiledTemplates(compiled) if compiled else None,
    )


def keep_compiled(environment: Environment) -> None:
    """Write what `environment` has compiled to the file that it was made with. A failure loses only time."""
    if isinstance(environment.bytecode_cache, _CompiledTemplates):
        environment.bytecode_cache.save()


class _CompiledTemplates(BytecodeCache):
    """All compiled templates in one file: Jinja's own cache writes one for each, which takes as long as compiling."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._known: dict[str, bytes] = {}
        self._has_more = False
        with suppress(OSError, ValueError, EOFError, TypeError):
            self._known = dict(marshal.loads(path.read_bytes()))

    def load_bytecode(self, bucket: Bucket) -> None:
        """Give `bucket` what is known; it checks the text of the template and the version of Python itself."""
        known = self._known.get(bucket.key)
        if isinstance(known, bytes):
            with suppress(ValueError, EOFError, TypeError):
                bucket.bytecode_from_string(known)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Take over what was compiled now."""
        self._known[bucket.key] = bucket.bytecode_to_string()
        self._has_more = True

    def save(self) -> None:
        """Replace the file where there is more than it has."""
        if not self._has_more:
            return
        temporary = self._path.with_suffix(f".{os.getpid()}.tmp")
        with suppress(OSError):
            self._path.parent.mkdir(parents=True, exist_ok=True)
            temporary.write_bytes(marshal.dumps(self._known))
            temporary.replace(self._path)


@cache
def shared_environment() -> Environment:
    """Return the environment over TEMPLATE_FOLDERS, made once: compiled templates are kept in it."""
    return make_environment()
