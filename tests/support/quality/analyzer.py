# SPDX-License-Identifier: Apache-2.0
"""How long the analyzer of clang follows the paths of a function, and which blocks of code it reaches in that time."""

from __future__ import annotations

import re
from pathlib import Path

from tests.support.quality.corpus import Tree, run

NODES = 30_000
"""States of a program that the analyzer looks at for each function.

By default, it gives up after 225,000 of them, 10 s for one file of types; it reaches no further block after a tenth.
"""
_MARK = "clang_analyzer_warnIfReached();"
_OPENS = re.compile(r"(\)|else|do) \{$")
_NO_STATEMENT = ("else", "}", "case", "default", "while")


def limit(nodes: int) -> tuple[str, ...]:
    """Return the options of clang, and of clang-tidy after `--`."""
    return ("-Xclang", "-analyzer-config", "-Xclang", f"max-nodes={nodes}")


def marked(code: str) -> str:
    """Return `code`, formatted by clang-format, with a call that tells where the analyzer comes at each block."""
    lines = code.splitlines()
    found = [f"void {_MARK.replace('()', '(void)')}"]
    is_in_function = False
    for line, following in zip(lines, [*lines[1:], ""], strict=True):
        found.append(line)
        is_in_function = (is_in_function or line.endswith(") {") or line == "{") and line != "}"
        begins = _OPENS.search(line) is not None and "switch (" not in line
        ends = line.startswith(" ") and line.strip() == "}"
        if is_in_function and (begins or ends) and not following.strip().startswith(_NO_STATEMENT):
            found.append(_MARK)
    return "\n".join(found) + "\n"


def reached(tree: Tree, source: str, nodes: int) -> set[str]:
    """Return the lines with a mark in `source` that the analyzer comes to with `nodes` for each function."""
    copy = Path(source).with_suffix(".marked.c")
    text = marked((tree.out / source).read_text(encoding="utf-8"))
    (tree.out / copy).write_text(text, encoding="utf-8")
    checker = ("-Xclang", "-analyzer-checker=debug.ExprInspection")
    flags = ("-std=c99", "-Iinclude", *limit(nodes), *checker, "-o", "/dev/null")
    done = run(["clang", "--analyze", *flags, copy.as_posix()], tree.out)
    assert done.returncode == 0, done.stderr
    return set(re.findall(r"marked\.c:(\d+):\d+: warning: REACHABLE", done.stderr))
