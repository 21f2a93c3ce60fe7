# SPDX-License-Identifier: Apache-2.0
"""Generates type support into a folder and compiles it."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from microros_gen.application.model import LimitRule
from microros_gen.client.plan.messages import plan_messages
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.documents.templates import shared_environment
from microros_gen.interfaces.closure import InterfaceSet, resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder
from microros_gen.interfaces.types import (
    FieldType,
    Message,
    NamedType,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.typesupport.plan.capacity import Capacities, Defaults, Root, plan_capacities
from microros_gen.typesupport.plan.message_pools import pool_pointers
from microros_gen.typesupport.plan.size import is_fixed_field
from microros_gen.typesupport.plan.types import TypePlan, plan_types
from microros_gen.typesupport.views.decode import render_decoders
from microros_gen.typesupport.views.types import render_types
from tests.support.objects.made import digest, headers_digest, made, version
from tests.support.paths import ROOT

COMPONENTS = ROOT / "microros_gen" / "components"
COMPONENT_HEADERS = ("base", "cdr", "cdr_decode", "rosidl_runtime", "memory")
DECODING = sorted(
    path for path in (COMPONENTS / "cdr_decode" / "src").glob("cdr_*.c") if "double" not in path.name
)
"""Without what decodes doubles where a double may have 4 bytes."""
SEQUENCES = "src/rosidl_runtime/primitives_sequence.c"
TEST_RULES = (LimitRule(("*",), string=13, sequence=5),)
"""Small enough to fill, large enough for every default value in test_msgs."""

WARNINGS = [
    *("-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wsign-conversion", "-Wshadow"),
    *("-Wundef", "-Wstrict-prototypes", "-Wmissing-prototypes", "-Werror"),
]


@dataclass(frozen=True)
class Generated:
    """What was planned and written."""

    folder: Path
    messages: Mapping[TypeName, Message]
    capacities: Capacities
    plans: tuple[TypePlan, ...]
    files: Mapping[str, bytes]

    def plan(self, name: str) -> TypePlan:
        """Return the plan of `pkg/msg/Type`."""
        return next(plan for plan in self.plans if str(plan.name) == name)

    @property
    def includes(self) -> list[str]:
        """Compiler options for the generated headers and those of the components."""
        folders = [self.folder / "include", *(COMPONENTS / c / "include" for c in COMPONENT_HEADERS)]
        return [f"-I{folder}" for folder in folders]

    def sources(self, *endings: str) -> list[Path]:
        """Return the C files that end so."""
        return [self.folder / path for path in self.files if path.endswith(endings)]


def interfaces(requests: Iterable[str], paths: Sequence[Path] = ()) -> InterfaceSet:
    """Return the closure of packages and types."""
    diagnostics = Diagnostics()
    finder = InterfaceFinder.from_environment(paths)
    found = resolve_interfaces(tuple(Named(r) for r in requests), finder, diagnostics)
    diagnostics.check()
    return found


def generate(
    requests: Iterable[str],
    rules: Sequence[LimitRule],
    folder: Path,
    paths: Sequence[Path] = (),
) -> Generated:
    """Plan, render and write the types of `requests`."""
    found = interfaces(requests, paths)
    diagnostics = Diagnostics()
    capacities = plan_capacities(
        found.messages, [Root(name) for name in found.message_roots], rules, Defaults(), diagnostics
    )
    diagnostics.check()
    received = tuple(capacities.limits)
    plans = plan_types(found.messages, capacities, found.type_hash, diagnostics, received)
    diagnostics.check()
    files = render_types(plans, shared_environment()) | render_decoders(plans, shared_environment())
    runtime = {"include/microros/message_pools.h": no_pools(), SEQUENCES: _sequences(plans)}
    for path, content in {**files, **runtime}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(content)
    return Generated(folder, found.messages, capacities, plans, files)


def no_pools() -> bytes:
    """Return the header of the pools of an application that sends nothing."""
    template = shared_environment().get_template("memory/include/microros/message_pools.h.j2")
    return template.render(
        plan={"memory": {"message_pools": (), "pool_pointers": pool_pointers(())}}
    ).encode()


def _sequences(plans: Sequence[TypePlan]) -> bytes:
    """Return the functions of the sequences of numbers in `plans`."""
    template = shared_environment().get_template("rosidl_runtime/src/primitives_sequence.c.j2")
    return template.render(plan={"messages": plan_messages(plans)}).encode()


def differing_rules(found: InterfaceSet) -> tuple[LimitRule, ...]:
    """Return limits that differ from root to root and from member to member."""
    rules = []
    for index, root in enumerate(found.message_roots):
        for number, field in enumerate(found.messages[root].fields):
            if not is_fixed_field(field, found.messages):
                path = (str(root), field.name)
                element = element_of(field.type)
                nested = isinstance(element, NamedType)
                texts = 12 + (index + number) % 5 if nested or isinstance(element, StringType) else None
                is_sequence = isinstance(field.type, SequenceType)
                count = 3 + (index + 2 * number) % 3 if nested or is_sequence else None
                rules.append(
                    LimitRule(path, _capped(texts, _bound(element)), _capped(count, _bound(field.type)))
                )
    return (LimitRule(("*",), 14, 4), *rules)


def _bound(kind: FieldType) -> int | None:
    return kind.bound if isinstance(kind, (SequenceType, StringType)) else None


def _capped(number: int | None, bound: int | None) -> int | None:
    return number if number is None or bound is None else min(number, bound)


def run(command: Sequence[str | Path], cwd: Path | None = None) -> str:
    """Run a command that must succeed and print nothing on stderr; return its output."""
    result = subprocess.run(
        [str(part) for part in command], cwd=cwd, text=True, capture_output=True, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
    assert result.stderr == "", result.stderr
    return result.stdout


def unity(generated: Generated, name: str, *endings: str, extra: str = "") -> Path:
    """Write one C file that holds all sources with these endings: compiled at once, it takes seconds."""
    path = generated.folder / name
    path.write_text("".join(f'#include "{s}"\n' for s in generated.sources(*endings)) + extra)
    return path


ALLOCATOR = """
#include "rcutils/allocator.h"
static rcutils_allocator_t test_allocator;
void test_set_allocator(const rcutils_allocator_t * allocator);
void test_set_allocator(const rcutils_allocator_t * allocator) { test_allocator = *allocator; }
rcutils_allocator_t rcutils_get_default_allocator(void) { return test_allocator; }
void microros_memory_refuse(void) { }
"""


def compile_shared(generated: Generated) -> ctypes.CDLL:
    """Compile everything to a shared library with this project's string functions, and load it.

    Its default allocator is what `test_set_allocator` was given; none at first.
    """
    source = unity(generated, "all.c", ".c", extra=ALLOCATOR)
    runtime = [*sorted((COMPONENTS / "rosidl_runtime" / "src").glob("*.c")), *DECODING]
    runtime.append(generated.folder / SEQUENCES)
    runtime.append(COMPONENTS / "memory" / "src" / "message_memory_allocator.c")
    # tcc takes a twentieth of gcc's time; that nothing warns of it, test_compilers.py holds.
    command = ["tcc" if shutil.which("tcc") else "gcc", "-O0", "-fPIC", "-shared", "-Wl,-Bsymbolic"]

    def make(output: Path) -> str:
        run([*command, *generated.includes, source, *runtime, "-o", output])
        return ""

    texts = [path.read_bytes() for path in runtime]
    headers = headers_digest(*(COMPONENTS / c / "include" for c in COMPONENT_HEADERS))
    key = digest(version(command[0]), command, ALLOCATOR, sorted(generated.files.items()), texts, headers)
    return ctypes.CDLL(str(made(key, "libeverything.so", make)[0]))
