# SPDX-License-Identifier: Apache-2.0
"""The cheap frozen data classes of the package do what those of the standard library do."""

from __future__ import annotations

import copy
import dataclasses
import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

import pytest

import microros_gen
from microros_gen import records

PACKAGE = Path(microros_gen.__file__).parent


def classes(dataclass: Callable[..., Any]) -> dict[str, Any]:
    """Define the same classes with a decorator."""

    @dataclass(frozen=True)
    class Empty:
        """No field."""

    @dataclass(frozen=True)
    class Point:
        x: int
        y: int = 2
        names: list[str] = dataclasses.field(default_factory=list, compare=False)
        hidden: str = dataclasses.field(default="h", repr=False)
        unit: ClassVar[str] = "m"

    @dataclass(frozen=True)
    class Far(Point):
        z: int = 3

    @dataclass(frozen=True, kw_only=True)
    class Named(Far):
        name: str

    @dataclass(frozen=True)
    class Sum:
        parts: tuple[int, ...]
        total: int = 0

        def __post_init__(self) -> None:
            object.__setattr__(self, "total", sum(self.parts))

    @dataclass(frozen=True)
    class Odd:
        value: int

        def __eq__(self, other: object) -> bool:
            return True

        def __hash__(self) -> int:
            return 5

    return {c.__name__: c for c in (Empty, Point, Far, Named, Sum, Odd)}


OURS, THEIRS = classes(records.dataclass), classes(dataclasses.dataclass)
CALLS = [
    ("Empty", (), {}),
    ("Point", (1,), {}),
    ("Point", (1, 5), {"hidden": "k"}),
    ("Point", (), {"x": 7, "names": ["a"]}),
    ("Far", (1, 2), {"z": 9}),
    ("Named", (1,), {"name": "n"}),
    ("Sum", ((1, 2),), {}),
    ("Odd", (1,), {}),
]


@pytest.mark.parametrize("before", [0, 100])
@pytest.mark.parametrize(("name", "arguments", "named"), CALLS)
def test_instances_are_as_those_of_the_standard_library(
    name: str, arguments: tuple[Any, ...], named: dict[str, Any], before: int
) -> None:
    """The first ones of a class, and those after them: `__init__` is compiled for a class with many instances."""
    for _ in range(before):
        OURS[name](*arguments, **named)
    ours, theirs = OURS[name](*arguments, **named), THEIRS[name](*arguments, **named)
    assert repr(ours) == repr(theirs)
    assert dataclasses.asdict(ours) == dataclasses.asdict(theirs)
    assert [f.name for f in dataclasses.fields(ours)] == [f.name for f in dataclasses.fields(theirs)]
    assert ours == OURS[name](*arguments, **named) == copy.copy(ours)
    assert name == "Odd" or ours != theirs
    if name != "Odd":
        values = dataclasses.astuple(theirs)
        compared = [f.compare for f in dataclasses.fields(theirs)]
        assert hash(ours) == hash(tuple(v for v, used in zip(values, compared, strict=True) if used))


def test_fields_that_are_not_compared_do_not_count() -> None:
    point = OURS["Point"]
    assert point(1, names=["a"]) == point(1, names=["b"])
    assert hash(point(1, names=["a"])) == hash(point(1))
    assert point(1) != point(1, hidden="other")
    assert point(1) != OURS["Far"](1)


def test_methods_that_a_class_has_stay() -> None:
    assert hash(OURS["Odd"](1)) == 5
    assert OURS["Odd"](1) == OURS["Odd"](2)


def test_each_instance_has_its_own_default() -> None:
    assert OURS["Point"](1).names is not OURS["Point"](1).names


def test_a_copy_with_changes_is_made_as_ever() -> None:
    assert repr(dataclasses.replace(OURS["Named"](1, name="n"), y=8)) == repr(
        dataclasses.replace(THEIRS["Named"](1, name="n"), y=8)
    )


@pytest.mark.parametrize("name", ["y", "new"])
def test_nothing_is_set_or_deleted(name: str) -> None:
    point = OURS["Point"](1)
    with pytest.raises(dataclasses.FrozenInstanceError, match=name):
        setattr(point, name, 3)
    with pytest.raises(dataclasses.FrozenInstanceError, match=name):
        delattr(point, name)


@pytest.mark.parametrize(
    ("arguments", "named"), [((), {}), ((1, 2, [], "h", 5), {}), ((1,), {"other": 1}), ((1,), {"x": 1})]
)
def test_wrong_arguments_are_refused_in_the_same_words(
    arguments: tuple[Any, ...], named: dict[str, Any]
) -> None:
    texts = []
    for kind in (classes(records.dataclass), THEIRS):
        with pytest.raises(TypeError) as refused:
            kind["Point"](*arguments, **named)
        texts.append(str(refused.value))
    assert texts[0] == texts[1]


def test_an_instance_goes_to_another_process() -> None:
    from microros_gen.interfaces.types import TypeName

    name = TypeName("std_msgs", "msg", "Int32")
    assert pickle.loads(pickle.dumps(name)) == name


def test_other_kinds_of_data_classes_are_those_of_the_standard_library() -> None:
    @records.dataclass(frozen=True, order=True)
    class Ordered:
        value: int

    @records.dataclass
    class Plain:
        value: int

    assert Ordered(1) < Ordered(2)
    plain = Plain(1)
    plain.value = 2
    assert plain == Plain(2)


def test_every_frozen_class_of_the_package_is_a_cheap_one() -> None:
    frozen = re.compile(r"^@dataclass\(frozen=True(, kw_only=True)?\)", re.MULTILINE)
    with_them = [p for p in sorted(PACKAGE.rglob("*.py")) if frozen.search(p.read_text(encoding="utf-8"))]
    assert len(with_them) > 100
    others = [p for p in with_them if "from microros_gen.records import dataclass" not in p.read_text()]
    assert others == []
