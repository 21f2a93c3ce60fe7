# SPDX-License-Identifier: Apache-2.0
"""CMake files in ROS 2 wheels that name folders of the machine on which the wheels were built.

The exported targets of generated Python modules have the paths of Python's and numpy's headers, below /opt/python of
the manylinux image.
"""

from __future__ import annotations

import re
import subprocess
import sys
import sysconfig
from pathlib import Path

FILES = "share/*/cmake/*_pyExport.cmake"
_FOREIGN = re.compile(r'/opt/python/[^;"]*/include(?:/[^;"]*)?')


def faulty_files(prefix: Path) -> tuple[Path, ...]:
    """Return the CMake files below `prefix` that name a header folder that does not exist here, sorted."""
    return tuple(path for path in sorted(prefix.glob(FILES)) if _missing(path.read_text(encoding="utf-8")))


def fix_files(prefix: Path) -> int:
    """Let these files name the folders of this Python and its numpy; return how many were changed.

    Raises OSError where a file cannot be written or numpy is missing.
    """
    files = faulty_files(prefix)
    if not files:
        return 0
    python, numpy = sysconfig.get_path("include"), _numpy_headers()
    for path in files:
        text = _FOREIGN.sub(
            lambda m: numpy if "/numpy/" in m[0] else python, path.read_text(encoding="utf-8")
        )
        path.write_text(text, encoding="utf-8", newline="\n")
    return len(files)


def _missing(text: str) -> bool:
    return any(not Path(name).is_dir() for name in _FOREIGN.findall(text))


def _numpy_headers() -> str:
    code = "import numpy; print(numpy.get_include())"
    done = subprocess.run([sys.executable, "-c", code], text=True, capture_output=True, check=False)
    if done.returncode != 0:
        raise OSError("numpy, whose headers the files name, is not installed: pip install numpy")
    return done.stdout.strip()
