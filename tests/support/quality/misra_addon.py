# SPDX-License-Identifier: Apache-2.0
"""cppcheck's MISRA addon for many dumps in one process: to start it takes a fifth of the time that a dump takes.

PYTHONPATH=ADDONS python -m tests.support.quality.misra_addon < [[folder, dump], ...]

ADDONS is cppcheck's folder of addons, which import each other by name. The output is a list of what the
addon prints for each dump, in JSON.
"""

from __future__ import annotations

import importlib
import io
import json
import os
import sys
from collections.abc import Callable
from contextlib import redirect_stdout


def report(main: Callable[[], None], folder: str, dump: str) -> str:
    """Return what the addon's `main` prints of `dump` in `folder`, as in a separate process."""
    os.chdir(folder)
    sys.argv = [sys.argv[0], "--cli", dump]
    with redirect_stdout(io.StringIO()) as printed:
        main()
    return printed.getvalue()


if __name__ == "__main__":
    check = importlib.import_module("misra").main
    json.dump([report(check, *place) for place in json.load(sys.stdin)], sys.stdout)
