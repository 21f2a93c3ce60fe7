# SPDX-License-Identifier: Apache-2.0
"""What static storage consists of: structs with their members, and the steps that bind a message to one."""

from __future__ import annotations

from typing import Union

from microros_gen.interfaces.types import Primitive, ScalarValue, StringType, TypeName
from microros_gen.records import dataclass


@dataclass(frozen=True)
class StorageMember:
    """An array in the storage; `dimensions` is empty for one value.

    Of numbers, characters of a string, strings, messages, or the storage of a nested type (`unit`: the name
    of its struct); exactly one of these is set.
    """

    name: str
    dimensions: tuple[int, ...]
    primitive: Primitive | None = None
    characters: StringType | None = None
    strings: StringType | None = None
    message: TypeName | None = None
    unit: str | None = None


@dataclass(frozen=True)
class SetNumber:
    """A member (an element of an array: `index`) that starts with a number other than zero."""

    member: str
    primitive: Primitive
    value: ScalarValue
    index: int | None = None


@dataclass(frozen=True)
class InitMessages:
    """An array of messages of fixed size that start with other values than zero."""

    member: str
    type: TypeName
    count: int


@dataclass(frozen=True)
class BindText:
    """A string; `storage` is its array of characters."""

    member: str
    storage: str
    wide: bool
    default: str


@dataclass(frozen=True)
class BindTexts:
    """An array or a sequence (`sequence`) of strings; `count` elements that exist, `defaults` of the first
    ones."""

    member: str
    storage: str
    characters: str
    wide: bool
    count: int
    sequence: bool
    defaults: tuple[str, ...]


@dataclass(frozen=True)
class BindNumbers:
    """A sequence of numbers; `defaults` are its first elements."""

    member: str
    storage: str
    primitive: Primitive
    count: int
    defaults: tuple[ScalarValue, ...]


@dataclass(frozen=True)
class BindMessages:
    """An array or a sequence of messages; `bind` binds one element to `unit`, None for elements of fixed
    size."""

    member: str
    storage: str
    type: TypeName
    unit: str
    bind: str | None
    init: bool
    count: int
    sequence: bool


@dataclass(frozen=True)
class BindPart:
    """A nested message of variable length."""

    member: str
    storage: str
    bind: str


BindStep = Union[  # noqa: UP007
    SetNumber, InitMessages, BindText, BindTexts, BindNumbers, BindMessages, BindPart
]


@dataclass(frozen=True)
class StorageUnit:
    """One struct and its bind function. `private`: only for the use at `path` of a root; `topic`: for the
    messages of this topic (empty: of the type)."""

    name: str
    bind: str
    type: TypeName
    path: str
    private: bool
    members: tuple[StorageMember, ...]
    steps: tuple[BindStep, ...]
    uses: tuple[TypeName, ...]
    topic: str = ""
