# SPDX-License-Identifier: Apache-2.0
"""The file that tells a build what a run was made from, in the form of make, which Ninja and CMake read, too."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.output.runs import tool_files

_ESCAPED = str.maketrans({" ": "\\ ", "#": "\\#", "$": "$$"})


def write_depfile(path: Path, target: Path, inputs: Iterable[Path]) -> None:
    """Write to `path` that `target` depends on those of `inputs` that exist and on the tool's own files.

    One path a line, absolute. A file that holds the same already is not touched. Raises UserError where it cannot
    be written.
    """
    read = {str(p.absolute()) for p in (*inputs, *tool_files()) if p.exists()}
    lines = [f"{_escaped(str(target.absolute()))}:", *(f"  {_escaped(name)}" for name in sorted(read))]
    content = (" \\\n".join(lines) + "\n").encode()
    try:
        if path.is_file() and path.read_bytes() == content:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
        temporary.write_bytes(content)
        temporary.replace(path)
    except OSError as error:
        what = f"cannot write the depfile {path}: {error.strerror or error}"
        raise UserError(
            [Diagnostic(what, hint="Choose another place with --depfile", id="MG-8001")]
        ) from error


def _escaped(path: str) -> str:
    return path.replace(os.sep, "/").translate(_ESCAPED)
