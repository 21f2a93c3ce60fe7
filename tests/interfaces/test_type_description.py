# SPDX-License-Identifier: Apache-2.0
"""Type descriptions and hashes against the .json files that ROS 2 installs, and against its generator."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import InterfaceSet, resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder
from microros_gen.interfaces.type_description import type_description, type_hash, type_id
from microros_gen.interfaces.types import (
    ArrayType,
    Constant,
    ElementType,
    Field,
    Message,
    NamedType,
    Primitive,
    SequenceType,
    StringType,
    TypeName,
)
from tests.support.ids import without_id
from tests.support.interfaces.rosidl_pipeline import ros_message

SHARE = Path(sys.prefix) / "share"


@pytest.fixture(scope="module")
def installed() -> InterfaceSet:
    """Return every message that ROS 2 installs in this environment."""
    finder = InterfaceFinder(pip=(Path(sys.prefix),))
    diagnostics = Diagnostics()
    names = tuple(Named(place.name) for place in finder.packages() if finder.types(place.name))
    interfaces = resolve_interfaces(names, finder, diagnostics)
    diagnostics.check()
    return interfaces


@pytest.mark.ros
def test_every_installed_description_and_hash_is_equal(installed: InterfaceSet) -> None:
    """Messages, services, actions and everything derived from them: all hashes of each .json."""
    compared = {"msg": 0, "srv": 0, "action": 0}
    hashed = set()
    for interface in installed:
        path = SHARE / interface.name.package / interface.name.kind / f"{interface.name.name}.json"
        if not path.exists():  # test_interface_files brings none
            continue
        expected = json.loads(path.read_text(encoding="utf-8"))
        assert installed.type_description(interface.name) == expected["type_description_msg"]
        hashes = {entry["type_name"]: entry["hash_string"] for entry in expected["type_hashes"]}
        for name in (interface.name, *installed.closure(interface.name)):
            hashed.add(name)
            assert installed.type_hash(name) == hashes.pop(str(name))
        assert not hashes, "our closure lacks these"
        compared[interface.name.kind] += 1
    assert compared == {"msg": 169, "srv": 28, "action": 2}
    installed_kinds = {n for n in installed.described if n.package != "test_interface_files"}
    assert hashed == installed_kinds


@pytest.mark.ros
def test_the_installed_idl_files_give_the_same(installed: InterfaceSet, tmp_path: Path) -> None:
    """The folders of the wheels with nothing but their .idl files: same descriptions and hashes."""
    for path in SHARE.glob("*/*/*.idl"):
        folder = tmp_path / path.parent.parent.name / path.parent.name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / path.name).write_bytes(path.read_bytes())
    finder = InterfaceFinder((tmp_path,))
    diagnostics = Diagnostics()
    names = tuple(Named(place.name) for place in finder.packages())
    interfaces = resolve_interfaces(names, finder, diagnostics)
    assert [without_id(d.headline()) for d in diagnostics] == []
    assert len(interfaces) == 199
    for name in interfaces.described:
        assert interfaces.type_description(name) == installed.type_description(name)
        assert interfaces.type_hash(name) == installed.type_hash(name)


@pytest.mark.system
@pytest.mark.ros
def test_the_other_descriptions_are_those_of_the_generator_of_ros(
    installed: InterfaceSet, tmp_path: Path
) -> None:
    from rosidl_generator_type_description import calculate_type_hash, extract_full_type_description

    theirs: dict[str, Any] = {}
    for path in sorted((SHARE / "test_interface_files" / "msg").glob("*.msg")):
        described = ros_message(path.read_text(encoding="utf-8"), tmp_path, "test_interface_files", path.stem)
        assert described is not None
        theirs[described.description["type_name"]] = described.description
    assert len(theirs) == 12
    for name in theirs:
        full = extract_full_type_description(name, theirs)
        ours = TypeName(*name.split("/"))
        assert installed.type_description(ours) == full
        assert installed.type_hash(ours) == calculate_type_hash(full)


def test_numbers_of_types_are_those_of_field_type() -> None:
    """FieldType of type_description_interfaces (REP-2016), by the names of its constants."""
    finder = InterfaceFinder.from_environment(environ={}, prefix=Path("/nowhere"))
    interfaces = resolve_interfaces((Named("type_description_interfaces/FieldType"),), finder, Diagnostics())
    numbers = {c.name: c.value for c in interfaces.message(interfaces.roots[0]).constants}
    names: dict[str, ElementType] = {
        "NESTED_TYPE": NamedType(TypeName("a", "msg", "B")),
        "STRING": StringType(),
        "WSTRING": StringType(wide=True),
        "BOUNDED_STRING": StringType(bound=5),
        "BOUNDED_WSTRING": StringType(wide=True, bound=5),
        "BOOLEAN": Primitive.BOOL,
        "BYTE": Primitive.BYTE,
        "FLOAT": Primitive.FLOAT32,
        "DOUBLE": Primitive.FLOAT64,
        **{p.value.upper(): p for p in Primitive if "int" in p.value},
    }
    for name, kind in names.items():
        assert type_id(kind) == numbers[f"FIELD_TYPE_{name}"]
        assert type_id(ArrayType(kind, 3)) == numbers[f"FIELD_TYPE_{name}_ARRAY"]
        assert type_id(SequenceType(kind, 3)) == numbers[f"FIELD_TYPE_{name}_BOUNDED_SEQUENCE"]
        assert type_id(SequenceType(kind)) == numbers[f"FIELD_TYPE_{name}_UNBOUNDED_SEQUENCE"]
    assert type_id(Primitive.CHAR) == numbers["FIELD_TYPE_UINT8"]


def message(*fields: Field, constants: tuple[Constant, ...] = (), comment: tuple[str, ...] = ()) -> Message:
    return Message(TypeName("pkg", "msg", "Foo"), fields, constants, comment)


def test_the_hash_covers_names_and_types_and_nothing_else() -> None:
    base = message(Field("a", Primitive.INT32))
    known = type_hash(base, {})
    assert known.startswith("RIHS01_")
    assert len(known) == 71
    assert type_hash(message(Field("a", Primitive.INT32, 5, ("text",)), comment=("x",)), {}) == known
    assert type_hash(message(*base.fields, constants=(Constant("A", Primitive.BOOL, True),)), {}) == known
    assert type_hash(message(Field("b", Primitive.INT32)), {}) != known
    assert type_hash(message(Field("a", Primitive.UINT32)), {}) != known


def test_a_message_without_fields_has_the_member_that_idl_needs() -> None:
    field = Field("structure_needs_at_least_one_member", Primitive.UINT8)
    assert type_hash(message(), {}) == type_hash(message(field), {})


def test_descriptions_write_defaults_as_ros_does() -> None:
    fields = (
        Field("a", Primitive.BOOL, True),
        Field("b", Primitive.FLOAT64, 1e-7),
        Field("c", StringType(), "it's"),
        Field("d", SequenceType(Primitive.INT8), (1,)),
        Field("e", SequenceType(StringType()), ("x", "y")),
    )
    described = type_description(message(*fields), {})["type_description"]["fields"]
    assert [f["default_value"] for f in described] == ["True", "1e-07", "it's", "(1,)", "('x', 'y')"]
