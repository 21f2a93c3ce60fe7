# SPDX-License-Identifier: Apache-2.0
"""Plans and output folders of small applications for the tests of components, and C units over their files."""

from __future__ import annotations

import subprocess
from collections.abc import Collection
from pathlib import Path

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from tests.support.paths import TESTS
from tests.support.patience import seconds
from tests.support.runtime.harness import Tree, compile_merged, link, quick

UNITS = TESTS / "runtime" / "c"
SANITIZE = ("-std=gnu99", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all", f"-I{UNITS}")


def planned(folder: Path, text: str) -> compiler.Planned:
    """Return the plan of an application file."""
    config = folder / "microros.yaml"
    config.write_text(text)
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),))
    return compiler.plan(compiler.resolve(compiler.read(options)))


def rendered(folder: Path, text: str) -> Path:
    """Write the output folder and return it."""
    out = folder / "out"
    for name, content in compiler.render(planned(folder, text)).items():
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_bytes(content)
    return out


def program_of(
    out: Path,
    source: str,
    without: Collection[str] = (),
    more: tuple[str, ...] = (),
    by: tuple[str, tuple[str, ...]] | None = None,
) -> Path:
    """Compile a C file of tests/runtime/c with all sources of an output folder (names in `without`: left out).

    `more` are flags of the compiler; `by`: another compiler than the one that takes least time, with its flags.
    """
    sources = [path for path in sorted((out / "src").rglob("*.c")) if path.name not in without]
    compiler, flags = by or quick()
    flags = (*flags, "-std=gnu99", "-Wno-error", *more)
    objects = compile_merged(Tree(out, ()), sources, [UNITS / source], compiler, flags)
    return link(objects, compiler, flags, out / Path(source).stem)


def run(*command: str | Path) -> str:
    """Return what a command prints; AssertionError with its words if it fails."""
    done = subprocess.run(command, capture_output=True, text=True, timeout=seconds(120), check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
