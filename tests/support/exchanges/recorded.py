# SPDX-License-Identifier: Apache-2.0
"""Which applications of the corpus are recorded, and how one is built and run."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path

from tests.support.exchanges.exchange import WIRES, record
from tests.support.paths import TESTS
from tests.support.quality.corpus import APPLICATIONS, Tree, make_tree
from tests.support.runtime.merged import merged
from tests.support.runtime.serving_agent import ServingAgent

HERE = TESTS / "exchanges"
GOLDEN = HERE / "golden"
SAME = GOLDEN / "same.txt"
"""`NAME: OTHER` for each application with the exchange of another one, whose file both have."""
DURATION_MS = 2000
_LEFT_OUT = ("timers_ticked",)
"""The application itself drives its hardware timer."""
_ELSEWHERE = ("target:", "{type: custom", "{type: canfd", "system:", "tasks:", "time_source", "seal:")
"""Images of boards, those whose transport is functions of the application, those on a bus, whose frames
tests/e2e/test_canfd.py sees, those with links to other boards, whose messages tests/runtime/test_peer.py sees, those
with tasks, whose order is the scheduler's, those that ask for the time, which the scripted agent does not tell and
tests/runtime/c/unit_time_source.c simulates, and those with a seal, whose
messages are random (tests/runtime/test_seal.py).
"""


def recorded() -> tuple[str, ...]:
    """Return the names of the applications that are recorded: images of this host with a transport of the library."""
    return tuple(
        name
        for name, text in APPLICATIONS.items()
        if name not in _LEFT_OUT and not any(word in text for word in _ELSEWHERE)
    )


def build_clock(folder: Path) -> Path:
    """Compile what is loaded before the C library."""
    library = folder / "still_time.so"
    source = HERE / "still_time.c"
    flags = ["-std=gnu99", "-O1", "-Wall", "-Wextra", "-Werror", "-fPIC", "-shared"]
    subprocess.run(["gcc", *flags, "-o", library, source, "-ldl"], check=True)
    return library


def exchange_of(name: str, folder: Path, still_time: Path) -> str:
    """Generate, compile and run the application `name`; return its exchange, a line for each message."""
    tree = make_tree(name, folder)
    manifest = json.loads((tree.out / "manifest.json").read_text(encoding="utf-8"))
    image = folder / name / "image"
    includes = ["include", *sorted({str(Path(s).parent) for s in tree.sources if s.startswith("src/")})]
    # tcc compiles all of it in a tenth of a second, and its messages do not depend on the compiler.
    flags = [*(f"-I{include}" for include in includes), "-o", str(image)]
    subprocess.run(["tcc", *flags, *_few_units(tree), "-lpthread"], cwd=tree.out, check=True)
    agent = ServingAgent(preconfigured="preconfigured" in name)
    lines = record(image, still_time, _transport(manifest), DURATION_MS, agent)
    return "".join(f"{line}\n" for line in lines)


def _few_units(tree: Tree) -> Iterator[str]:
    """Write and yield units that include the sources of the library, and those of the example as they are.

    Messages for the log have the names of files, which are those of a build in the folder.
    """
    library = [source for source in tree.sources if source.startswith("src/")]
    for number, sources in enumerate(merged(tree.out / source for source in library)):
        unit = tree.out / f"unit_{number}.c"
        names = (source.relative_to(tree.out).as_posix() for source in sources)
        unit.write_text("".join(f'#include "{name}"\n' for name in names), encoding="utf-8")
        yield unit.name
    yield from (source for source in tree.sources if source not in library)


def _transport(manifest: dict[str, dict[str, str]]) -> str:
    transport = manifest["transport"]["type"]
    assert transport in WIRES
    return transport


def exchanges(folder: Path) -> Iterator[tuple[str, str]]:
    """Yield the name and the exchange of each recorded application."""
    still_time = build_clock(folder)
    for name in recorded():
        yield name, exchange_of(name, folder, still_time)


def files(names_and_texts: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Return the files of the recordings by name: a text that several have is stored once."""
    found: dict[str, str] = {}
    first: dict[str, str] = {}
    same = []
    for name, text in sorted(names_and_texts):
        if text in first:
            same.append(f"{name}: {first[text]}\n")
        else:
            first[text] = name
            found[f"{name}.txt"] = text
    return {**found, SAME.name: "".join(same)}


def held_exchanges() -> dict[str, str]:
    """Return the recording of each application."""
    held = {p.stem: p.read_text(encoding="utf-8") for p in GOLDEN.glob("*.txt") if p != SAME}
    lines = SAME.read_text(encoding="utf-8").splitlines()
    return {**held, **{name: held[other] for name, other in (line.split(": ") for line in lines)}}
