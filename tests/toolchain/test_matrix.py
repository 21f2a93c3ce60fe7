# SPDX-License-Identifier: Apache-2.0
"""Everything that is generated compiles without a warning: compilers, word sizes, levels, C++, CMake, Cortex-M."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from microros_gen.toolchain.toolchain import WARNINGS
from tests.support.matrix import ALSO, VARIANTS, Tree, check, compile_tree, has
from tests.support.paths import ROOT
from tests.support.slices import spread, spread_rows

pytestmark = pytest.mark.builds

TreeOf = Callable[[str], Tree]

_ALSO_CLANG = (
    "reader",
    "simulation-pool",
    "server-binary-timers-sleep",
    "client-xml-code-rtos-timers-threads",
)
# Every variant is compiled by test_symbols.py with gcc, 64 bit, -Os; `pool` and `demo` share all other cases.
CASES = [
    pytest.param("pool", "gcc", 32, "-Os", marks=pytest.mark.variant),
    *(
        pytest.param(*case, marks=pytest.mark.lint)
        for case in (
            ("pool", "gcc", 64, "-O0"),
            ("pool", "clang", 64, "-Os"),
            ("demo", "gcc", 32, "-O0"),
            ("demo", "clang", 64, "-O0"),
            ("demo", "clang", 32, "-Os"),
        )
    ),
    *(
        pytest.param(
            name, "clang", 32, "-O0", marks=pytest.mark.lint if name in _ALSO_CLANG else pytest.mark.long
        )
        for name in VARIANTS
        if name not in ("pool", "demo")
    ),
]
CORTEX_M = {
    "cortex-m0plus": ("-mcpu=cortex-m0plus", "-mthumb"),
    "cortex-m4f": ("-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"),
}
OF_A_BOARD = frozenset(
    {
        *(("transport.keeps_output", True), ("transport.device", False)),
        *(("target.data_model", "ip16"), ("target.data_model", "any")),
    }
)
"""Conditions of files for processors of 16 bits, and for the line of a board: it has no path, and its interrupt takes
messages where they are."""
CPP_FLAGS = ("-std=c++11", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror", "-x", "c++")


@pytest.mark.parametrize(("name", "compiler", "bits", "level"), CASES)
def test_it_compiles_without_a_warning_and_links(
    tree_of: TreeOf, tmp_path: Path, name: str, compiler: str, bits: int, level: str
) -> None:
    if not has(compiler):
        pytest.skip(f"no {compiler}")
    tree = tree_of(name)
    flags = (f"-m{bits}", level)
    compiled = compile_tree(tree, compiler, flags, (*tree.sources, tree.example), tmp_path)
    check([compiler, *flags, *map(str, compiled.objects.values()), "-o", str(tmp_path / "image")], tmp_path)


ELSEWHERE = {"seal"}
"""Debian has no PSA Crypto for 32 bits: tests/runtime/test_seal.py and tests/e2e/test_seal.py build it."""


@pytest.mark.system
def test_the_variants_select_every_file(tree_of: TreeOf) -> None:
    """A new file of a ready component must come into the matrix; what only boards have is built in tests/firmware."""
    from microros_gen.selection.find_components import load_catalogue

    selected = {source for name in VARIANTS if name not in ALSO for source in tree_of(name).sources}
    ready = [component for component in load_catalogue().values() if component.ready]
    generated = {
        f"src/{c.name}/{source.path.removesuffix('.j2')}"
        for c in ready
        if (c.layer != "port" or c.name.startswith("port_posix")) and c.name not in ELSEWHERE
        for source in c.files
        if OF_A_BOARD.isdisjoint(source.when)
    }
    assert generated
    assert generated <= selected


def _including(tree: Tree, folder: Path, ending: str) -> list[str]:
    """Write a file for each header of the selection: it comes first, and twice."""
    files = []
    for number, header in enumerate(tree.headers):
        path = folder / f"header_{number}.{ending}"
        path.write_text(f"#include <{header}>\n#include <{header}>\ntypedef int header_{number}_alone;\n")
        files.append(str(path))
    return files


@pytest.mark.parametrize(
    ("name", "compiler"),
    [pytest.param("demo", "clang", marks=pytest.mark.variant), ("pool-none-drop-code-arena-device", "gcc")],
)
def test_each_header_compiles_alone_in_c(tree_of: TreeOf, tmp_path: Path, name: str, compiler: str) -> None:
    if not has(compiler):
        pytest.skip(f"no {compiler}")
    tree = tree_of(name)
    files = _including(tree, tmp_path, "c")
    assert len(files) > 50
    check([compiler, *WARNINGS, "-fsyntax-only", "-Iinclude", *files], tree.out)


@pytest.mark.parametrize(
    ("name", "compiler"),
    [("demo", "g++"), pytest.param("pool-none-drop-code-arena-device", "clang++", marks=pytest.mark.variant)],
)
def test_each_header_compiles_alone_in_cpp(tree_of: TreeOf, tmp_path: Path, name: str, compiler: str) -> None:
    if not has(compiler):
        pytest.skip(f"no {compiler}")
    tree = tree_of(name)
    check([compiler, *CPP_FLAGS, "-fsyntax-only", "-Iinclude", *_including(tree, tmp_path, "cpp")], tree.out)


def test_the_header_of_what_is_not_selected_names_the_key(tree_of: TreeOf, tmp_path: Path) -> None:
    tree = tree_of("best-effort-none-code")
    refused = [h for h in tree.all_headers if tree.is_refusal(h)]
    assert "rclc/timer.h" in refused
    assert "rmw_microros/ping.h" in refused
    for header in refused:
        (tmp_path / "use.c").write_text(f"#include <{header}>\n")
        command = f"gcc -fsyntax-only -Iinclude '{tmp_path / 'use.c'}' 2>&1 && exit 1; exit 0"
        output = check(["sh", "-c", command], tree.out)
        keys = ("components: [+", "transport: {type: ", "target: {name: ")
        reported = [f"is not selected: add `{key}" for key in keys] + ["is not in this version yet"]
        assert any(text in output for text in reported), header


@pytest.mark.parametrize("name", spread(VARIANTS, 8))
def test_sources_txt_is_complete(tree_of: TreeOf, name: str) -> None:
    tree = tree_of(name)
    generated = sorted(p.relative_to(tree.out).as_posix() for p in (tree.out / "src").rglob("*.c"))
    assert list(tree.sources) == generated
    cmake = (tree.out / "CMakeLists.txt").read_text(encoding="utf-8")
    assert [line.strip() for line in cmake.splitlines() if line.startswith("  src/")] == generated


@pytest.mark.system
@pytest.mark.skipif(not has("cmake"), reason="no cmake")
def test_cmake_builds_it_elsewhere_without_the_tool(tree_of: TreeOf, tmp_path: Path) -> None:
    """Out of tree, in a path with spaces, with the example."""
    tree = tree_of("pool")
    build = tmp_path / "a build folder"
    flags = " ".join(WARNINGS[1:])
    check(
        ["cmake", "-S", str(tree.out), "-B", str(build), "-DMICROROS_EXAMPLE=ON", f"-DCMAKE_C_FLAGS={flags}"],
        tmp_path,
    )
    check(["cmake", "--build", str(build)], tmp_path)
    assert (build / "libmicroros.a").is_file()
    assert (build / "pure_sender").is_file()
    assert sorted(p.name for p in tree.out.iterdir()) == [
        "CMakeLists.txt", "README.md", "examples", "include", "manifest.json", "microros_image.cmake",
        "sources.txt", "src",
    ]  # fmt: skip


_USER_CMAKE = """\
cmake_minimum_required(VERSION 3.13)
project(firmware C CXX)
add_subdirectory("${GENERATED}" microros)
add_executable(firmware main.cpp)
target_link_libraries(firmware PRIVATE microros)
"""
_USER_MAIN = """\
#include <rclc/rclc.h>
#include <sensor_msgs/msg/imu.h>
#include <std_msgs/msg/int32.h>
int main()
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  sensor_msgs__msg__Imu imu;
  std_msgs__msg__Int32 count;
  if (!sensor_msgs__msg__Imu__init(&imu) || !std_msgs__msg__Int32__init(&count)) {
    return 1;
  }
  return rclc_support_init(&support, 0, nullptr, &allocator) == RCL_RET_OK ? 0 : 2;
}
"""


@pytest.mark.variant  # of tests/package/test_cmake.py: add_subdirectory
@pytest.mark.system
@pytest.mark.skipif(not has("cmake") or not has("g++"), reason="no cmake or no C++ compiler")
def test_a_project_of_the_user_takes_it_in_as_a_subdirectory(tree_of: TreeOf, tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(_USER_CMAKE)
    (tmp_path / "main.cpp").write_text(_USER_MAIN)
    generated = f"-DGENERATED={tree_of('demo').out}"
    check(["cmake", "-S", ".", "-B", "build", generated], tmp_path)
    check(["cmake", "--build", "build"], tmp_path)
    assert (tmp_path / "build" / "firmware").is_file()


@pytest.mark.system
@pytest.mark.skipif(not has("arm-none-eabi-gcc"), reason="no arm-none-eabi-gcc")
@pytest.mark.parametrize(
    ("name", "cpu"),
    spread_rows([("demo", "cortex-m4f"), ("pool-none-drop-code-arena-device", "cortex-m0plus")]),
)
def test_a_cortex_m_compiler_takes_all_but_the_posix_port(
    tree_of: TreeOf, tmp_path: Path, name: str, cpu: str
) -> None:
    tree = tree_of(name)
    sources = [s for s in tree.sources if not s.startswith("src/port_posix")]
    assert len(sources) < len(tree.sources)
    compile_tree(tree, "arm-none-eabi-gcc", (*CORTEX_M[cpu], "-Os"), (*sources, tree.example), tmp_path)


def test_the_demo_is_the_one_in_examples() -> None:
    assert VARIANTS["demo"] == (ROOT / "examples/demo/microros.yaml").read_text(encoding="utf-8")
