# SPDX-License-Identifier: Apache-2.0
"""Which folders of unit tests a change concerns: those of the packages that changed, and of all that import these."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable, Mapping, Sequence

from tests.support.paths import PACKAGE, ROOT

_IMPORT = re.compile(r"^\s*(?:from|import) microros_gen\.(\w+)", re.MULTILINE)
READERS: Mapping[str, tuple[str, ...]] = {
    "components": ("selection", "client", "compiler"),
    "templates": ("typesupport", "client", "compiler"),
    "idl": ("interfaces", "typesupport"),
    "targets": ("platform", "compiler"),
}
"""Packages whose tests look at files of a folder that are no Python."""

_ALWAYS = "quality"
"""Rules for all files."""


def imports() -> Mapping[str, frozenset[str]]:
    """Return, for each package of the tool, the packages that its modules import."""
    found: dict[str, frozenset[str]] = {}
    for folder in sorted(path for path in PACKAGE.iterdir() if path.is_dir()):
        texts = (path.read_text(encoding="utf-8") for path in folder.rglob("*.py"))
        found[folder.name] = frozenset(name for text in texts for name in _IMPORT.findall(text))
    return found


def users(package: str, imported: Mapping[str, frozenset[str]]) -> set[str]:
    """Return a package and all that import it, or a package that does."""
    found, new = {package}, {package}
    while new:
        new = {name for name, others in imported.items() if others & new} - found
        found |= new
    return found


def concerned(
    paths: Iterable[str], imported: Mapping[str, frozenset[str]], units: Sequence[str]
) -> tuple[str, ...]:
    """Return the folders of tests to run, all of `units` where a path says nothing about that.

    `paths` are below the repository. A folder that is not in `units` is `docs`, or not there.
    """
    found = {_ALWAYS}
    for path in paths:
        some = _of_path(path, imported)
        if some is None:
            return tuple(units)
        found |= some
    return tuple(name for name in (*units, "docs") if name in found)


def _of_path(path: str, imported: Mapping[str, frozenset[str]]) -> set[str] | None:
    top, *rest = path.split("/")
    if top == "microros_gen" and len(rest) > 1:
        is_python = path.endswith(".py")
        return set(READERS[rest[0]]) if rest[0] in READERS and not is_python else users(rest[0], imported)
    if top == "tests" and len(rest) > 1:
        is_shared = rest[0] == "support" and len(rest) == 2
        return None if is_shared else {"compiler" if rest[0] == "golden" else rest[rest[0] == "support"]}
    if top in ("docs", "README.md", "mkdocs.yml"):
        return {"docs"}
    if top == "profiles":
        return {"selection", "compiler"}
    return set() if top in ("examples", "cmake", ".ci", "LICENSE") else None


def changed() -> list[str]:
    """Return the paths of what is not committed, or else of the last commit; nothing where git does not say."""
    for command in (("diff", "--name-only", "HEAD"), ("diff", "--name-only", "HEAD~1")):
        words = ["git", "-c", "core.quotePath=false"]
        done = subprocess.run([*words, *command], cwd=ROOT, capture_output=True, text=True, check=False)
        others = [*words, "ls-files", "--others", "--exclude-standard"]
        fresh = subprocess.run(others, cwd=ROOT, capture_output=True, text=True, check=False)
        if found := [*done.stdout.splitlines(), *fresh.stdout.splitlines()]:
            return found
    return []
