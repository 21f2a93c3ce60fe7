# SPDX-License-Identifier: Apache-2.0
"""Sizes against independent oracles: `size` and `nm` of the tool chain, C's sizeof, the measured high-water mark."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from microros_gen.cli.size.format import size_table
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.image.attribution import attribute, attribute_library
from microros_gen.image.budget import budget_lines
from microros_gen.image.callgraph import parse_call_graph
from microros_gen.image.disassembly import parse_disassembly
from microros_gen.image.elf import Elf
from microros_gen.image.entities import MESSAGE_STORAGE
from microros_gen.image.folder import read_folder
from microros_gen.image.linker_map import parse_map
from microros_gen.image.pointers import read_pointers
from microros_gen.image.records import ImageRecord
from microros_gen.image.report import SizeReport, measure
from microros_gen.image.stack import bound_of, shown_name
from microros_gen.platform.find import read_target
from microros_gen.toolchain.compile import MAP, compile_tree
from microros_gen.toolchain.identity import CALL_GRAPH
from microros_gen.toolchain.toolchain import find_toolchain
from tests.support.firmware.board import shared_builds
from tests.support.image.size_images import APPLICATION, BOARDS, PROBE, build, tool
from tests.support.matrix import has
from tests.support.slices import first, spread_rows

pytestmark = [
    pytest.mark.skipif(not has("gcc") or not has("size"), reason="no gcc or no size"),
    pytest.mark.builds,
]
LINK_FLAGS = ("-Wl,--gc-sections", "-Wl,-z,now")
"""Without lazy binding: the dynamic linker would run on the stack that is measured."""
Measured = Callable[[str], SizeReport]


@pytest.fixture(scope="session")
def measured(tmp_path_factory: pytest.TempPathFactory) -> Measured:
    base = tmp_path_factory.mktemp("sizes")

    @cache
    def get(target: str) -> SizeReport:
        if not has(f"{BOARDS[target]}gcc"):
            pytest.skip(f"no compiler for {target}")
        with pytest.MonkeyPatch.context() as patch:
            for name in ("CC", "AR", "CFLAGS"):
                patch.delenv(name, raising=False)
            return measure(build(base / target, APPLICATION, target))

    return get


def berkeley(program: str, *files: Path) -> dict[str, int]:
    last = tool(program, "-B", *files).splitlines()[-1].split()
    return dict(zip(("text", "data", "bss"), map(int, last[:3]), strict=True))


@pytest.mark.parametrize("target", first(BOARDS))
def test_the_sums_are_those_of_size(measured: Measured, target: str) -> None:
    report = measured(target)
    assert report.folder.image is not None
    expected = berkeley(f"{BOARDS[target]}size", report.folder.image)
    assert report.totals == expected
    assert sum(p.size for p in report.ram) == expected["data"] + expected["bss"]
    assert all(p.size > 0 for p in report.chunks)
    for chunk, following in zip(report.chunks, report.chunks[1:], strict=False):
        assert chunk.section != following.section or chunk.address + chunk.size == following.address


@pytest.mark.parametrize("target", first(BOARDS))
def test_every_symbol_of_nm_has_its_size(measured: Measured, target: str) -> None:
    report = measured(target)
    expected: dict[str, int] = {}
    for line in tool(f"{BOARDS[target]}nm", "-S", "-P", report.folder.image or "").splitlines():
        parts = line.split()
        if len(parts) == 4 and parts[1] in "TtBbDdRr":
            expected[parts[0]] = expected.get(parts[0], 0) + int(parts[3], 16)
    counted: dict[str, int] = {}
    ours = ("component", "type support", "application")
    for chunk in (p for p in report.chunks if p.owner.group in ours):
        for name in (chunk.symbol, *chunk.aliases):
            if name:
                counted[name] = counted.get(name, 0) + chunk.size
    counted = {name: size for name, size in counted.items() if not name.startswith('"')}
    assert len(counted) > 100
    assert counted == {name: size for name, size in expected.items() if name in counted}
    assert not [n for n in expected if n.startswith(("rcl", "rmw_", "xrce_", "port_")) and n not in counted]


@pytest.mark.parametrize("target", first(BOARDS))
def test_an_owner_is_the_object_that_defines_a_symbol(measured: Measured, target: str) -> None:
    """`nm -A` of the library is the oracle: which member defines an exported function."""
    report = measured(target)
    expected = tool(
        f"{BOARDS[target]}nm", "-A", "-P", "--defined-only", report.folder.path / "lib/libmicroros.a"
    )
    members = dict(re.findall(r"\[([^]]+)\]: (\w+) T ", expected))
    by_name = {name: member for member, name in re.findall(r"\[([^]]+)\]: (\w+) T ", expected)}
    assert members
    checked = 0
    for chunk in report.chunks:
        if chunk.symbol in by_name and chunk.owner.group in ("component", "type support"):
            folder, _, name = by_name[chunk.symbol].removesuffix(".o").partition("__")
            assert re.fullmatch(rf"src/{folder}/{re.escape(name)}\.[cS]", chunk.source or "")
            checked += 1
    assert checked > 50


def test_members_of_the_library_have_names_of_their_own(measured: Measured) -> None:
    report = measured("host")
    members = tool("ar", "t", report.folder.path / "lib/libmicroros.a").split()
    assert len(members) == len(set(members)) == len(report.folder.sources)
    assert {"std_msgs__string__functions.o", "example_interfaces__string__functions.o"} <= set(members)


def test_the_library_alone_adds_up(measured: Measured) -> None:
    folder = measured("host").folder
    last = tool("size", "-t", folder.path / "lib/libmicroros.a").splitlines()[-1].split()
    chunks = attribute_library(folder)
    kinds = {k: sum(p.size for p in chunks if p.kind == k) for k in ("text", "data", "bss")}
    assert list(kinds.values()) == [int(n) for n in last[:3]]


def check_message_storage(report: SizeReport) -> None:
    """Blocks for sent messages have a separate line and count in the budget; fewer messages save them."""
    blocks = report.folder.manifest["message_storage"]["blocks"]
    assert blocks == {"std_msgs__msg__Int32__message": [[1, 2]], "std_msgs__msg__UInt8__message": [[1, 2]]}
    storage = sum(p.size for p in report.ram if p.use == MESSAGE_STORAGE)
    assert storage == 2 * 4 + 1 + 2 * 1 + 1
    budget = {"memory": {"ram_budget": {"bytes": 1, "place": None}}}
    folder = replace(report.folder, manifest={**report.folder.manifest, **budget})
    linked = ImageRecord(folder.path / "bin/image", folder.path / "bin/image.map", (), ())
    image = replace(folder, linked=linked)
    (without,) = budget_lines(folder, report.chunks, report.ram, report.stack)
    (line,) = budget_lines(image, report.chunks, report.ram, report.stack)
    assert line.used == without.used + storage, (
        "the library alone has it for functions that may never be called"
    )
    assert {a.change: a.saves for a in line.advice}["messages: 1"] == storage // 2


@pytest.mark.system
@pytest.mark.skipif(not has("arm-none-eabi-gcc"), reason="no compiler for Cortex-M")
def test_a_target_without_an_image_is_measured_by_its_library(tmp_path: Path) -> None:
    text = PROBE.replace("nodes:", "transport: {type: custom}\nnodes:")
    report = measure(build(tmp_path, text + "memory: {ram_budget: 4 KiB, messages: 2}\n", "cortex-m4"))
    assert report.folder.image is None
    last = tool("arm-none-eabi-size", "-t", report.folder.path / "lib/libmicroros.a").splitlines()[-1].split()
    assert list(report.totals.values()) == [int(n) for n in last[:3]]
    assert not report.stack.known
    assert "without an image" in report.stack.why
    assert [(b.key, b.exceeded) for b in report.budgets] == [("ram_budget", False)]
    assert all(e.ram for e in report.entities), "the objects' own DWARF splits the pools"
    check_message_storage(report)
    assert size_table(report, every=False).startswith(
        "Library for cortex-m4, before unused parts are dropped"
    )


@pytest.mark.skipif(not has("clang") or not has("ld.lld"), reason="no clang or no lld")
def test_the_map_of_lld(measured: Measured, tmp_path: Path) -> None:
    out = tmp_path / "out"
    shutil.copytree(measured("host").folder.path, out)
    main = ".build/examples/pure_sender/main.o"
    flags = ["-fuse-ld=lld", "-Wl,--gc-sections", f"-Wl,-Map={MAP}", "-o", "bin/pure_sender"]
    subprocess.run(["clang", main, "lib/libmicroros.a", *flags], cwd=out, check=True)
    folder = read_folder(out)
    chunks = attribute(folder, Elf(out / "bin/pure_sender"))
    kinds = {k: sum(p.size for p in chunks if p.kind == k) for k in ("text", "data", "bss")}
    assert kinds == berkeley("size", out / "bin/pure_sender")
    of_publish = [p for p in chunks if p.symbol == "rcl_publish"]
    assert [(p.owner.name, p.source) for p in of_publish] == [("publish", "src/publish/rcl_publisher.c")]


def test_string_constants_belong_to_who_wrote_them(measured: Measured) -> None:
    """Linkers merge strings into one section; what main.c prints is in main.c alone, the type's name in its support."""
    chunks = {p.symbol: p for p in measured("host").chunks if p.symbol and p.symbol.startswith('"')}
    assert chunks['"start"'].source == "examples/pure_sender/main.c"
    assert chunks['"sensor_msgs::msg::dds_::Imu_"'].source == "src/sensor_msgs/imu__type_support.c"


def sizeof(out: Path, *expressions: str) -> list[int]:
    """Ask the compiler for sizes."""
    lines = "".join(f'(void)printf("%zu\\n", (size_t)({e}));' for e in expressions)
    headers = (
        "stdio.h",
        "microros/xrce_client.h",
        "microros/xrce_stream_reliable_slots.h",
        "sensor_msgs/msg/detail/imu__storage.h",
    )
    head = "".join(f"#include <{header}>\n" for header in headers)
    source = f"{head}int main(void){{{lines}return 0;}}"
    program = out / ".build" / "sizeof"
    subprocess.run(
        ["gcc", "-std=c99", "-Iinclude", "-x", "c", "-", "-o", program],
        cwd=out,
        input=source,
        text=True,
        check=True,
    )
    return [int(n) for n in tool(program).split()]


def test_ram_is_split_as_the_compiler_lays_it_out(measured: Measured) -> None:
    report = measured("host")
    client, reliable, sizes, writer, message, storage = sizeof(
        report.folder.path,
        "sizeof(struct xrce_client_t)",
        "sizeof(((struct xrce_client_t *)0)->reliable)",
        "sizeof(xrce_reliable_slots.size)",
        "sizeof(xrce_endpoint_t)",
        "sizeof(sensor_msgs__msg__Imu)",
        "sizeof(sensor_msgs__msg__Imu__Storage)",
    )
    parts = [p for p in report.ram if p.symbol == "instance"]
    assert sum(p.size for p in parts) >= client
    slots = {p.path: p.size for p in report.ram if re.fullmatch(r"reliable stream, slot \d", p.use)}
    pools = report.folder.manifest["pools"]
    assert len(slots) == pools["reliable_slots"]
    assert set(slots.values()) == {pools["reliable_slot_size"]}
    stream = sum(p.size for p in report.ram if p.use == "reliable stream")
    assert sizes < stream <= reliable + sizes
    best_effort = sum(p.size for p in report.ram if p.use == "best-effort stream")
    assert best_effort >= pools["best_effort_size"]
    of_endpoint = [p for p in parts if ".endpoints[1]" in p.path]
    assert 0 < sum(p.size for p in of_endpoint) <= writer
    assert {p.use for p in of_endpoint} == {"publisher 1"}
    entities = {e.name: e for e in report.entities}
    assert entities["/imu/data"].message == 2 * (message + storage), (
        "two publishers of one type, two messages"
    )
    assert entities["/imu/data"].type_users == 2
    assert entities["/imu/data"].flash == entities["/imu/raw"].flash > entities["/count"].flash > 0
    assert [(s.what, s.users) for s in entities["/count"].shares] == [("reliable stream", 3)]


@pytest.fixture(scope="module")
def probe_tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build(tmp_path_factory.mktemp("probe"), PROBE)


def run_with(tree: Path, folder: Path, main: str) -> SizeReport:
    """Measure a copy of `tree` whose image is linked from another main.c."""
    out = folder / "out"
    shutil.copytree(tree, out)
    path = out / "examples" / "probe" / "main.c"
    path.parent.mkdir()
    path.write_text(main, encoding="utf-8")
    found = read_target("host", Path(), None, Diagnostics())
    assert found is not None
    tools = replace(find_toolchain(found.target, {"PATH": os.environ["PATH"]}), link_flags=LINK_FLAGS)
    sources = (out / "sources.txt").read_text().split()
    compile_tree(out, sources, "examples/probe/main.c", "pure_sender", tools)
    return measure(out)


@pytest.mark.system
def test_the_measured_high_water_mark_is_below_the_bound(probe_tree: Path, tmp_path: Path) -> None:
    """The same calls with a measured high-water mark, port functions included: it does not exceed the bound."""
    main = (Path(__file__).parent / "c" / "stack_probe.c").read_text(encoding="utf-8")
    report = run_with(probe_tree, tmp_path, main)
    expected = tool(report.folder.path / "bin/pure_sender")
    failed, used = map(int, expected.split())
    assert failed == 0
    assert report.graph is not None
    bound = bound_of(report.graph, "work")
    assert bound is not None
    assert bound.open == ("memcpy (shared library)",), "nothing else is left out"
    assert used <= bound.bytes + report.stack.hardware
    assert used > bound.bytes // 2, "the run came near the bound, so the comparison means something"
    assert "rcl_publisher_open" in {link.name for link in bound.chain}


@pytest.mark.system
def test_the_bound_follows_pointers_of_the_type_support(measured: Measured) -> None:
    report = measured("qemu-mps2-an385")
    assert report.graph is not None
    nodes = {n.name: n for n in report.graph.nodes.values()}
    called = {report.graph.nodes[a].name for a in nodes["xrce_write_message"].calls}
    assert {"sensor_msgs__msg__Imu__encode", "std_msgs__msg__Int32__encode"} <= called


@pytest.fixture(scope="session")
def of_board(tmp_path_factory: pytest.TempPathFactory) -> Measured:
    """The profile alone on a board, which the tests of boards build, too."""

    @cache
    def get(board: str) -> SizeReport:
        return measure(shared_builds(tmp_path_factory).build(board).out)

    return get


@pytest.mark.system
@pytest.mark.parametrize(
    ("board", "words"),
    spread_rows([("qemu-mps2-an386", 27), ("qemu-mps2-an385", 9)]),
    ids=["with floating-point unit", "without"],
)
def test_a_board_starts_at_reset_and_counts_its_interrupts(
    of_board: Measured, board: str, words: int
) -> None:
    stack = of_board(board).stack
    assert stack.known
    assert stack.open == (), "nothing of an image for a board is left out"
    assert stack.main is not None
    names = [link.name for link in stack.main.chain]
    assert names[0].endswith("reset")
    assert "main" in names
    assert stack.handlers
    assert stack.total == stack.main.bytes + sum(h.bytes for h in stack.handlers) + stack.hardware
    assert stack.hardware == 4 * words * len(stack.handlers), "its frame: Armv7-M B1.5.7"


def test_every_frame_of_the_chain_is_what_gcc_says(of_board: Measured) -> None:
    report = of_board("qemu-mps2-an386")
    assert report.stack.main is not None
    expected: dict[str, int] = {}
    for path in report.folder.path.rglob("*.ci"):
        expected.update({shown_name(n): f.size for n, f in parse_call_graph(path.read_text()).items()})
    compiled = [link for link in report.stack.main.chain if link.origin == "compiler"]
    assert len(compiled) > 10
    assert all(expected[link.name] == link.frame for link in compiled)


@pytest.mark.system
def test_clang_gives_no_bound_and_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if not has("clang"):
        pytest.skip("no clang")
    monkeypatch.setenv("CC", "clang")
    report = measure(build(tmp_path, PROBE + "memory: {stack: 16}\n"))
    assert not report.stack.known
    assert CALL_GRAPH in report.stack.why
    assert report.budgets == ()
    assert report.totals == berkeley("size", report.folder.path / "bin/pure_sender")


ARM = """\
00000000 <start>:
   0:\tpush\t{r4, r5, r6, lr}
   2:\tsub\tsp, #40\t@ 0x28
   4:\tvpush\t{d8-d9}
   8:\tbl\t20 <other>
   c:\tb.n\t10 <start+0x10>
  10:\tpop\t{r4, r5, r6, pc}

00000020 <other>:
  20:\tsub.w\tsp, sp, #1024\t@ 0x400
  24:\tblx\tr3
  26:\tsub.w\tsp, sp, r2
  28:\tb.w\t0 <start>
"""


def test_frames_and_calls_of_a_disassembly() -> None:
    start, other = parse_disassembly(ARM, "EM_ARM", {})
    assert (start.frame, start.calls, start.indirect, start.dynamic) == (16 + 40 + 16, {0x20}, False, False)
    assert (other.frame, other.calls, other.indirect, other.dynamic) == (1024, {0}, True, True)


RECURSIVE = """\
int f(int n, char * s);

int f(int n, char * s)
{
  char b[n + 1];

  b[n] = s[0];
  return n > 0 ? f(n - 1, b) + b[n] : s[n];
}

int main(void)
{
  char s[4] = {1, 2, 3, 4};

  return f(3, s);
}
"""


@pytest.mark.system
def test_recursion_and_frames_of_variable_size_are_named(probe_tree: Path, tmp_path: Path) -> None:
    report = run_with(probe_tree, tmp_path, RECURSIVE)
    assert report.stack.main is not None
    assert "f: recursion" in report.stack.main.open
    assert "f: a frame of variable size" in report.stack.main.open


CALLBACKS = """\
#include <rclc/rclc.h>

struct handle {
  int (*weigh)(const int * values);
  void (*nobody)(double value);
};

extern struct handle table[2]; /* in the same file, but as if from elsewhere: nothing is inlined */

__attribute__((noinline)) static int light(const int * values)
{
  return values[0];
}

__attribute__((noinline)) static int heavy(const int * values)
{
  volatile int room[100] = {0};

  room[99] = values[0];
  return room[99];
}

__attribute__((noinline)) int never_held(const int * values)
{
  volatile int room[1000] = {0};

  room[999] = values[0];
  return room[999];
}

struct handle table[2] = {{light, 0}, {heavy, 0}};

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  static rclc_support_t support;
  const int values[1] = {(int)rclc_support_init(&support, 0, NULL, &allocator)};
  int sum = never_held(values);

  for (volatile int i = 0; i < 2; i++) {
    sum += table[i].weigh(values);
    if (table[i].nobody) {
      table[i].nobody(1.0);
    }
  }
  return sum;
}
"""


def check_pointers(report: SizeReport, image: Path) -> None:
    """A pointer leads to the functions of its type whose address something holds."""
    functions = {p.address: p for p in report.chunks if p.function and p.symbol}
    pointers = read_pointers(report.folder, Elf(image), functions)
    assert {functions[a].symbol for a in pointers.targets("weigh") or ()} == {"light", "heavy"}
    assert pointers.targets("nobody") == frozenset(), "no function of that type is held anywhere"
    assert pointers.targets("no_such_member") is None
    assert report.stack.main is not None
    assert not [text for text in report.stack.main.open if "callback" in text]


@pytest.mark.system
def test_an_image_of_an_application(probe_tree: Path, tmp_path: Path) -> None:
    """Linked by somebody else, from objects anywhere: the sums are those of `size`, and its own functions count."""
    source, image = tmp_path / "robot.c", tmp_path / "robot.elf"
    source.write_text(CALLBACKS, encoding="utf-8")
    flags = ["-g", "-ffunction-sections", CALL_GRAPH, f"-I{probe_tree / 'include'}"]
    tool("gcc", *flags, "-c", source, "-o", tmp_path / "robot.o")
    linked: list[str | Path] = [tmp_path / "robot.o", probe_tree / "lib/libmicroros.a", "-o", image]
    tool("gcc", "-Wl,--gc-sections", *linked)
    unmapped = measure(probe_tree, image)
    assert (unmapped.mapped, unmapped.totals) == (False, berkeley("size", image))
    owners = {p.symbol: p.owner.group for p in unmapped.chunks if p.symbol}
    assert (owners["heavy"], owners["rcutils_get_default_allocator"]) == ("application", "component")
    tool("gcc", "-Wl,--gc-sections", f"-Wl,-Map={image.with_suffix('.map')}", *linked)
    report = measure(probe_tree, image)
    assert report.mapped
    check_pointers(report, image)
    assert report.totals == berkeley("size", image)
    owners = {p.symbol: p.owner.group for p in report.chunks if p.symbol}
    assert (owners["heavy"], owners["rcutils_get_default_allocator"]) == ("application", "component")
    assert report.stack.main is not None
    assert "never_held" in {link.name for link in report.stack.main.chain}
    other = tmp_path / "other.elf"
    tool("gcc", "-x", "c", "-", "-o", other, text="int main(void) { return 0; }")
    with pytest.raises(UserError, match="was not linked with the library"):
        measure(probe_tree, other)


def test_a_text_that_is_no_map_has_no_sections() -> None:
    assert parse_map("") == parse_map("Archive member included\nLOAD x.o\n") == ()


@pytest.mark.system
def test_what_was_not_built_is_refused(probe_tree: Path, tmp_path: Path) -> None:
    with pytest.raises(UserError, match="not an output folder"):
        measure(tmp_path)
    out = tmp_path / "out"
    shutil.copytree(probe_tree, out)
    shutil.rmtree(out / "lib")
    with pytest.raises(UserError, match="has not been built"):
        measure(out)
