# SPDX-License-Identifier: Apache-2.0
"""Entities with their own limits: which sets of limits a type has, and the names of the C symbols of each.

ROS 2 has one handle for each type, and it identifies no more than the type. What an entity's own limits decide
(largest size, encoder) is therefore found through its declaration, in a set that entities with equal limits share.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from microros_gen.interfaces.types import TypeName
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.capacity import Capacities, Entity, EntityLimits
from microros_gen.typesupport.plan.names import c_name
from microros_gen.typesupport.plan.size import TypeLimits, WireSizes


@dataclass(frozen=True)
class LimitSet:
    """A type under the limits of some entities, which are lower than those of the type.

    `name` is what its names in C begin with: `std_msgs__msg__String__on__text`. `max_encoded_size`: bytes of the
    CDR body.
    """

    name: str
    limits: TypeLimits
    max_encoded_size: int
    entities: tuple[Entity, ...]

    @property
    def sends(self) -> bool:
        """Whether some entity encodes messages under these limits; else nothing is generated for the set."""
        return any(entity.sends for entity in self.entities)


_ON = "__on__"

TopicNames = Mapping[tuple[TypeName, str], str]
"""Type and topic → what names in C begin with."""


def topic_names(capacities: Capacities) -> TopicNames:
    """Return a name for each topic whose messages, or some of whose entities, have their own limits.

    Slashes are underscores; where that gives one name to two topics of a type, the later one ends in `__2`.
    """
    found: dict[tuple[TypeName, str], str] = {}
    taken: set[str] = set()
    topics = [(t.type, t.topic) for t in capacities.topics]
    for key in dict.fromkeys([*topics, *((e.type, e.entity.topic) for e in capacities.entities)]):
        found[key] = _unique(f"{c_name(key[0])}{_ON}{key[1].strip('/').replace('/', '_')}", taken)
    return found


def plan_limit_sets(
    entities: Iterable[EntityLimits], names: TopicNames, sizes: WireSizes
) -> Mapping[TypeName, tuple[LimitSet, ...]]:
    """Return the sets of limits of each type, each named after the topic of its first entity.

    A second set of one topic ends in `__2`.
    """
    members: dict[tuple[TypeName, TypeLimits], list[Entity]] = {}
    for item in entities:
        members.setdefault((item.type, item.limits), []).append(item.entity)
    used: set[str] = set()
    found: dict[TypeName, list[LimitSet]] = {}
    for (name, limits), group in members.items():
        base = names[name, group[0].topic]
        others = set(names.values()) - {base}
        chosen = _unique(base, used, others)
        found.setdefault(name, []).append(LimitSet(chosen, limits, sizes.largest(name, limits), tuple(group)))
    return {name: tuple(sets) for name, sets in found.items()}


def sent_limits(
    sets: Mapping[TypeName, Iterable[LimitSet]],
) -> Mapping[TypeName, tuple[TypeLimits, ...]]:
    """Return the limits that encoders need, of the types that have such."""
    found = {name: tuple(s.limits for s in own if s.sends) for name, own in sets.items()}
    return {name: limits for name, limits in found.items() if limits}


def without_topic(name: str) -> str:
    """Return the C name of the type that a name of `topic_names` begins with; any other name as it is."""
    return name.partition(_ON)[0]


def _unique(base: str, taken: set[str], others: Iterable[str] = ()) -> str:
    """Return `base`, with a number where it is taken or one of `others`; it is taken then."""
    name, number = base, 1
    while name in taken or name in others:
        number += 1
        name = f"{base}__{number}"
    taken.add(name)
    return name
