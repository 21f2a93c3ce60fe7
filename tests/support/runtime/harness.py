# SPDX-License-Identifier: Apache-2.0
"""Renders the C runtime for a hand-made plan, compiles it with a fixture, and counts what is in it."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import NodePlan, PublisherPlan, QueuePlan
from microros_gen.documents.templates import make_environment
from microros_gen.interfaces.types import TypeName
from microros_gen.selection.find_components import components_folder, load_catalogue
from microros_gen.selection.model import ChosenComponent, Selection
from microros_gen.toolchain.toolchain import LIBRARY_FLAGS, WARNINGS
from tests.support.paths import ROOT, TESTS

FIXTURES = TESTS / "runtime" / "c"
INT32 = TypeName("std_msgs", "msg", "Int32")
STRING = TypeName("std_msgs", "msg", "String")
CORE = (
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
SANITIZE = ("-g", "-O0", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")

POOL = RuntimePlan(
    plan_id="0123456789abcdef",
    error_text_size=160,
    agent_host="127.0.0.1",
    agent_port=8888,
    mtu=128,
    input_size=64,
    client_key=0xA1B2C3D4,
    session_id=0x81,
    best_effort_size=128,
    reliable_slots=4,
    reliable_slot_size=64,
    declared=False,
    nodes_max=2,
    publishers_max=3,
    name_size=32,
    nodes=(),
    publishers=(),
    arena_size=0,
    on_full="error",
    on_full_block_ms=0,
    connect_timeout_ms=400,
    create_timeout_ms=400,
    close_timeout_ms=200,
    liveliness_period_ms=100,
    liveliness_wait_ms=100,
    retry_first_ms=40,
    retry_most_ms=160,
    type_name_size=32,
)

DECLARED = replace(
    POOL,
    declared=True,
    type_name_size=0,
    nodes_max=1,
    publishers_max=2,
    name_size=0,
    nodes=(NodePlan(0, "imu", "/arm", "/arm/imu", 77),),
    publishers=(
        PublisherPlan(0, 0, "/arm/chatter", "rt/arm/chatter", INT32, True),
        PublisherPlan(1, 0, "/arm/imu/fast", "rt/arm/imu/fast", INT32, False),
    ),
)


READER = replace(
    POOL,
    subscriptions_max=2,
    queues=(QueuePlan(3, 16), QueuePlan(3, 16)),
    reliable_input_slots=2,
    reliable_input_slot_size=64,
)


SERVER = replace(
    POOL,
    mtu=256,
    best_effort_size=256,
    publishers_max=1,
    services_max=1,
    clients_max=2,
    queues=(QueuePlan(2, 40), QueuePlan(3, 20), QueuePlan(2, 20)),
    reliable_input_slots=2,
    reliable_input_slot_size=64,
)

EXECUTOR = replace(
    READER,
    timers_max=3,
    executors_max=2,
    handles_max=5,
    guard_conditions_max=2,
    wait_sets_max=1,
    ros_clocks_max=2,
    jump_callbacks_max=2,
)

# The first subscription is that of /clock.
ROS_TIME = replace(
    EXECUTOR,
    has_ros_time=True,
    type_name_size=40,
    subscriptions_max=3,
    queues=(QueuePlan(1, 8), QueuePlan(3, 16), QueuePlan(3, 16)),
)


def components(plan: RuntimePlan, liveliness: str = "ping") -> tuple[str, ...]:
    """Return the components that the resolver selects for `plan`."""
    names = [*CORE, f"entities_{plan.entities}", f"transport_{plan.transport}"]
    names = [name for name in names if name != "publish" or plan.publisher_places]
    names = [name for name in names if name != "write" or plan.publisher_places or plan.serves]
    framed = plan.transport == "serial" or (plan.transport == "custom" and plan.framing != "off")
    names += ["framing"] if framed else []
    names += ["entities", "session_close"] if plan.entities != "preconfigured" else []
    names += ["stream_reliable_input"] if plan.reliable_input_slots else []
    names += ["stream_best_effort"] if plan.best_effort_size else []
    names += ["read", "cdr_decode"] if plan.receives else []
    names += ["subscribe", "stream_best_effort_input"] if plan.has_subscriptions else []
    names += ["services"] if plan.serves else []
    names += ["stream_reliable"] if plan.reliable_slots else []
    names += ["discovery"] if plan.has_discovery else []
    names += ["liveliness_hard"] if plan.hard_liveliness_ms else []
    names += ["multithread"] if plan.multithread else []
    names += ["sleep_cycles"] if plan.has_sleep else []
    names += ["session_state"] if plan.has_session_state else []
    names += ["time_sync"] if plan.has_time_sync else []
    names += ["executor"] if plan.has_executors else []
    names += ["timers"] if plan.has_timers else []
    names += ["clock"] if plan.has_clocks else []
    names += ["clock_ros"] if plan.has_ros_time else []
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


def render(out: Path, plan: RuntimePlan, names: Sequence[str]) -> Tree:
    """Write include/ and src/ of the components `names` below `out`."""
    catalogue = load_catalogue()
    chosen = tuple(ChosenComponent(catalogue[name], ("test",)) for name in names)
    selection = Selection(("test",), chosen, plan.entities, plan.transport, "ping", (), (), (), (), ())
    headers = [header for c in chosen for header in c.component.headers]
    environment = make_environment()
    sources = []
    for component in (c.component for c in chosen):
        root = components_folder() / component.name
        files = [(p, p.relative_to(root)) for p in sorted((root / "include").rglob("*")) if p.is_file()]
        for source in component.sources:
            if all(getattr(plan, key) == value for key, value in source.when):
                files.append((root / "src" / source.path, Path("src", component.name, source.path)))
        for path, place in files:
            target = out / str(place).removesuffix(".j2")
            target.parent.mkdir(parents=True, exist_ok=True)
            if path.suffix == ".j2":
                template = environment.get_template(path.relative_to(components_folder()).as_posix())
                target.write_text(template.render(plan=plan, selection=selection, headers=headers))
            else:
                shutil.copyfile(path, target)
            if target.suffix == ".c":
                sources.append(target)
    return Tree(out, tuple(sources))


def compilers() -> tuple[str, ...]:
    return tuple(name for name in ("gcc", "clang") if shutil.which(name))


CACHE = ROOT / "build" / "runtime"
"""Objects and programs by what they were made from: for both test processes, and for the next run."""
_KEPT_DAYS = 3


@cache
def _cache() -> Path:
    """Return the cache's folder, without what was not used for some days."""
    CACHE.mkdir(parents=True, exist_ok=True)
    oldest = time.time() - _KEPT_DAYS * 86400
    for entry in CACHE.iterdir():
        if entry.stat().st_mtime < oldest:
            shutil.rmtree(entry, ignore_errors=True)
    return CACHE


@cache
def _version(compiler: str) -> str:
    return subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True).stdout


def _digest(*parts: object) -> str:
    return hashlib.sha256(repr(parts).encode()).hexdigest()


def _headers(*folders: Path) -> str:
    """Return what stands for every header below `folders`."""
    found = sorted((p.relative_to(folder).as_posix(), p) for folder in folders for p in folder.rglob("*.h"))
    return _digest([(name, path.read_bytes()) for name, path in found])


def _made(key: str, name: str, make: Callable[[Path], str]) -> tuple[Path, str]:
    """Return the file `name` of the cache, and what `make` says when it could not make it."""
    kept = _cache() / key / name
    if kept.is_file():
        os.utime(kept.parent)
        return kept, ""
    kept.parent.mkdir(exist_ok=True)
    with TemporaryDirectory(dir=kept.parent) as folder:
        fresh = Path(folder, name)
        words = make(fresh)
        if not words:
            fresh.replace(kept)
    return kept, words


def compile_objects(
    tree: Tree, sources: Iterable[Path], compiler: str, flags: Sequence[str]
) -> tuple[Path, ...]:
    """Compile each source with the project's warnings as errors; raises with the compiler's words.

    A file that is the same after the preprocessor as one before, by the same compiler and flags, is not compiled again;
    with the same headers it is not preprocessed again either.
    """
    common = [*WARNINGS, *LIBRARY_FLAGS, *flags, f"-I{tree.include}", f"-I{FIXTURES}"]
    made_with = (_version(compiler), *WARNINGS, *LIBRARY_FLAGS, *flags)

    headers = _headers(tree.include, FIXTURES)

    def preprocess(source: Path) -> str:
        command = [compiler, *common, "-E", "-P", str(source)]
        return _digest(subprocess.run(command, capture_output=True, check=False).stdout)

    def compile_one(source: Path) -> tuple[Path, str]:
        # Warnings depend on what is a macro and what a comment says of a fall through: the text itself counts too.
        own = (compiler, made_with, source.name, source.read_bytes())

        def note(target: Path) -> str:
            target.write_text(preprocess(source))
            return ""

        key = _digest(own, _made(_digest(own, headers), "preprocessed", note)[0].read_text())

        def make(target: Path) -> str:
            command = [compiler, *common, "-c", str(source), "-o", str(target)]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            return f"{compiler} {source}:\n{done.stderr}" if done.returncode else ""

        return _made(key, f"{source.parent.name}_{source.stem}.o", make)

    with ThreadPoolExecutor(2) as pool:
        compiled = list(pool.map(compile_one, sources))
    failed = [words for _, words in compiled if words]
    assert not failed, "\n".join(failed)
    return tuple(target for target, _ in compiled)


def link(objects: Sequence[Path], compiler: str, flags: Sequence[str], program: Path) -> Path:
    command = [compiler, *flags, "-Wl,--gc-sections", *map(str, objects), "-o", str(program)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return program


def build(
    tree: Tree,
    fixtures: Sequence[str],
    program: str,
    compiler: str = "gcc",
    flags: Sequence[str] = SANITIZE,
    link_flags: Sequence[str] = (),
) -> Path:
    """Compile the tree and the named C files of c/, and link them to a program."""
    sources = [*tree.sources, *(FIXTURES / name for name in fixtures)]
    objects = compile_objects(tree, sources, compiler, flags)

    def make(target: Path) -> str:
        link(objects, compiler, link_flags or flags, target)
        return ""

    key = _digest(_version(compiler), flags, link_flags, objects)
    return _made(key, f"{program}-{compiler}", make)[0]
