# SPDX-License-Identifier: Apache-2.0
"""Renders the C runtime for a hand-made plan, compiles it with a fixture, and counts what is in it."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.values import Values
from microros_gen.client.views.components import render_components
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.templates import shared_environment
from microros_gen.interfaces.types import TypeName
from microros_gen.platform.find import read_target
from microros_gen.platform.provide import provide
from microros_gen.platform.target import Target
from microros_gen.selection.component import Catalogue
from microros_gen.selection.component_sources import component_files
from microros_gen.selection.find_components import load_catalogue
from microros_gen.selection.model import ChosenComponent, Selection
from microros_gen.toolchain.toolchain import LIBRARY_FLAGS, WARNINGS
from tests.support.objects.cache import real
from tests.support.objects.made import digest, headers_digest, made, source_contents, version
from tests.support.paths import TESTS
from tests.support.runtime.merged import merged, text_of

FIXTURES = TESTS / "runtime" / "c"
STRING = TypeName("std_msgs", "msg", "String")
CORE = (
    "base",
    "support",
    "session",
    "memory",
    "rosidl_runtime",
    "node",
    "publish",
    "write",
    "qos",
    "cdr",
    "port_posix",
)
PORTS = ("port_posix_sockets", "port_posix")
SANITIZER = "clang" if shutil.which("clang") else "gcc"
"""Who compiles clients with sanitizers: clang takes two thirds of gcc's time for it. Unit tests use both."""
SANITIZE = ("-g0", "-O0", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
EVERYWHERE = "MICROROS_TEST_SANITIZERS"
"""`all`: every program of the runtime under sanitizers, as in `make system`."""


def components(plan: RuntimePlan, liveliness: str = "ping") -> tuple[str, ...]:
    """Return the components that the resolver selects for `plan`."""
    names = [*CORE, f"entities_{plan.creation.entities}", f"transport_{plan.transport.kind}"]
    names = [name for name in names if name != "publish" or plan.entities.publisher_places]
    names = [
        name for name in names if name != "write" or plan.entities.publisher_places or plan.entities.serves
    ]
    framed = plan.transport.kind == "serial" or (
        plan.transport.kind == "custom" and plan.transport.framing != "off"
    )
    names += ["framing"] if framed else []
    names += ["entities", "session_close"] if plan.creation.entities != "preconfigured" else []
    names += ["stream_reliable_input"] if plan.input.reliable_slots else []
    names += ["stream_best_effort"] if plan.streams.best_effort_size else []
    names += ["read", "cdr_decode"] if plan.input.receives else []
    names += ["subscribe", "stream_best_effort_input"] if plan.entities.subscriptions.any else []
    names += ["services"] if plan.entities.serves else []
    names += ["stream_reliable"] if plan.streams.reliable_slots else []
    names += ["discovery"] if plan.transport.has_discovery else []
    names += ["liveliness_hard"] if plan.session.hard_liveliness_ms else []
    names += ["multithread"] if plan.session.multithread else []
    names += ["sleep_cycles"] if plan.session.has_sleep else []
    names += ["session_state"] if plan.session.has_state else []
    names += ["time_sync"] if plan.session.has_time_sync else []
    names += ["executor"] if plan.executor.any else []
    names += ["timers"] if plan.timers.any else []
    names += ["clock"] if plan.clock.any else []
    names += ["clock_ros"] if plan.clock.has_ros_time else []
    names += {"ping": ["ping"], "acknack": ["liveliness_acknack"], "none": []}[liveliness]
    return tuple(sorted(names))


@dataclass(frozen=True)
class Tree:
    """A rendered runtime: its folder, its include folder and its C files."""

    folder: Path
    sources: tuple[Path, ...]

    @property
    def include(self) -> Path:
        return self.folder / "include"

    def without_port(self, *kept: str) -> Tree:
        """Return the tree without the sources of the POSIX port, except those named in `kept`."""
        chosen = (s for s in self.sources if s.name in kept or not s.parent.name.startswith("port_posix"))
        return Tree(self.folder, tuple(chosen))


def render(out: Path, plan: RuntimePlan, names: Sequence[str]) -> Tree:
    """Write include/ and src/ of the components `names` below `out`."""
    catalogue = _catalogue()
    names = [*names, *(["port_posix_sockets"] if "port_posix" in names else [])]
    chosen = tuple(ChosenComponent(catalogue[name], ("test",)) for name in names)
    selection = Selection(
        ("test",), chosen, plan.creation.entities, plan.transport.kind, "ping", (), (), (), (), ()
    )
    values = Values(plan, selection, target=_host())
    provisions = provide((c.component for c in chosen), PORTS, (), values.holds)
    files = component_files((c.component for c in chosen), values.holds, provisions.files)
    sources, folders = [], set[Path]()
    others = [component for name, component in catalogue.items() if name not in names]
    for place, content in render_components(files, values, shared_environment(), (), others).items():
        target = out / place
        if target.parent not in folders:
            target.parent.mkdir(parents=True, exist_ok=True)
            folders.add(target.parent)
        target.write_bytes(content)
        if target.suffix == ".c":
            sources.append(target)
    return Tree(out, tuple(sources))


@cache
def _host() -> Target:
    found = read_target("host", Path(), None, Diagnostics())
    assert found is not None
    return found.target


def quick() -> tuple[str, tuple[str, ...]]:
    """Return the compiler and the flags of programs of which only the behavior counts.

    tcc compiles a client in a twentieth of a second, which takes clang two with sanitizers. With these, `make system`
    runs the same tests again.
    """
    if os.environ.get(EVERYWHERE) == "all" or shutil.which("tcc") is None:
        return SANITIZER, SANITIZE
    return "tcc", ()


def quick_with_constructors() -> tuple[str, tuple[str, ...]]:
    """Return the same for programs with functions that run before main(), which tcc does not call."""
    compiler, flags = quick()
    return ("gcc", ("-O0", "-g0")) if compiler == "tcc" else (compiler, flags)


@cache
def _catalogue() -> Catalogue:
    return load_catalogue()


def compilers() -> tuple[str, ...]:
    return tuple(name for name in ("gcc", "clang") if shutil.which(name))


def compile_objects(
    tree: Tree, sources: Iterable[Path], compiler: str, flags: Sequence[str]
) -> tuple[Path, ...]:
    """Compile each source with the project's warnings as errors; raises with the compiler's words.

    With the same sources, headers and flags as before a file is not compiled again.
    """
    return compile_units(tree, [(source,) for source in sources], compiler, flags)


def compile_units(
    tree: Tree, units: Iterable[Sequence[Path]], compiler: str, flags: Sequence[str]
) -> tuple[Path, ...]:
    """Compile each group of sources as one translation unit, as compile_objects."""
    own = () if compiler == "tcc" else (*WARNINGS, *LIBRARY_FLAGS)
    common = [*own, *flags, f"-I{tree.include}", f"-I{FIXTURES}"]
    made_with = (version(compiler), *own, *flags)
    headers = headers_digest(tree.include, FIXTURES)

    def compile_one(unit: Sequence[Path]) -> tuple[Path, str]:
        first = unit[0]
        texts = [source_contents(source, tree.include, FIXTURES) for source in unit]
        key = digest(compiler, made_with, texts, headers)

        def make(target: Path) -> str:
            source = first if len(unit) == 1 else target.with_suffix(".c")
            if len(unit) > 1:
                source.write_text(text_of(unit), encoding="utf-8")
            command = [real(compiler), *common, "-c", str(source), "-o", str(target)]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            return f"{compiler} {source}:\n{done.stderr}" if done.returncode else ""

        return made(key, f"{first.parent.name}_{first.stem}.o", make)

    with ThreadPoolExecutor(2) as pool:
        compiled = list(pool.map(compile_one, units))
    failed = [words for _, words in compiled if words]
    assert not failed, "\n".join(failed)
    return tuple(target for target, _ in compiled)


def compile_merged(
    tree: Tree, sources: Iterable[Path], application: Iterable[Path], compiler: str, flags: Sequence[str]
) -> tuple[Path, ...]:
    """Compile many sources as few units; those of the application may declare types that the tree has, too."""
    return compile_units(tree, (*merged(sources), *merged(application)), compiler, flags)


def link(objects: Sequence[Path], compiler: str, flags: Sequence[str], program: Path) -> Path:
    unused = () if compiler == "tcc" else ("-Wl,--gc-sections",)
    command = [compiler, *flags, *unused, *map(str, objects), "-o", str(program)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return program


def build(
    tree: Tree,
    fixtures: Sequence[str],
    program: str,
    compiler: str = "",
    flags: Sequence[str] = (),
    link_flags: Sequence[str] = (),
) -> Path:
    """Compile the tree and the named C files of c/, and link them to a program, unless told otherwise `quick`."""
    if not compiler:
        compiler, flags = quick()
    objects = compile_merged(tree, tree.sources, [FIXTURES / name for name in fixtures], compiler, flags)

    def make(target: Path) -> str:
        link(objects, compiler, link_flags or flags, target)
        return ""

    key = digest(version(compiler), flags, link_flags, objects)
    return made(key, f"{program}-{compiler}", make)[0]
