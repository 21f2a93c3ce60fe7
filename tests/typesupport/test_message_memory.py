# SPDX-License-Identifier: Apache-2.0
"""Storage of messages that are sent: what sources for rclc do with strings and sequences; how blocks are planned."""

from __future__ import annotations

import itertools
import random
import re
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from microros_gen.cli import main as cli
from microros_gen.interfaces.find import shipped_folder
from microros_gen.typesupport.plan.message_pools import BlockSize, block_sizes
from tests.support.slices import only

pytestmark = pytest.mark.builds

PROGRAM = Path(__file__).parent / "message_memory.c"
PACKAGE = {
    "msg/Pair.msg": "string brief\nstring text\n",
    "msg/Part.msg": "string label\nfloat32[] values\nstring<=22 bounded\nwstring<=4 wide_bounded\n"
    "string<=5[<=2] codes\n",
    "msg/Tree.msg": "Part[] parts\nstring[2] pair\n",
    "msg/Wide.msg": "wstring text\nwstring[] texts\n",
    "msg/Defaults.msg": 'string name "gripper"\nint16[] values [3, 4]\nuint8 number 5\n',
    "srv/Ask.srv": "int32[] numbers\n---\nuint8[] data\n",
}
APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+micro_ros_utilities, +cdr_decode, +services]
nodes:
  - name: sender
    publishers:
      - {topic: joint_states, type: sensor_msgs/msg/JointState}
      - {topic: pair, type: memory_msgs/msg/Pair}
      - {topic: tree, type: memory_msgs/msg/Tree}
      - {topic: part, type: memory_msgs/msg/Part}
      - {topic: wide, type: memory_msgs/msg/Wide}
      - {topic: defaults, type: memory_msgs/msg/Defaults}
    services: [{name: ask, type: memory_msgs/srv/Ask}]
    clients: [{name: others, type: memory_msgs/srv/Ask}]
limits:
  "*": {string: 16, sequence: 6}
  memory_msgs/msg/Part: {bounded: 22}
  memory_msgs/msg/Pair: {brief: 8, text: 64}
  memory_msgs/msg/Wide: {text: 10, texts: {sequence: 2, string: 4}}
  memory_msgs/srv/Ask_Request: {numbers: 4}
  memory_msgs/srv/Ask_Response: {data: 5}
memory: {messages: 2}
"""
SANITIZE = ("-O0", "-g0", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
VARIANTS: Mapping[str, Sequence[str]] = {
    "gcc": ("gcc", *SANITIZE),
    "clang": ("clang", *SANITIZE),
    "gcc -m32": ("gcc", "-m32", "-O1", "-fsanitize=undefined", "-fno-sanitize-recover=all"),
}


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The tree of an application that sends everything that the program fills."""
    place = tmp_path_factory.mktemp("memory")
    for name, text in PACKAGE.items():
        (place / "memory_msgs" / name).parent.mkdir(parents=True, exist_ok=True)
        (place / "memory_msgs" / name).write_text(text)
    (place / "microros.yaml").write_text(APPLICATION)
    paths = ["--interface-path", str(place / "memory_msgs"), "--interface-path", str(shipped_folder())]
    with pytest.raises(SystemExit) as done:
        cli.main(["generate", "-c", str(place / "microros.yaml"), *paths, "-o", str(place / "out")])
    assert done.value.code in (0, None)
    return place / "out"


@pytest.mark.system
@pytest.mark.parametrize("variant", only({"gcc"}, VARIANTS))
def test_what_sources_do_with_messages(out: Path, variant: str) -> None:
    """Initialize, assign, copy, create, the utilities, buffers and an application's allocator: line by line in C."""
    command = VARIANTS[variant]
    if shutil.which(command[0]) is None:
        pytest.skip(f"no {command[0]}")
    image = out.parent / variant.replace(" ", "")
    sources = _sources(out)
    built = subprocess.run(
        [
            *command,
            "-std=c99",
            "-Wall",
            "-Wextra",
            "-Werror",
            f"-I{out}/include",
            PROGRAM,
            *sources,
            "-o",
            image,
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    if built.returncode != 0 and "-m32" in command and "cannot find" in built.stderr:
        pytest.skip("no 32-bit C library")
    assert built.returncode == 0, built.stderr
    done = subprocess.run([image], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


CALLS: Mapping[str, set[str]] = {
    "nothing": set(),
    "sensor_msgs__msg__JointState__init(&msg)": set(),
    'rosidl_runtime_c__String__assign(&msg.header.frame_id, "a")': {"text"},
    "rosidl_runtime_c__double__Sequence__init(&msg.position, 2)": {"double"},
    "sensor_msgs__msg__JointState__copy(&msg, &msg)": {"text", "string", "double"},
    "sensor_msgs__msg__JointState__create()": {"sensor_msgs__msg__JointState__message"},
}


@pytest.mark.system
def test_an_image_has_the_blocks_of_what_it_calls_alone(out: Path) -> None:
    """The linker drops every pool that nobody takes from."""
    objects = out.parent / "objects"
    objects.mkdir()
    split = ("-O1", "-ffunction-sections", "-fdata-sections", f"-I{out}/include")
    subprocess.run(["gcc", *split, "-c", *_sources(out)], check=True, cwd=objects)
    library = sorted(objects.glob("*.o"))
    for call, kinds in CALLS.items():
        statement = "" if call == "nothing" else f"(void){call};"
        program = (
            "#include <rosidl_runtime_c/string_functions.h>\n#include <sensor_msgs/msg/joint_state.h>\n"
            f"static sensor_msgs__msg__JointState msg;\nint main(void)\n{{\n  (void)msg;\n  {statement}\n}}\n"
        )
        link = [
            "gcc",
            *split,
            "-x",
            "c",
            "-",
            "-x",
            "none",
            *map(str, library),
            "-Wl,--gc-sections",
            "-o",
            str(out.parent / "image"),
        ]
        subprocess.run(link, input=program, text=True, check=True)
        names = subprocess.run(
            ["nm", out.parent / "image"], capture_output=True, text=True, check=True
        ).stdout
        assert set(re.findall(r" [bB] (\w+)_blocks_\d+$", names, re.MULTILINE)) == kinds, call


def _sources(out: Path) -> list[Path]:
    """Return what messages need, without sessions."""
    folders = ("cdr", "cdr_decode", "memory", "micro_ros_utilities", "rosidl_runtime", "memory_msgs")
    types = ("sensor_msgs", "std_msgs", "builtin_interfaces", "service_msgs")
    sources = [s for f in (*folders, *types) for s in sorted((out / "src" / f).glob("*.c"))]
    sources += sorted((out / "src" / "support").glob("error_*.c"))
    sources.append(out / "src" / "session" / "microros_text.c")
    return [source for source in sources if "rmw" not in source.name]


def test_equal_limits_take_what_they_need() -> None:
    assert block_sizes({17: 7}) == (BlockSize(17, 7),)
    assert block_sizes({}) == ()


def test_sizes_are_the_cheapest() -> None:
    """Against every choice of sizes."""
    chance = random.Random(3)
    for _ in range(200):
        wanted = {chance.randint(1, 300): chance.randint(1, 9) for _ in range(chance.randint(1, 7))}
        best = min(_cost(wanted, sizes) for sizes in _choices(wanted))
        assert sum(b.elements * b.count for b in block_sizes(wanted)) == best


def test_no_order_of_requests_is_refused() -> None:
    """Members take, change and free blocks at random, as message_pools.c does."""
    chance = random.Random(5)
    for _ in range(60):
        limits = [chance.choice((1, 5, 9, 17, 33, 120)) for _ in range(chance.randint(1, 12))]
        blocks = block_sizes({limit: limits.count(limit) for limit in limits})
        free = {b.elements: b.count for b in blocks}
        held = dict.fromkeys(range(len(limits)), 0)
        for _ in range(400):
            member = chance.randrange(len(limits))
            size = chance.randint(0, limits[member])
            if size == 0:
                free[held[member]] = free.get(held[member], 0) + 1
                held[member] = 0
            elif size > held[member]:
                fitting = min(s for s in (b.elements for b in blocks) if s >= size)
                assert free[fitting] > 0
                free[fitting] -= 1
                free[held[member]] = free.get(held[member], 0) + 1
                held[member] = fitting


def _choices(wanted: Mapping[int, int]) -> list[tuple[int, ...]]:
    *others, largest = sorted(wanted)
    found = (c for n in range(len(others) + 1) for c in itertools.combinations(others, n))
    return [(*choice, largest) for choice in found]


def _cost(wanted: Mapping[int, int], sizes: Sequence[int]) -> int:
    below = (0, *sizes)
    return sum(s * sum(n for x, n in wanted.items() if x > b) for b, s in zip(below, sizes, strict=False))
