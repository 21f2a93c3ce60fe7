# SPDX-License-Identifier: Apache-2.0
"""cppcheck's MISRA addon for many dumps in one process: to start it takes a fifth of the time that a dump takes.

PYTHONPATH=ADDONS python -m tests.support.quality.misra_addon < [[folder, dump, known], ...]

ADDONS is cppcheck's folder of addons, which import each other by name. The output is a list of what the addon
prints for each dump, in JSON. `known`: headers that the rules have read in another dump; null: none, and the rules
about all files of a program get what they need of this one.
"""

from __future__ import annotations

import gc
import importlib
import io
import json
import os
import re
import sys
from collections.abc import Callable, Collection
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

_CONFIGURATION = re.compile(r"(?=<dump cfg=)")
_ADDRESS = re.compile(r'"([0-9a-f]{8,}|0x[0-9a-f]+)"')
_END = "</dumps>"


def without_repetitions(dump: str) -> str:
    """Return `dump` without the configurations that differ from an earlier one in nothing but their names.

    cppcheck tries values of macros that the application's microros_config.h then defines. Of eight configurations of
    a file, seven can have the same tokens; the addon finds the same in each of them.
    """
    if dump.count("<dump cfg=") < 2:
        return dump
    head, *configurations = _CONFIGURATION.split(dump.removesuffix("\n").removesuffix(_END))
    different: dict[str, str] = {}
    for configuration in configurations:
        different.setdefault(_content(configuration), configuration)
    return head + "".join(different.values()) + _END


def _content(configuration: str) -> str:
    """Return what the preprocessor left, without the addresses of objects; uses of macros are in no order.

    What follows the tokens, cppcheck derived from them.
    """
    text = _ADDRESS.sub("", configuration.partition("\n")[2].partition("</tokenlist>")[0])
    before, _, rest = text.partition("<macro-usage>")
    macros, _, after = rest.partition("</macro-usage>")
    return "\n".join([before, *sorted(macros.splitlines()), after])


def leave_out(configuration: Any, known: Collection[str]) -> None:
    """Keep the rules from going through the tokens of `known` files; what these declare stays known.

    Most tokens of a dump are of headers that hundreds of files include.
    """
    configuration.tokenlist = [token for token in configuration.tokenlist if token.file not in known]


def report(main: Callable[[], None], folder: str, dump: str) -> str:
    """Return what the addon's `main` prints of `dump` in `folder`, as in a separate process."""
    os.chdir(folder)
    path = Path(dump)
    path.write_text(without_repetitions(path.read_text(encoding="utf-8")), encoding="utf-8")
    sys.argv = [sys.argv[0], "--cli", dump]
    with redirect_stdout(io.StringIO()) as printed:
        main()
    return printed.getvalue()


def reports(places: Collection[tuple[str, str, list[str] | None]]) -> list[str]:
    """Return what the addon prints of each dump."""
    addon = importlib.import_module("misra")
    configuration = importlib.import_module("cppcheckdata").Configuration
    methods = (configuration.setIdMap, dict(vars(addon.MisraChecker)))
    found = []
    for folder, dump, known in places:
        _limit(configuration, addon.MisraChecker, methods, known)
        found.append(report(addon.main, folder, dump))
        gc.collect()
    return found


def _limit(
    configuration: Any, checker: Any, methods: tuple[Any, dict[str, Any]], known: Collection[str] | None
) -> None:
    """Let the addon leave out what is `known`, and the summaries for a whole program where this is a part of one."""
    connect, of_checker = methods
    files = frozenset(known or ())

    def connect_and_leave_out(self: Any, arguments: Any) -> None:
        connect(self, arguments)
        leave_out(self, files)

    configuration.setIdMap = connect_and_leave_out
    for name, method in of_checker.items():
        if name.startswith("_save_ctu_summary_"):
            setattr(checker, name, method if known is None else _nothing)


def _nothing(*_: object) -> None:
    pass


if __name__ == "__main__":
    gc.disable()  # objects of a dump live until its end
    json.dump(reports(json.load(sys.stdin)), sys.stdout)
