# SPDX-License-Identifier: Apache-2.0
"""Golden copies of a dozen applications that differ in what matters.

tests/golden/<name>.yaml is an application; tests/golden/<name>/ holds what is rendered for it, unless an application
before it has the same file. Of all other files, copies of files of components above all and headers of what is not
selected, hashes.txt has a hash each.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import microros_gen
from microros_gen import compiler
from microros_gen.diagnostics import Source
from microros_gen.interfaces.find import shipped_folder
from microros_gen.output.golden import without_version
from microros_gen.output.tree import MANIFEST
from tests.support.paths import TESTS

GOLDEN = TESTS / "golden"
HASHES = "hashes.txt"
DATA = ("components", "platform", "templates")
"""Folders of the package whose files are copied or rendered to the output."""


@dataclass(frozen=True)
class Copies:
    """Every file below tests/golden but the applications, by its path there."""

    files: Mapping[str, bytes]

    def write(self, folder: Path = GOLDEN) -> int:
        """Make `folder` hold these files and no others; return how many were written or removed."""
        held = held_files(folder)
        changed = {name for name in held.keys() | self.files if held.get(name) != self.files.get(name)}
        for name in sorted(changed):
            path = folder / name
            if name in self.files:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(self.files[name])
            else:
                path.unlink()
        for path in sorted(folder.rglob("*"), reverse=True):
            if path.is_dir() and not any(path.iterdir()):
                path.rmdir()
        return len(changed)


def applications(folder: Path = GOLDEN) -> list[str]:
    """Return the names of the applications."""
    return sorted(path.stem for path in folder.glob("*.yaml"))


def held_files(folder: Path = GOLDEN) -> dict[str, bytes]:
    """Return the files below `folder`, by their path there, without the applications."""
    paths = [path for path in folder.rglob("*") if path.is_file() and path.parent != folder]
    found = {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}
    return found | ({HASHES: (folder / HASHES).read_bytes()} if (folder / HASHES).is_file() else {})


def output_of(name: str, folder: Path = GOLDEN) -> dict[str, bytes]:
    """Return what is generated for an application, from the definitions that ship with the tool."""
    source = Source("microros.yaml", (folder / f"{name}.yaml").read_text(encoding="utf-8"))
    request = compiler.read_source(source, folder, compiler.Options(interface_paths=(shipped_folder(),)))
    files = dict(compiler.render(compiler.plan(compiler.resolve(request))))
    manifest = without_version(files[MANIFEST])
    assert manifest is not None
    return files | {MANIFEST: manifest}


def make_copies(folder: Path = GOLDEN) -> Copies:
    """Generate every application, and tell rendered files from those that are copied or known already."""
    stored: dict[str, bytes] = {}
    first: dict[tuple[str, str], str] = {}
    others: dict[tuple[str, str], list[str]] = {}
    for name in applications(folder):
        for path, content in output_of(name, folder).items():
            key = (path, _digest(content))
            if key[1] in _plain_files() or key in first or _refuses(content):
                others.setdefault(key, []).append(name)
            else:
                first[key] = name
                stored[f"{name}/{path}"] = content
    lines = [f"{digest} {path}: {' '.join(names)}\n" for (path, digest), names in sorted(others.items())]
    return Copies(stored | {HASHES: "".join(lines).encode()})


def _refuses(content: bytes) -> bool:
    """Whether it is the header of a component that is not selected: one line that names the key to add."""
    return content.startswith(b"#error")


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


@cache
def _plain_files() -> frozenset[str]:
    """Return the digests of the files that are copied as they are."""
    return frozenset(_digest(path.read_bytes()) for path in _data_files() if path.suffix != ".j2")


def _data_files() -> Iterator[Path]:
    package = Path(microros_gen.__file__).parent
    for folder in DATA:
        yield from (path for path in (package / folder).rglob("*") if path.is_file())
