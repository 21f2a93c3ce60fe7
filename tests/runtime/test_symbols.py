# SPDX-License-Identifier: Apache-2.0
"""What is in the library and what is not: compilers, headers, symbols, sizes."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.runtime_entities import QueuePlan, SubscriptionPlan
from tests.support.plans import DECLARED, INT32, POOL, READER, changed
from tests.support.runtime.harness import (
    FIXTURES,
    Tree,
    compile_merged,
    compile_objects,
    compilers,
    components,
    link,
    render,
)
from tests.support.slices import only, spread_rows

UNWARNED = ("-Os", "-Wno-error")
"""Warnings of gcc that inline what is in other files are no matter of symbols."""

BEST_EFFORT_ONLY = changed(
    DECLARED,
    streams__reliable_slots=0,
    streams__reliable_slot_size=0,
    errors__text_size=0,
    memory__arena_size=512,
    streams__on_full="drop_oldest",
)
BLOCKING = changed(POOL, streams__on_full="block", streams__on_full_block_ms=5, session__client_key=None)
FRAGMENTS = changed(
    POOL,
    streams__mtu=64,
    streams__fragments=True,
    streams__reliable_slot_size=70000,
    streams__on_full="drop_oldest",
)
CREATION = changed(
    DECLARED,
    streams__best_effort_size=0,
    entities__publishers__declared=DECLARED.entities.publishers.declared[:1],
    entities__publishers__max=1,
    creation__stream="reliable",
    creation__size=128,
    input__reliable_slots=3,
    input__reliable_slot_size=64,
)
ONLY_READER = changed(
    DECLARED,
    entities__publishers__declared=(),
    entities__publishers__max=0,
    streams__reliable_slots=0,
    streams__reliable_slot_size=0,
    entities__subscriptions__declared=(SubscriptionPlan(0, 0, "/arm/go", "rt/arm/go", INT32, True),),
    entities__subscriptions__max=1,
    input__queues=(QueuePlan(4, 4),),
    input__reliable_slots=1,
    input__reliable_slot_size=64,
)
BEST_EFFORT_READER = changed(
    ONLY_READER,
    input__reliable_slots=0,
    input__reliable_slot_size=0,
    errors__text_size=0,
    input__queues=(QueuePlan(1, 4),),
)
FRAGMENTED_READER = changed(
    READER,
    creation__entities="xml",
    streams__mtu=64,
    input__arrives_in_fragments=True,
    input__queues=(QueuePlan(3, 2990),) * 2,
)
RELIABLE = {
    "creation__stream": "reliable",
    "creation__size": 128,
    "input__reliable_slots": 1,
    "input__reliable_slot_size": 64,
}
VARIANTS = {
    "xml-reliable-acknack": (
        changed(POOL, creation__entities="xml", **{**RELIABLE, "creation__size": 400}),
        "acknack",
    ),
    "reference-none": (changed(DECLARED, creation__entities="reference"), "none"),
    "reference-reliable-ping": (
        changed(POOL, creation__entities="reference", streams__best_effort_size=0, **RELIABLE),
        "ping",
    ),
    "preconfigured-none": (changed(DECLARED, creation__entities="preconfigured"), "none"),
    "pool-ping": (POOL, "ping"),
    "declared-acknack": (DECLARED, "acknack"),
    "best-effort-none": (BEST_EFFORT_ONLY, "none"),
    "block-none": (BLOCKING, "none"),
    "fragments-acknack": (FRAGMENTS, "acknack"),
    "creation-none": (CREATION, "none"),
    "reader-ping": (READER, "ping"),
    "reader-best-effort-none": (BEST_EFFORT_READER, "none"),
    "reader-only-none": (ONLY_READER, "none"),
    "reader-fragments-xml-ping": (FRAGMENTED_READER, "ping"),
    "reader-preconfigured-ping": (changed(ONLY_READER, creation__entities="preconfigured"), "ping"),
    "reader-reference-ping": (changed(ONLY_READER, creation__entities="reference"), "ping"),
}
QUICK = ("best-effort-none", "reader-fragments-xml-ping")
"""Variants whose symbols are looked at in `make test`: each kind of stream and of endpoint."""
FORBIDDEN = re.compile(
    r"\b(malloc|calloc|realloc|free|\w*printf|puts|fputs|fwrite|strtol|strdup|abort|exit|__assert\w*)$"
)


COMPILATIONS = [
    pytest.param("pool-ping", "gcc", ("-O2",), marks=pytest.mark.variant),
    pytest.param("pool-ping", "clang", ("-m32", "-O1"), marks=pytest.mark.long),
    pytest.param("declared-acknack", "gcc", ("-m32", "-Os"), marks=pytest.mark.variant),
    pytest.param("declared-acknack", "clang", ("-Os",), marks=pytest.mark.lint),
    pytest.param("best-effort-none", "gcc", ("-O2",), marks=pytest.mark.long),
    pytest.param("best-effort-none", "clang", ("-Os",), marks=pytest.mark.long),
    pytest.param("block-none", "gcc", ("-m32", "-Os"), marks=pytest.mark.long),
    pytest.param("block-none", "clang", ("-m32", "-O1"), marks=pytest.mark.long),
    pytest.param("fragments-acknack", "gcc", ("-m32", "-Os"), marks=pytest.mark.lint),
    pytest.param("fragments-acknack", "clang", ("-Os",), marks=pytest.mark.long),
    pytest.param("creation-none", "gcc", ("-Os",), marks=pytest.mark.lint),
    pytest.param("creation-none", "clang", ("-m32", "-O1"), marks=pytest.mark.long),
    pytest.param("reader-ping", "gcc", ("-m32", "-Os"), marks=pytest.mark.lint),
    pytest.param("reader-only-none", "clang", ("-Os",), marks=pytest.mark.long),
    pytest.param("reader-only-none", "gcc", ("-m32", "-O2"), marks=pytest.mark.long),
    pytest.param("reader-best-effort-none", "gcc", ("-Os",), marks=pytest.mark.long),
    pytest.param("reader-fragments-xml-ping", "clang", ("-m32", "-O1"), marks=pytest.mark.lint),
    pytest.param("reader-preconfigured-ping", "gcc", ("-O2",), marks=pytest.mark.long),
]


@pytest.mark.parametrize(("variant", "compiler", "flags"), COMPILATIONS)
def test_compiles_without_a_warning(
    variant: str, compiler: str, flags: tuple[str, ...], tmp_path: Path
) -> None:
    plan, liveliness = VARIANTS[variant]
    if compiler not in compilers():
        pytest.skip(f"no {compiler}")
    tree = render(tmp_path, plan, components(plan, liveliness))
    compile_objects(tree, tree.sources, compiler, flags)


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Tree:
    return render(tmp_path_factory.mktemp("pool"), POOL, components(POOL))


def _headers(tree: Tree) -> list[str]:
    return sorted(str(p.relative_to(tree.include)) for p in tree.include.rglob("*.h"))


@pytest.mark.system
def test_every_header_compiles_alone(tree: Tree) -> None:
    """In C99 and in C++, twice in a row, and all of them in the reverse order."""
    headers = _headers(tree)
    flags = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", f"-I{tree.include}"]
    source = tree.folder / "headers.c"
    for start in range(0, len(headers), 8):
        for header in headers[start : start + 8]:
            source.write_text(f"#include <{header}>\n#include <{header}>\nint headers_unused;\n")
            subprocess.run(["gcc", "-std=c99", *flags, str(source)], check=True)
    source.write_text("".join(f"#include <{header}>\n" for header in reversed(headers)))
    subprocess.run(["gcc", "-std=c99", *flags, str(source)], check=True)
    subprocess.run(["g++", "-std=c++11", "-x", "c++", *flags, str(source)], check=True)


@pytest.mark.system
def test_cpp_links_against_the_c_library(tree: Tree) -> None:
    objects = compile_merged(tree, tree.sources, (), "gcc", UNWARNED)
    source = tree.folder / "main.cpp"
    calls = (
        'rclc_support_init(&support, 0, NULL, &allocator) + rclc_node_init_default(&node, "n", "", &support) +'
        " rcl_publish(&publisher, &support, NULL)"
    )
    source.write_text(
        "#include <rclc/rclc.h>\n#include <rcl/rcl.h>\n#include <rmw_microros/rmw_microros.h>\n"
        "static rclc_support_t support; static rcl_node_t node; static rcl_publisher_t publisher;\n"
        "int main() { rcl_allocator_t allocator = rcl_get_default_allocator(); return (int)("
        + calls
        + "); }\n"
    )
    command = ["g++", "-Wall", "-Wextra", "-Werror", f"-I{tree.include}", str(source), *map(str, objects)]
    subprocess.run([*command, "-o", str(tree.folder / "cpp")], check=True)


def _undefined(objects: tuple[Path, ...]) -> set[str]:
    out = subprocess.run(["nm", "-u", *map(str, objects)], capture_output=True, text=True, check=True).stdout
    return {line.split()[-1] for line in out.splitlines() if " U " in line}


def _defined(objects: tuple[Path, ...]) -> set[str]:
    out = subprocess.run(
        ["nm", "--defined-only", "-g", *map(str, objects)], capture_output=True, text=True, check=True
    ).stdout
    return {line.split()[-1] for line in out.splitlines() if len(line.split()) == 3}


def _local(objects: tuple[Path, ...]) -> set[str]:
    out = subprocess.run(["nm", *map(str, objects)], capture_output=True, text=True, check=True).stdout
    return {line.split()[-1] for line in out.splitlines() if " t " in line}


@pytest.mark.parametrize("name", only(QUICK, VARIANTS))
def test_no_symbol_that_is_not_selected(name: str, tmp_path: Path) -> None:
    plan, liveliness = VARIANTS[name]
    tree = render(tmp_path, plan, components(plan, liveliness))
    of_port = [source for source in tree.sources if source.parent.name.startswith("port_posix")]
    of_library = [source for source in tree.sources if source not in of_port]
    library = compile_merged(tree, of_library, (), "gcc", UNWARNED)
    objects = (*library, *compile_objects(tree, of_port, "gcc", ("-Os",)))
    names, needed = _defined(objects), _undefined(library)
    assert not [name for name in needed if FORBIDDEN.search(name)]
    outside = {name for name in needed - names if not name.startswith(("_GLOBAL_OFFSET", "__stack_chk"))}
    assert outside <= {"memcpy", "memset", "memcmp", "memmove", "strlen", "strcmp", "strncmp"}
    assert any("ping" in name for name in names) == (liveliness == "ping")
    acknack = {name for name in names if "acknack" in name and "xrce_read" not in name}
    assert bool(acknack) == (liveliness == "acknack" or plan.streams.reliable_slots > 0)
    streams = {name for name in names if "stream_reliable" in name and "input" not in name}
    assert bool(streams) == (plan.streams.reliable_slots > 0)
    assert any("xrce_read" in name for name in names) == plan.input.receives
    assert any("subscription" in name for name in names if name.startswith("r")) == (
        plan.entities.subscriptions.max > 0
    )
    assert any("fragments" in name for name in names) == (
        plan.input.receives and plan.input.reliable_slots > 0
    )
    assert ("rcl_publish" in names) == (plan.entities.publisher_places > 0)
    assert any("reliable_input" in name for name in names) == (plan.input.reliable_slots > 0)
    best_effort = {name for name in names if "xrce_stream_best_effort" in name and "input" not in name}
    assert bool(best_effort) == (plan.streams.best_effort_size > 0)
    chunks = {"stream_flow", "stream_send_place", "stream_send_of", "stream_send_fragment"}
    assert bool(chunks & _local(objects)) == plan.streams.fragments
    _creates_as_the_plan_says(plan, names, b"".join(o.read_bytes() for o in objects))
    prefixes = ("rcl", "rclc", "rmw", "rcutils", "rosidl", "uxr", "xrce", "cdr", "port", "microros")
    assert all(name.startswith(prefixes) for name in names), "no name of ours can meet an application's"


def _creates_as_the_plan_says(plan: RuntimePlan, names: set[str], content: bytes) -> None:
    """No way to describe entities but the selected one, and none at all where they are preconfigured."""
    creation = {"xrce_describe", "xrce_entities_on_status", "xrce_session_leave"}
    assert names & creation == (set() if plan.creation.entities == "preconfigured" else creation)
    assert any("reliable_input" in name for name in names) == (plan.input.reliable_slots > 0)
    for word, way in (
        (b"<dds>", "xml"),
        (b"</name>", "xml"),
        (b"participant_profile", "reference"),
        (b"__dw", "reference"),
    ):
        if way == plan.creation.entities:
            assert (word in content) == (word != b"participant_profile" or plan.entities.nodes.max == 1)
        else:
            assert word not in content


def test_objects_of_another_plan_do_not_link(tree: Tree, tmp_path: Path) -> None:
    other = render(tmp_path, changed(POOL, plan_id="fedcba9876543210"), components(POOL))
    application = tmp_path / "application.c"
    application.write_text(
        "#include <rclc/rclc.h>\nint main(void) { rclc_support_t support; rcl_allocator_t a ="
        " rcl_get_default_allocator(); return (int)rclc_support_init(&support, 0, NULL, &a); }\n"
    )
    library = compile_merged(tree, tree.sources, (), "gcc", UNWARNED)
    with pytest.raises(AssertionError, match="rclc_support_init__plan_fedcba9876543210"):
        link(
            [*library, *compile_objects(other, [application], "gcc", ("-Os",))],
            "gcc",
            (),
            tmp_path / "program",
        )
    link([*library, *compile_objects(tree, [application], "gcc", ("-Os",))], "gcc", (), tmp_path / "program")


ARM = ("-mcpu=cortex-m4", "-mthumb", "-Os")


@pytest.mark.system
@pytest.mark.skipif(not shutil.which("arm-none-eabi-gcc"), reason="no cross compiler")
@pytest.mark.parametrize(("error_text_size", "most"), spread_rows([(160, 9700), (0, 8300)]))
def test_size_on_a_cortex_m4(error_text_size: int, most: int, tmp_path: Path) -> None:
    """Of the library in a pure sender, without a port: two publishers, memcpy and memset of newlib included."""
    plan = changed(
        DECLARED,
        errors__text_size=error_text_size,
        streams__best_effort_size=92,
        streams__reliable_slot_size=16,
    )
    plan = changed(plan, memory__fixed_messages=True)  # sender.c has Int32 alone
    names = [name for name in components(plan) if name != "port_posix"]
    tree = render(tmp_path, plan, names)
    sources = [*tree.sources, FIXTURES / "types.c", FIXTURES / "sender.c"]
    objects = compile_objects(tree, sources, "arm-none-eabi-gcc", ARM)
    program = link(
        objects,
        "arm-none-eabi-gcc",
        (*ARM, "-nostartfiles", "-Wl,-e,main", "--specs=nano.specs"),
        tmp_path / "a",
    )
    out = subprocess.run(
        ["arm-none-eabi-size", str(program)], capture_output=True, text=True, check=True
    ).stdout
    text, data, bss = (int(word) for word in out.splitlines()[1].split()[:3])
    assert text <= most
    assert data + bss <= 1100
