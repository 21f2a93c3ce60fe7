# SPDX-License-Identifier: Apache-2.0
"""Limits → the capacity of every string and sequence, for each declared root.

Precedence (design: "The application file"): the own limits of an entity, then those of the application; those of an
endpoint that a component opens by itself hold where the application has `*` alone. In each of them:

1. the rule with the longest path from the declared root (`Imu` + `header`, `frame_id`; a prefix covers all
   below);
2. a rule on a type that lies on the way, the one that ends nearest to the field first (`Header` + `frame_id`,
   then `Header`, then the root type itself);
3. `*`.

One number for a sequence of messages (`transforms: 2`) is how many of them, and nothing below.
A bound in the interface file caps whatever a rule says. Where no rule speaks, the default holds and is
recorded as such; with defaults switched off a bound is the capacity, and without one the field is an error.

Two entities of one type may have different limits. Those of the type, which its handle has, are the larger of
both; each entity keeps its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from enum import Enum

from microros_gen.application.model import LimitRule
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.interfaces.types import (
    Field,
    Message,
    NamedType,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.capacity_rules import RuleChecker, absolute_path, is_count
from microros_gen.typesupport.plan.size import FieldLimits, TypeLimits, WireSizes
from microros_gen.typesupport.plan.unset import Unset, UnsetRoot, report_unset


class Origin(Enum):
    """Where a capacity comes from."""

    RULE = "rule"
    BOUND = "bound"
    DEFAULT = "default"


@dataclass(frozen=True)
class Defaults:
    """Capacities where no rule speaks; None switches them off (an application file without `*`)."""

    string: int | None = 64
    sequence: int | None = 16


@dataclass(frozen=True)
class Entity:
    """What exchanges messages of a type: a declared endpoint, the `index`-th of its `kind` in the application file.

    `topic` and `node` are names in full. `sends`: its messages are encoded here; else they are only received.
    """

    kind: str
    index: int
    topic: str
    node: str
    sends: bool = True


@dataclass(frozen=True)
class Root:
    """A declared type: by an endpoint (`rules` are its own limits) or by `interfaces:` (`entity` is None).

    `usual` are the limits of an endpoint that a component opens by itself. `room` is the largest body that its
    stream takes, bytes; None where the stream follows the message.
    """

    type: TypeName
    rules: tuple[LimitRule, ...] = ()
    span: Span | None = None
    room: int | None = None
    entity: Entity | None = None
    usual: tuple[LimitRule, ...] = ()


@dataclass(frozen=True)
class Capacity:
    """One decided capacity.

    `path` holds the members from the root; `kind` is `string` (characters) or `sequence` (elements).
    """

    root: TypeName
    path: tuple[str, ...]
    kind: str
    value: int
    origin: Origin
    span: Span | None = None

    @property
    def key(self) -> str:
        """The key for the application file: `sensor_msgs/msg/JointState: {name: {string: 16}}`."""
        return _yaml_key(self.root, self.path, {self.kind: self.value})


@dataclass(frozen=True)
class TopicLimits:
    """The limits of one topic's messages, where they are not those of their type: of all its entities the larger."""

    type: TypeName
    topic: str
    limits: TypeLimits


@dataclass(frozen=True)
class EntityLimits:
    """The limits of one entity, where they are not those of its type."""

    type: TypeName
    entity: Entity
    limits: TypeLimits


@dataclass(frozen=True)
class Capacities:
    """The limits of each root (None: nothing of variable length in it), and how each came about.

    `topics` and `entities` are those that have lower limits than their type, because others of the type have larger
    ones; both in the order of the application file.
    """

    limits: Mapping[TypeName, TypeLimits | None]
    decided: tuple[Capacity, ...]
    topics: tuple[TopicLimits, ...] = ()
    entities: tuple[EntityLimits, ...] = ()

    @property
    def defaulted(self) -> tuple[Capacity, ...]:
        """What got the default, to be reported to the user."""
        return tuple(c for c in self.decided if c.origin is Origin.DEFAULT)


def plan_capacities(
    messages: Mapping[TypeName, Message],
    roots: Iterable[Root],
    rules: Iterable[LimitRule],
    defaults: Defaults,
    diagnostics: Diagnostics,
) -> Capacities:
    """Decide every capacity below `roots`; faults of rules and unset fields go to `diagnostics`.

    `rules` are the application's `limits:`. `messages` is closed under dependencies.
    """
    application = tuple(rules)
    checker = RuleChecker(messages, diagnostics)
    checker.check(application)
    limits: dict[TypeName, TypeLimits | None] = {}
    decided: dict[tuple[TypeName, tuple[str, ...], str], Capacity] = {}
    shared = _Tier(messages, application)
    own: list[EntityLimits] = []
    unset: list[UnsetRoot] = []
    for root in roots:
        checker.check((*root.rules, *root.usual), root.type)
        tiers = [_Tier(messages, root.rules, root.type)] if root.rules else []
        tiers += _below_own(messages, root, application) if root.usual else [shared]
        walk = _Walk(messages, root, tiers, defaults)
        found = walk.type_limits(root.type, (), (str(root.type),))
        unset += [root_unset] if (root_unset := walk.unset_root()) else []
        limits[root.type] = _larger(limits[root.type], found) if root.type in limits else found
        if root.entity is not None and found is not None:
            own.append(EntityLimits(root.type, root.entity, found))
        for capacity in walk.decided:
            key = (capacity.root, capacity.path, capacity.kind)
            if key not in decided or decided[key].value < capacity.value:
                decided[key] = capacity
    report_unset(unset, application, diagnostics)
    entities = tuple(e for e in own if e.limits != limits[e.type])
    return Capacities(limits, tuple(decided.values()), _topic_limits(own, limits), entities)


def _below_own(
    messages: Mapping[TypeName, Message], root: Root, application: Iterable[LimitRule]
) -> list[_Tier]:
    """Return what holds where a component's endpoint has no own limits: its usual ones come before `*`."""
    rules = tuple(application)
    named = [rule for rule in rules if rule.path != ("*",)]
    anywhere = [rule for rule in rules if rule.path == ("*",)]
    return [_Tier(messages, named), _Tier(messages, root.usual, root.type), _Tier(messages, anywhere)]


def _topic_limits(
    own: Iterable[EntityLimits], limits: Mapping[TypeName, TypeLimits | None]
) -> tuple[TopicLimits, ...]:
    found: dict[tuple[TypeName, str], TypeLimits] = {}
    for item in own:
        key = (item.type, item.entity.topic)
        found[key] = _larger(found.get(key), item.limits) or item.limits
    return tuple(TopicLimits(*key, item) for key, item in found.items() if item != limits[key[0]])


class _Tier:
    """Rules of one origin, ready for look-up."""

    def __init__(
        self, messages: Mapping[TypeName, Message], rules: Iterable[LimitRule], root: TypeName | None = None
    ) -> None:
        self._rules = {absolute_path(rule.path, root): rule for rule in rules}
        self._counts = frozenset(
            path for path, rule in self._rules.items() if rule.single and is_count(path, messages)
        )
        self._starts = frozenset(path[0] for path in self._rules)
        self._anywhere = self._rules.get(("*",))

    def candidates(self, path: tuple[str, ...], types: tuple[str, ...]) -> Iterator[LimitRule]:
        """Yield the rules that cover the field at `path`, best first; `types` are the types on the way."""
        if types[0] in self._starts:
            yield from self._from(types[0], path, range(len(path), 0, -1))
        if not self._starts.isdisjoint(types):
            yield from self._on_the_way(path, types)
        if self._anywhere is not None:
            yield self._anywhere

    def _on_the_way(self, path: tuple[str, ...], types: tuple[str, ...]) -> Iterator[LimitRule]:
        for end in range(len(path), -1, -1):
            for start in range(0 if end == 0 else 1, min(end + 1, len(types))):
                yield from self._from(types[start], path[start:], (end - start,))

    def _from(self, start: str, path: tuple[str, ...], lengths: Iterable[int]) -> Iterator[LimitRule]:
        for length in lengths:
            key = (start, *path[:length])
            rule = self._rules.get(key)
            if rule is not None and (length == len(path) or key not in self._counts):
                yield rule


class _Walk:
    """Walks one root and decides."""

    def __init__(
        self, messages: Mapping[TypeName, Message], root: Root, tiers: list[_Tier], defaults: Defaults
    ) -> None:
        self.decided: list[Capacity] = []
        self._messages = messages
        self._root = root
        self._tiers = tiers
        self._defaults = {"string": defaults.string, "sequence": defaults.sequence}
        self._unset: list[tuple[tuple[str, ...], str, Field]] = []

    def type_limits(self, name: TypeName, path: tuple[str, ...], types: tuple[str, ...]) -> TypeLimits | None:
        """Return the limits of the type at `path`; None where nothing in it has a variable length."""
        message = self._messages[name]
        fields = tuple(self._field_limits(field, (*path, field.name), types) for field in message.fields)
        return TypeLimits(fields) if any(f is not None for f in fields) else None

    def unset_root(self) -> UnsetRoot | None:
        """Return what nothing sets below this root; None where everything is set."""
        unset = tuple(Unset(path, kind) for path, kind, _ in self._unset)
        if not unset:
            return None
        root = self._root
        return UnsetRoot(root.type, root.span or self._unset[0][2].span, unset, root.room, self._size_with)

    def _field_limits(
        self, field: Field, path: tuple[str, ...], types: tuple[str, ...]
    ) -> FieldLimits | None:
        element = element_of(field.type)
        sequence = string = nested = None
        if isinstance(field.type, SequenceType):
            sequence = self._decide("sequence", field, field.type.bound, path, types)
        if isinstance(element, StringType):
            string = self._decide("string", field, element.bound, path, types)
        if isinstance(element, NamedType):
            nested = self.type_limits(element.name, path, (*types, str(element.name)))
        if sequence is None and string is None and nested is None:
            return None
        return FieldLimits(sequence, string, nested)

    def _decide(
        self, kind: str, field: Field, bound: int | None, path: tuple[str, ...], types: tuple[str, ...]
    ) -> int:
        for tier in self._tiers:
            for rule in tier.candidates(path, types):
                value = rule.string if kind == "string" else rule.sequence
                if value is not None:
                    value = value if bound is None else min(value, bound)
                    return self._note(path, kind, value, Origin.RULE, rule.span)
        default = self._defaults[kind]
        if bound is not None and (default is None or bound <= default):
            return self._note(path, kind, bound, Origin.BOUND, field.span)
        if default is not None:
            return self._note(path, kind, default, Origin.DEFAULT, None)
        self._unset.append((path, kind, field))
        return 0

    def _note(self, path: tuple[str, ...], kind: str, value: int, origin: Origin, span: Span | None) -> int:
        self.decided.append(Capacity(self._root.type, path, kind, value, origin, span))
        return value

    def _size_with(self, string: int, sequence: int) -> int:
        same = _Walk(self._messages, self._root, self._tiers, Defaults(string, sequence))
        limits = same.type_limits(self._root.type, (), (str(self._root.type),))
        return WireSizes(self._messages).largest(self._root.type, limits)


def _larger(first: TypeLimits | None, second: TypeLimits | None) -> TypeLimits | None:
    if first is None or second is None:
        return first or second
    return TypeLimits(tuple(_larger_field(a, b) for a, b in zip(first.fields, second.fields, strict=True)))


def _larger_field(first: FieldLimits | None, second: FieldLimits | None) -> FieldLimits | None:
    if first is None or second is None:
        return first or second
    return FieldLimits(
        _max(first.sequence, second.sequence),
        _max(first.string, second.string),
        _larger(first.nested, second.nested),
    )


def _max(first: int | None, second: int | None) -> int | None:
    return first if second is None else second if first is None else max(first, second)


def _yaml_key(root: TypeName, path: tuple[str, ...], values: Mapping[str, int]) -> str:
    inner = "{" + ", ".join(f"{kind}: {value}" for kind, value in values.items()) + "}"
    for name in reversed(path):
        inner = f"{{{name}: {inner}}}"
    return f"{root}: {inner}"
