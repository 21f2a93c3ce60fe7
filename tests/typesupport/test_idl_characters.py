# SPDX-License-Identifier: Apache-2.0
"""`char` and `wchar`, which .idl files alone have, against the C and the Fast CDR type support of ROS 2 Jazzy.

No wheel has a message with them, so ROS 2's generators make one here.
"""

from __future__ import annotations

import ctypes
from pathlib import Path

import pytest

from microros_gen.documents.templates import shared_environment
from microros_gen.typesupport.plan.members import TABLES_HEADER
from microros_gen.typesupport.plan.types import TypePlan
from microros_gen.typesupport.views.members import render_members
from tests.support.slices import first
from tests.support.typesupport import cdr
from tests.support.typesupport.build import (
    COMPONENTS,
    TEST_RULES,
    WARNINGS,
    Generated,
    compile_shared,
    generate,
    run,
)
from tests.support.typesupport.decoder import Decoder
from tests.support.typesupport.encoder import Encoder
from tests.support.typesupport.layout import facts, facts_program
from tests.support.typesupport.memory import Memory
from tests.support.typesupport.rosidl import RosPackage, make_ros_package
from tests.support.typesupport.values import Randomizer

pytestmark = [pytest.mark.ros, pytest.mark.builds]
pytest.importorskip("rosidl_typesupport_fastrtps_c")

PACKAGE = {
    "Pair": "struct Pair { wchar wide; char first; @default (value=66) char second; };",
    "Letters": """
  typedef char char__3[3];
  module Letters_Constants {
    const char LEAST = -128;
    const char LETTER = 65;
    const wchar LAMBDA = 955;
    const wchar LARGEST = 65535;
  };
  struct Letters {
    @default (value=-3) char one;
    wchar two;
    octet three;
    @default (value=955) wchar four;
    @default (value="(1, -2, 127)") char__3 five;
    sequence<char> six;
    sequence<char, 4> seven;
    @default (value="(7, -8)") sequence<char> eight;
    wchar nine;
    double ten;
    string text;
    wchar last;
  };""",
    "Words": """
  typedef letters::msg::Pair Pair__3[3];
  struct Words { Pair__3 pairs; sequence<letters::msg::Pair> more; sequence<letters::msg::Letters> all; };""",
}
SAMPLES = ("empty", "full", *("random",) * 60)


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The package as .idl files."""
    folder = tmp_path_factory.mktemp("idl") / "letters"
    (folder / "msg").mkdir(parents=True)
    for name, text in PACKAGE.items():
        includes = "".join(f'#include "letters/msg/{n}.idl"\n' for n in PACKAGE if f"::{n}" in text)
        (folder / "msg" / f"{name}.idl").write_text(
            f"{includes}module letters {{ module msg {{{text}\n}}; }};\n"
        )
    return folder


@pytest.fixture(scope="module")
def ros(source: Path, tmp_path_factory: pytest.TempPathFactory) -> RosPackage:
    """The result of ROS 2."""
    return make_ros_package(source, "letters", list(PACKAGE), tmp_path_factory.mktemp("ros"))


@pytest.fixture(scope="module")
def letters(source: Path, tmp_path_factory: pytest.TempPathFactory) -> Generated:
    """What is generated here."""
    return generate(["letters"], TEST_RULES, tmp_path_factory.mktemp("letters"), [source.parent])


@pytest.fixture(scope="module")
def compiled(letters: Generated) -> ctypes.CDLL:
    """The generated C as a shared library."""
    return compile_shared(letters)


@pytest.mark.system
def test_structs_constants_and_hashes_are_those_of_rosidl(letters: Generated, ros: RosPackage) -> None:
    program = facts_program(letters, list(letters.plans))
    own, theirs = facts(program, letters.includes), facts(program, ros.includes)
    assert own == theirs
    assert "letters__msg__Letters__LEAST -128" in own
    assert "letters__msg__Letters__LARGEST 65535" in own
    for plan in letters.plans:
        assert plan.type_hash == ros.type_hash(plan.name.name)


def test_bytes_are_those_of_fast_cdr(letters: Generated, compiled: ctypes.CDLL, ros: RosPackage) -> None:
    """Both ways, both byte orders; a wchar takes two bytes, though a unit of a wstring takes four."""
    for plan in letters.plans:
        encoder, decoder = Encoder(compiled, plan.c_name), Decoder(compiled, letters, plan)
        values = Randomizer(letters.messages, 77)
        for mode in SAMPLES:
            tree = values.tree(plan.name, plan.limits, mode)
            filled = decoder.structs.fill(plan.name, tree)
            body = encoder.encode(filled)
            big = cdr.encode(letters.messages, plan.name, tree, True)
            assert body == cdr.encode(letters.messages, plan.name, tree, False)
            assert decoder.decode(body) == decoder.decode(big, swap=True) == tree
            for order, text in ((False, body), (True, big)):
                theirs = decoder.structs.structure(plan.name)()
                ros.init(plan.name.name, theirs)
                ros.read(plan.name.name, text, order, theirs)
                assert decoder.structs.read(plan.name, theirs) == tree
                assert ros.write(plan.name.name, theirs) == body
            if mode == "full":
                assert len(body) == plan.max_encoded_size


def test_a_wide_character_takes_two_bytes(letters: Generated, compiled: ctypes.CDLL) -> None:
    pair = letters.plan("letters/msg/Pair")
    filled = Decoder(compiled, letters, pair).structs.fill(
        pair.name, {"wide": 0xFFFE, "first": -2, "second": 65}
    )
    assert Encoder(compiled, pair.c_name).encode(filled) == b"\xfe\xff\xfe\x41"


@pytest.mark.parametrize("name", PACKAGE)
def test_defaults_copies_and_equality(
    letters: Generated, compiled: ctypes.CDLL, ros: RosPackage, name: str
) -> None:
    plan = letters.plan(f"letters/msg/{name}")
    memory = Memory()
    compiled.test_set_allocator(ctypes.byref(memory.allocator))
    encoder, decoder = Encoder(compiled, plan.c_name), Decoder(compiled, letters, plan)
    theirs, ours, copy = (decoder.structs.structure(plan.name)() for _ in range(3))
    ros.init(name, theirs)
    expected = ros.write(name, theirs)
    assert function(compiled, plan, "init")(ctypes.byref(ours))
    assert function(compiled, plan, "init")(ctypes.byref(copy))
    assert encoder.encode(ours) == expected
    if plan.storage:
        assert encoder.encode(decoder.bind()) == expected
    change(name, ours)
    assert not function(compiled, plan, "are_equal")(ctypes.byref(ours), ctypes.byref(copy))
    assert function(compiled, plan, "copy")(ctypes.byref(ours), ctypes.byref(copy))
    assert function(compiled, plan, "are_equal")(ctypes.byref(ours), ctypes.byref(copy))
    for message in (ours, copy):
        function(compiled, plan, "fini")(ctypes.byref(message))
    assert not memory.live


def change(name: str, message: ctypes.Structure) -> None:
    """Change one character."""
    if name == "Words":
        message.pairs[2].first = 1
    elif name == "Letters":
        message.last = 1
    else:
        message.second = -1


def function(library: ctypes.CDLL, plan: TypePlan, name: str) -> ctypes._NamedFuncPointer:
    found = library[f"{plan.c_name}__{name}"]
    found.restype = ctypes.c_bool if name != "fini" else None
    return found


@pytest.mark.parametrize("compiler", first([["gcc", "-m32"], ["clang"], ["clang", "-m32"]]))
def test_sizes_hold_for_other_data_models(letters: Generated, compiler: list[str], tmp_path: Path) -> None:
    sources = letters.sources("__type_support.c", "__storage.c", "__functions.c", "__decode.c")
    for path, content in render_members(letters.plans, shared_environment()).items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_bytes(content)
    tables = sorted(tmp_path.rglob("*__members.c"))
    assert {"MICROROS_MEMBER_CHAR", "MICROROS_MEMBER_WCHAR"} <= set(
        tables[0].read_text().replace(",", " ").split()
    )
    headers = [
        f"-I{COMPONENTS / 'micro_ros_utilities' / 'include'}",
        f"-I{(tmp_path / TABLES_HEADER).parents[1]}",
    ]
    for source in (*sources, *tables):
        run([*compiler, "-fsyntax-only", *WARNINGS, *headers, *letters.includes, source])
