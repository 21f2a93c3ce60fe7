# SPDX-License-Identifier: Apache-2.0
"""micro_ros_utilities in applications written as users of micro-ROS write them.

Capacities are held against what the public library gives for the same configuration, read from its sources
(github.com/micro-ROS/micro_ros_utilities, rolling 4757528): a number for each member, in EXPECTED.
"""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

from microros_gen.cli import main as cli
from microros_gen.interfaces.find import shipped_folder
from tests.support.slices import first
from tests.support.typesupport.build import WARNINGS, run
from tests.support.typesupport.utilities import APPLICATION, CASES, PACKAGE, PROGRAM, SMALL

pytestmark = [
    pytest.mark.skipif(shutil.which("gcc") is None or shutil.which("nm") is None, reason="no gcc or no nm"),
    pytest.mark.builds,
]

SANITIZE = "-fsanitize=address,undefined"
VARIANTS: Mapping[str, tuple[str, ...]] = {
    "gcc": ("gcc", "-O0", SANITIZE, "-fno-sanitize-recover=all"),
    "clang": ("clang", "-O0", SANITIZE, "-fno-sanitize-recover=all"),
    "gcc -m32": ("gcc", "-m32", "-O0", "-fsanitize=undefined", "-fno-sanitize-recover=all"),
}
POINTER = {"gcc": 8, "clang": 8, "gcc -m32": 4}


def generate(place: Path, application: str, *options: str) -> Path:
    """Write the output folder of an application and return it."""
    place.mkdir(parents=True)
    for name, text in PACKAGE.items():
        (place / "utilities_msgs" / "msg").mkdir(parents=True, exist_ok=True)
        (place / "utilities_msgs" / "msg" / name).write_text(text)
    file = place / "microros.yaml"
    file.write_text(application)
    interfaces = [
        "--interface-path",
        str(place / "utilities_msgs"),
        "--interface-path",
        str(shipped_folder()),
    ]
    verb, *others = options or ("generate",)
    with pytest.raises(SystemExit) as done:
        cli.main([verb, "-c", str(file), *interfaces, *others, "-o", str(place / "out")])
    assert done.value.code in (0, None)
    return place / "out"


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The tree of every type that the program uses, with the component."""
    components = "[+micro_ros_utilities]"
    return generate(tmp_path_factory.mktemp("utilities") / "with", APPLICATION.format(components=components))


@pytest.fixture(scope="module")
def program(out: Path) -> Callable[[str], Path]:
    """Return a function that compiles the program in one of VARIANTS."""

    @cache
    def compiled(variant: str) -> Path:
        command = VARIANTS[variant]
        if shutil.which(command[0]) is None:
            pytest.skip(f"no {command[0]}")
        source = out.parent / "program.c"
        source.write_text(PROGRAM)
        types = out.parent / "types.c"
        generated = sorted(p for p in (out / "src").rglob("*.c") if "__" in p.name)
        endings = ("__members.c", "__type_support.c", "__storage.c", "__functions.c")
        types.write_text("".join(f'#include "{p}"\n' for p in generated if p.name.endswith(endings)))
        library = [*(out / "src/micro_ros_utilities").glob("*.c"), *(out / "src/memory").glob("*.c")]
        library += [*(out / "src/support").glob("error_*.c"), *(out / "src/rosidl_runtime").glob("*.c")]
        library += [out / "src/session/microros_text.c"]
        image = out.parent / f"program-{variant.replace(' ', '')}"
        probe = ["-x", "c", "-", "-o", "/dev/null"]
        empty = subprocess.run(
            [*command, *probe], input="int main(void) { return 0; }", text=True, check=False
        )
        if empty.returncode != 0:
            pytest.skip(f"{variant} does not link here")
        run([*command, *WARNINGS, f"-I{out}/include", source, types, *sorted(library), "-o", image])
        return image

    return compiled


@dataclass(frozen=True)
class Said:
    """What a case printed, by the word before the colon."""

    lines: tuple[tuple[str, str], ...]

    def __getitem__(self, key: str) -> str:
        return dict(self.lines)[key]

    def numbers(self) -> dict[str, int]:
        return {key: int(value) for key, value in self.lines}


def say(image: Path, case: str) -> Said:
    lines = run([image, case]).splitlines()
    return Said(tuple((a, b) for a, _, b in (line.partition(": ") for line in lines)))


@pytest.mark.parametrize("variant", first(VARIANTS))
@pytest.mark.parametrize("case", CASES)
def test_capacities(program: Callable[[str], Path], variant: str, case: str) -> None:
    """From an allocator and from a buffer, at every alignment, with every byte of it written by the program."""
    found = say(program(variant), case).numbers()
    expected, sizes = CASES[case]
    wanted = {**expected, "size": sizes(POINTER[variant])}
    assert {key: found[key] for key in wanted} == wanted
    # What the allocator was asked for is what was announced, and all of it came back.
    assert found["asked"] == found["size"]
    assert found["left"] == 0
    # The buffer: capacities are the same, the announced size is what the worst place needs, one byte less is refused.
    assert found["same"] == 1
    assert found["static"] == found["needed"]
    assert found["smaller"] == 0
    assert found["overlaps"] == 0


@pytest.mark.parametrize("variant", first(VARIANTS))
def test_every_failing_allocation_leaves_nothing(program: Callable[[str], Path], variant: str) -> None:
    found = say(program(variant), "failing").numbers()
    assert found["calls"] > 10
    assert found["succeeded"] == found["held"] == found["dirty"] == 0


def test_what_is_refused_says_why(program: Callable[[str], Path]) -> None:
    found = say(program("gcc"), "refused")
    rule = "memory rule '{}' names no string or sequence of sensor_msgs/msg/JointState"
    for name in (
        "nam",
        "names",
        "header",
        "header.stamp",
        "header.frame_id.data",
        "name.datum",
        "name.data.x",
        "",
    ):
        assert found[f"rule {name}"] == f"0 0 0 0 {rule.format(name)}"
    assert found["no rules"] == "0 0 0 0 conf.rules: NULL or not initialized"
    assert found["no text"] == "0 0 0 0 conf.rules[].rule: NULL or not initialized"
    assert found["no type"] == "0 0 0 0 type_support: NULL or not initialized"
    assert found["other type"] == "0 0 0 0 type_support: NULL or not initialized"
    assert found["no message"] == "0 ros_msg: NULL or not initialized"
    assert found["no buffer"] == "0 buffer: NULL or not initialized"
    assert found["small buffer"] == "0 the buffer has 19 bytes and the message takes 20"
    assert found["allocator"] == "0 the allocator gives no memory for 20 bytes"
    assert found["arena"] == "0 no memory for 9000 bytes: raise memory: {arena: 17208} in microros.yaml"
    assert found["overflow"] == "0 0 0 0 the allocator gives no memory for 4294967295 bytes"


def test_type_info(program: Callable[[str], Path]) -> None:
    text = run([program("gcc"), "info"])
    assert text == (
        "\tIntrospection for std_msgs__msg/MultiArrayLayout - 2 members, 32 B\n"
        "\t - dim [Sequence of ROS2 type std_msgs__msg/MultiArrayDimension] <- This should be inited\n"
        "\t\t - label [string] <- This should be inited\n"
        "\t\t - size [uint32]\n"
        "\t\t - stride [uint32]\n"
        "\t - data_offset [uint32]\n"
    )


@pytest.mark.parametrize("variant", first(VARIANTS))
def test_strings(program: Callable[[str], Path], variant: str) -> None:
    found = dict(say(program(variant), "strings").lines)
    assert found == {
        "init": "hello 5 6",
        "empty": " 0 1",
        "with size": " 0 11",
        "set shorter": "hi 2 6",
        "set longer": "good morning 12 13",
        "set as long as the capacity": "abcdefghijklm 13 14",
        "append": "abcdefghijklm, n 16 17",
        "append in place": "ab 2 11",
        "cut": "abcdefghijk 11 17",
        "cut all": " 0 17",
        "static": "0123 4 5 stays 1",
        "static grown": "0123456 7 8 left 1",
        "no memory": "hi 2 6",
        "no memory at all": "NULL 0 0",
        "destroyed": "NULL 0 0",
        "left": "0",
    }


def test_above_the_limit_is_refused_by_name(program: Callable[[str], Path]) -> None:
    """The utilities allocate what is requested; the encoder checks the limits of the application file."""
    found = say(program("gcc"), "limit")
    assert found["fits"] == "30"
    assert found["above"] == "0 data 26 25"


def symbols(path: Path) -> str:
    return run(["nm", path])


def names(image: Path) -> set[str]:
    """Return the symbols of an image except for the one of its plan id."""
    found = {line.split()[-1] for line in symbols(image).splitlines()}
    return {name for name in found if "__plan_" not in name}


@pytest.mark.system
def test_images_hold_tables_only_where_a_function_needs_them(tmp_path: Path) -> None:
    """Without the component there is no table; with it, none where nobody calls."""
    without = generate(tmp_path / "without", SMALL.format(components="[]"), "build")
    assert not list(without.rglob("*__members.*"))
    assert not (without / "include/microros/type_tables.h").exists()
    header = (without / "include/micro_ros_utilities/type_utilities.h").read_text()
    assert header.startswith("#error")
    assert "components: [+micro_ros_utilities]" in header
    assert "__members" not in symbols(without / "lib/libmicroros.a")
    selected = generate(tmp_path / "with", SMALL.format(components="[+micro_ros_utilities]"), "build")
    assert "std_msgs__msg__String__members" in symbols(selected / "lib/libmicroros.a")
    assert names(selected / "bin/pure_sender") == names(without / "bin/pure_sender")
    user = tmp_path / "user.c"
    user.write_text(
        "#include <micro_ros_utilities/string_utilities.h>\n"
        'int main(void)\n{\n  rosidl_runtime_c__String text = micro_ros_string_utilities_init("text");\n'
        "  micro_ros_string_utilities_destroy(&text);\n  return 0;\n}\n"
    )
    run(["gcc", f"-I{selected}/include", user, selected / "lib/libmicroros.a", "-o", tmp_path / "user"])
    assert "__members" not in symbols(tmp_path / "user")
