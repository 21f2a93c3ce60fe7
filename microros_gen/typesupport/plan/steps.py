# SPDX-License-Identifier: Apache-2.0
"""The steps that an encoder consists of; typesupport/plan/decode.py has those of a decoder."""

from __future__ import annotations

from typing import Union

from microros_gen.interfaces.types import Primitive, TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.size import TypeLimits


@dataclass(frozen=True)
class Place:
    """A position in the body: `offset`, or `position + offset` where `variable`."""

    variable: bool
    offset: int


@dataclass(frozen=True)
class Limit:
    """A limit: a number, or (None) the member `table` of the table of limits that the function is given.

    `bound`: that of the interface file, which the limit does not exceed; None without a bound.
    """

    value: int | None
    table: str
    bound: int | None = None


@dataclass(frozen=True)
class Zeros:
    """Padding whose size is known: `count` zero bytes."""

    place: Place
    count: int


@dataclass(frozen=True)
class Align:
    """Padding whose size depends on the position; at least `to` bytes follow it."""

    place: Place
    to: int


@dataclass(frozen=True)
class Leaf:
    """A number, or an array of `count` numbers; `member` is its path in the C struct, `form` that of TypeFacts."""

    place: Place
    member: str
    primitive: Primitive
    count: int | None
    form: str

    @property
    def size(self) -> int:
        """Bytes."""
        return self.primitive.size * (1 if self.count is None else self.count)


@dataclass(frozen=True)
class Run:
    """Two or more leaves, without padding on the wire; without padding in C on the usual targets."""

    place: Place
    leaves: tuple[Leaf, ...]

    @property
    def size(self) -> int:
        """Bytes."""
        return sum(leaf.size for leaf in self.leaves)


@dataclass(frozen=True)
class Text:
    """A string or wstring (`wide`)."""

    place: Place
    member: str
    wide: bool
    limit: Limit


@dataclass(frozen=True)
class Texts:
    """An array (`count`) or a sequence (`sequence`) of strings."""

    place: Place
    member: str
    wide: bool
    limit: Limit
    count: int | None
    sequence: Limit | None


@dataclass(frozen=True)
class Numbers:
    """A sequence of numbers; `form` is that of TypeFacts."""

    place: Place
    member: str
    primitive: Primitive
    limit: Limit
    form: str


@dataclass(frozen=True)
class Messages:
    """An array (`count`) or a sequence (`sequence`) of messages.

    `table`, `limits`: what a call passes on, a member of the own table or a constant table; both None:
    nothing. `fixed`: the element has a fixed size. `packed`: its size where a whole array is one run, else 0.
    """

    place: Place
    member: str
    type: TypeName
    table: str | None
    limits: TypeLimits | None
    fixed: bool
    packed: int
    alignment: int
    count: int | None
    sequence: Limit | None


@dataclass(frozen=True)
class Part:
    """A nested message that has its own encoder; `table` and `limits` as in `Messages`."""

    place: Place
    member: str
    type: TypeName
    table: str | None
    limits: TypeLimits | None


Step = Union[Zeros, Align, Leaf, Run, Text, Texts, Numbers, Messages, Part]  # noqa: UP007
