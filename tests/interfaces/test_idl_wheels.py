# SPDX-License-Identifier: Apache-2.0
"""The .idl files that ROS 2 Jazzy installs: the same model as the files they came from, the hashes of the .json."""

from __future__ import annotations

import json
import re
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.interfaces.derived import messages_of, structures_of
from microros_gen.interfaces.msg.action import parse_action
from microros_gen.interfaces.msg.parser import parse_msg
from microros_gen.interfaces.msg.srv import parse_srv
from microros_gen.interfaces.omg_idl.parser import parse_idl, read_idl
from microros_gen.interfaces.omg_idl.text import idl_text
from microros_gen.interfaces.type_description import type_hash
from microros_gen.interfaces.types import (
    Action,
    ArrayType,
    Constant,
    Declaration,
    Field,
    FieldType,
    Message,
    Primitive,
    SequenceType,
    Service,
    TypeName,
)
from tests.support.ids import without_id
from tests.support.slices import spread

pytestmark = pytest.mark.ros
SHARE = Path(sys.prefix) / "share"
INSTALLED = sorted(p for kind in ("msg", "srv", "action") for p in SHARE.glob(f"*/{kind}/*.idl"))
FIRST_FORMS = sorted(p for kind in ("msg", "srv", "action") for p in SHARE.glob(f"*/{kind}/*.{kind}"))
READERS: dict[str, Callable[[Source, TypeName, Diagnostics], Declaration | None]] = {
    "msg": parse_msg,
    "srv": parse_srv,
    "action": parse_action,
}
UNIT = re.compile(r"\s*\[([^,\]]+)\]")


def source(path: Path) -> Source:
    return Source(str(path), path.read_text(encoding="utf-8"))


def type_name(path: Path) -> TypeName:
    return TypeName(path.parent.parent.name, path.parent.name, path.stem)


def from_idl(text: Source, name: TypeName) -> Declaration:
    diagnostics = Diagnostics()
    declarations = parse_idl(text, name.package, name.kind, diagnostics)
    assert [without_id(d.headline()) for d in diagnostics if d.message.endswith("keyword of C++")] == []
    diagnostics.check()
    assert len(declarations) == 1
    return declarations[0]


@lru_cache(maxsize=1)
def installed() -> dict[TypeName, Declaration]:
    return {type_name(path): from_idl(source(path), type_name(path)) for path in INSTALLED}


@lru_cache(maxsize=1)
def first_forms() -> dict[TypeName, Declaration]:
    found = {}
    for path in FIRST_FORMS:
        declaration = READERS[path.parent.name](source(path), type_name(path), Diagnostics())
        assert declaration is not None, path
        found[type_name(path)] = declaration
    return found


def bare_type(field_type: FieldType) -> FieldType:
    """Return the type as .idl files know it: `char` of a .msg file is uint8 there."""
    if isinstance(field_type, (ArrayType, SequenceType)):
        element = Primitive.UINT8 if field_type.element is Primitive.CHAR else field_type.element
        return replace(field_type, element=element)
    return Primitive.UINT8 if field_type is Primitive.CHAR else field_type


def bare(message: Message) -> Message:
    """Return the message without places and without comments."""
    fields = tuple(Field(f.name, bare_type(f.type), f.default) for f in message.fields)
    constants = tuple(
        replace(c, type=Primitive.UINT8 if c.type is Primitive.CHAR else c.type, comment=(), span=None)
        for c in message.constants
    )
    return Message(message.name, fields, constants)


def words(comment: tuple[str, ...]) -> tuple[str, list[str]]:
    """Return the words of a comment without units, and the units: their place is not in the .idl file."""
    text = "\n".join(comment)
    units = UNIT.findall(text)
    return (" ".join(UNIT.sub("", text).split()), units) if len(units) == 1 else (" ".join(text.split()), [])


def documented(message: Message) -> list[Constant | Field]:
    return [*message.constants, *message.fields]


def comments(message: Message) -> list[tuple[str, list[str]]]:
    """Return the words of every comment; rosidl_adapter drops units of constants and of the struct itself."""
    own = [message.comment, *(constant.comment for constant in message.constants)]
    others: list[tuple[str, list[str]]] = [(words(comment)[0], []) for comment in own]
    return others + [words(field.comment) for field in message.fields]


def test_there_are_as_many_files_as_jazzy_installs() -> None:
    assert (len(INSTALLED), len(FIRST_FORMS)) == (199, 215)


def test_an_idl_file_gives_the_model_of_the_file_it_came_from() -> None:
    assert set(installed()) <= set(first_forms())
    for name, declaration in installed().items():
        first = first_forms()[name]
        assert type(declaration) is type(first)
        pairs = zip(messages_of(declaration), messages_of(first), strict=True)
        for ours, other in pairs:
            assert bare(ours) == bare(other), name
            assert comments(ours) == comments(other), ours.name


def test_comments_of_idl_files_keep_their_lines() -> None:
    pairs = ((installed()[n], first_forms()[n]) for n in installed())
    same = differing = 0
    for ours, other in (
        (a, b) for d, f in pairs for a, b in zip(messages_of(d), messages_of(f), strict=True)
    ):
        for item, counterpart in zip(documented(ours), documented(other), strict=True):
            if item.comment == counterpart.comment:
                same += 1
            else:
                # Only what rosidl_adapter takes out of a line as a unit, or what looks like one.
                assert words(counterpart.comment)[1], (
                    ours.name,
                    item.name,
                    item.comment,
                    counterpart.comment,
                )
                differing += 1
    assert same > 20 * differing > 0


def test_every_installed_type_has_the_hash_of_its_json() -> None:
    closure = {m.name: m for d in installed().values() for m in structures_of(d)}
    checked = 0
    for name, declaration in installed().items():
        path = SHARE / name.package / name.kind / f"{name.name}.json"
        hashes = {h["type_name"]: h["hash_string"] for h in json.loads(path.read_text())["type_hashes"]}
        for structure in structures_of(declaration):
            assert type_hash(structure, closure) == hashes[str(structure.name)], structure.name
            checked += 1
    assert checked > 300


def test_includes_name_every_package_that_is_needed() -> None:
    for path in INSTALLED:
        name = type_name(path)
        file = read_idl(source(path), name.package, name.kind, Diagnostics())
        text = idl_text(file.declarations[0])
        again = read_idl(Source("again.idl", text), name.package, name.kind, Diagnostics())
        assert sorted(i.path for i in again.includes) == sorted(i.path for i in file.includes), name


def test_printed_text_is_read_back() -> None:
    for name, declaration in first_forms().items():
        again = from_idl(Source("again.idl", idl_text(declaration)), name)
        for ours, other in zip(messages_of(again), messages_of(declaration), strict=True):
            assert bare(ours) == bare(other), name
            assert comments(ours) == comments(other), ours.name


@pytest.mark.parametrize("name", spread(["std_msgs/msg/Empty", "test_msgs/msg/Defaults", "test_msgs/msg/Arrays",
    "test_msgs/msg/WStrings", "test_msgs/msg/Constants", "sensor_msgs/msg/Imu", "test_msgs/srv/Arrays",
    "test_msgs/action/NestedMessage", "diagnostic_msgs/msg/DiagnosticStatus", "sensor_msgs/msg/Range"]))  # fmt: skip
def test_printed_text_is_to_rosidl_what_the_installed_file_is(name: str, tmp_path: Path) -> None:
    from tests.support.interfaces.rosidl_idl_pipeline import ros_idl

    path = SHARE / f"{name}.idl"
    text = idl_text(installed()[type_name(path)])
    theirs = ros_idl(path.read_text(encoding="utf-8"), tmp_path, path.parent.name)
    assert theirs is not None
    assert ros_idl(text, tmp_path, path.parent.name) == theirs


def test_all_files_are_read_fast() -> None:
    texts = [(source(path), type_name(path)) for path in INSTALLED]
    from_idl(*texts[0])
    begin = time.process_time()
    for text, name in texts:
        from_idl(text, name)
    assert time.process_time() - begin < 1.5


def test_kinds_of_declarations() -> None:
    kinds = {Message: "msg", Service: "srv", Action: "action"}
    assert all(kinds[type(declaration)] == name.kind for name, declaration in installed().items())
