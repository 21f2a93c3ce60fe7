# SPDX-License-Identifier: Apache-2.0
"""The objects of one client: creation modes, references between objects, and their ROS 2 entities.

An object is created from others: a writer from its publisher and, in binary form, its topic; those from their
participant. If an object is replaced by a different one, the objects created from it are removed. If a participant or
publisher is deleted, its contents are removed too; a later DELETE of such a part still succeeds, so a client may clean
up in any order. A writer outlives the DELETE of its topic, since micro-ROS deletes the topic first.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from microros_gen.agent.budgets import cost_of
from microros_gen.agent.checks import RefusedError, check_application, check_object, part_ids
from microros_gen.agent.entities import Entity, Home, Outcome
from microros_gen.agent.policy.access import Access
from microros_gen.agent.representation import (
    Application,
    Description,
    Endpoint,
    Known,
    QosProfile,
    References,
    Topic,
    describe,
)
from microros_gen.agent.representation.description import UnknownNameError, UnsupportedKindError
from microros_gen.agent.representation.reference import UnknownReferenceError
from microros_gen.agent.ros.bridge import BridgeError
from microros_gen.agent.steps import Steps, finish
from microros_gen.agent.wire.constants import ObjectKind, Status
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.agent.wire.errors import MalformedError
from microros_gen.records import dataclass

Publish = Callable[[bytes], None]
_SERVED = frozenset(
    (
        ObjectKind.PARTICIPANT,
        ObjectKind.TOPIC,
        ObjectKind.PUBLISHER,
        ObjectKind.SUBSCRIBER,
        ObjectKind.DATAWRITER,
        ObjectKind.DATAREADER,
        ObjectKind.REQUESTER,
        ObjectKind.REPLIER,
        ObjectKind.TYPE,
        ObjectKind.QOSPROFILE,
        ObjectKind.APPLICATION,
    )
)
LARGEST_REPRESENTATION = 65_000
"""Maximum bytes of a representation that fit into an INFO; a longer one is not stored."""
_CONTAINER = {
    ObjectKind.TOPIC: ObjectKind.PARTICIPANT,
    ObjectKind.PUBLISHER: ObjectKind.PARTICIPANT,
    ObjectKind.SUBSCRIBER: ObjectKind.PARTICIPANT,
    ObjectKind.DATAWRITER: ObjectKind.PUBLISHER,
    ObjectKind.DATAREADER: ObjectKind.SUBSCRIBER,
    ObjectKind.REQUESTER: ObjectKind.PARTICIPANT,
    ObjectKind.REPLIER: ObjectKind.PARTICIPANT,
}


Heritage = dict[int, tuple[object, list[bytes]]]
"""Undelivered samples of an earlier session with the same key: by reader id, its description and the samples."""


@dataclass(frozen=True)
class _Wanted:
    """An object to create, and what to do if one with its id exists."""

    id: int
    parent: int
    description: Description
    reuse: bool
    replace: bool
    representation: int = 0
    """Bytes of its representation."""
    within: Entity | None = None
    """The application that contains it."""


class ObjectTree:
    """Objects by id, in the order of their creation: sources precede the objects created from them."""

    def __init__(self, home: Home, references: References, maximum: int) -> None:
        self._home = home
        self._references = references
        self._maximum = maximum
        self._objects: dict[int, Entity] = {}
        self._gone_with_container: dict[int, None] = {}
        self._heritage: Heritage = {}
        self.publish: dict[int, Publish] = {}
        """The publish function of each data writer, by object id."""

    def __len__(self) -> int:
        return len(self._objects)

    def __iter__(self) -> Iterator[Entity]:
        return iter(self._objects.values())

    def check(self, access: Access) -> None:
        """Check all objects. Raises RefusedError for the first one that a client may not have."""
        for entity in self:
            entity.check(access, self._home.fallback_name)

    def inherit(self, heritage: Heritage) -> None:
        """Take over undelivered samples of an earlier session, as far as the budget permits."""
        self._heritage = {
            object_id: (about, samples)
            for object_id, (about, samples) in heritage.items()
            if self._home.shares.history.take(sum(map(len, samples)))
        }

    def _claim(self, entity: Entity) -> None:
        """Give a new object the undelivered samples of the same object in an earlier session."""
        about, samples = self._heritage.pop(entity.id, (None, []))
        self._home.shares.history.add(-sum(map(len, samples)))
        if about == described(entity):
            entity.keep(samples, self._home.shares)

    def find(self, object_id: int) -> Entity | None:
        """Return the object with an id, or None."""
        return self._objects.get(object_id)

    def create(self, create: Create) -> Outcome:
        """Process a CREATE by the table of creation modes (DDS-XRCE 1.0, table 7)."""
        return finish(self.creating(create))

    def creating(self, create: Create) -> Steps[Outcome]:
        """Process a CREATE in steps, one for each object that is created or removed."""
        return self._guarded(lambda: self._create(create))

    def giving(self, object_id: int, parent: int, description: Description) -> Steps[Outcome]:
        """Create an object for a client that does not create it; an equal existing one stays."""
        wanted = _Wanted(object_id, parent, description, reuse=True, replace=True)
        return self._guarded(lambda: self._place(wanted))

    def _guarded(self, make: Callable[[], Steps[Outcome]]) -> Steps[Outcome]:
        try:
            return (yield from make())
        except RefusedError as error:
            return Outcome(error.status, str(error))
        except BridgeError as error:
            return Outcome(error.status, str(error))
        except MalformedError as error:
            return Outcome(Status.INVALID_DATA, str(error))
        except UnknownReferenceError as error:
            return Outcome(Status.DDS_ERROR, str(error))
        except UnknownNameError as error:
            return Outcome(Status.UNKNOWN_REFERENCE, str(error))
        except UnsupportedKindError as error:
            return Outcome(Status.DENIED, f"{error} are not served")

    def delete(self, object_id: int) -> Status:
        """Process a DELETE."""
        return finish(self.deleting(object_id))

    def deleting(self, object_id: int) -> Steps[Status]:
        """Process a DELETE in steps, one for each object."""
        entity = self._objects.get(object_id)
        if entity is not None:
            contained = [e for e in self if e.inside(entity)]
            yield from self._remove([entity, *contained])
            self._gone_with_container.update((e.id, None) for e in contained)
            while len(self._gone_with_container) > self._maximum:
                del self._gone_with_container[next(iter(self._gone_with_container))]
            return Status.OK
        if object_id in self._gone_with_container:
            del self._gone_with_container[object_id]
            return Status.OK
        return Status.UNKNOWN_REFERENCE

    def clear(self) -> None:
        """Remove everything, from the ROS graph at once."""
        finish(self.clearing())

    def clearing(self) -> Steps[None]:
        """Remove everything, in steps."""
        self._home.shares.history.add(-sum(len(s) for _, samples in self._heritage.values() for s in samples))
        self._heritage.clear()
        yield from self._remove(list(self._objects.values()))
        self._gone_with_container.clear()

    def forget_requests(self) -> None:
        """Remove open requests, which the client has forgotten."""
        for entity in self:
            if entity.kind == ObjectKind.REQUESTER:
                entity.forget_calls(self._home.shares)

    def suspend(self) -> None:
        """Leave the ROS graph and keep the descriptions."""
        finish(self.suspending())

    def suspending(self) -> Steps[None]:
        """Leave the ROS graph, in steps."""
        for entity in reversed(list(self)):
            self._leave(entity)
            yield

    def resume(self) -> list[tuple[Entity, str]]:
        """Return to the ROS graph; objects that cannot are removed and returned with the reason."""
        return finish(self.resuming())

    def resuming(self) -> Steps[list[tuple[Entity, str]]]:
        """Return to the ROS graph, in steps."""
        failed = []
        for entity in list(self):
            try:
                self._enter(entity)
            except BridgeError as error:
                failed.append((entity, str(error)))
            yield
        for entity, _ in failed:
            yield from self._remove([entity, *self._made_from(entity)])
        return failed

    def _create(self, create: Create) -> Steps[Outcome]:
        object_id = create.object & 0xFFF0 | create.kind
        present = self._objects.get(object_id)
        if present and not create.reuse and not create.replace:
            return Outcome(Status.ALREADY_EXISTS, "the object exists")
        if create.kind not in _SERVED:
            raise RefusedError(Status.DENIED, f"objects of kind {_kind_name(create.kind)} are not served")
        description = describe(create, self._references, self._known(create.parent))
        size = len(create.representation.body)
        wanted = _Wanted(object_id, create.parent, description, create.reuse, create.replace, size)
        outcome = yield from self._place(wanted)
        if outcome.status is Status.OK and outcome.entity is not None:
            fits = size <= LARGEST_REPRESENTATION
            outcome.entity.representation = create.representation if fits else None
        return outcome

    def _place(self, wanted: _Wanted) -> Steps[Outcome]:
        object_id = wanted.id
        present = self._objects.get(object_id)
        if wanted.within and present and not wanted.replace:
            raise RefusedError(
                Status.ALREADY_EXISTS, f"object {object_id:#06x} exists, although it is a part of it"
            )
        check_object(wanted.description)
        description = self._home.access.adapted(wanted.description)
        entity = Entity(object_id, description, self._sources(wanted))
        entity.check(self._home.access, self._home.fallback_name)
        if present and wanted.reuse:
            if (present.description, present.sources) == (entity.description, entity.sources):
                return Outcome(Status.OK_MATCHED, entity=present)
            if not wanted.replace:
                return Outcome(Status.MISMATCH, "the object exists and differs")
        if isinstance(wanted.description, Application):
            made_from = {present.id, *(e.id for e in self._made_from(present))} if present else set()
            others = self._objects.keys() - made_from
            check_application(object_id, wanted.description, others, self._maximum, wanted.replace)
        if present:
            yield from self._remove([present, *self._made_from(present)])
            entity.check(self._home.access, self._home.fallback_name)  # the policy may have changed meanwhile
        elif len(self._objects) >= self._maximum:
            raise RefusedError(Status.RESOURCES, f"the client has {self._maximum} objects already")
        self._charge(entity, wanted.representation)
        self._enter(entity)
        self._objects[object_id] = entity
        self._claim(entity)
        self._gone_with_container.pop(object_id, None)
        if isinstance(wanted.description, Application):
            yield from self._fill(entity, wanted.description, wanted.replace)
        return Outcome(Status.OK, entity=entity)

    def _fill(self, application: Entity, description: Application, replace: bool) -> Steps[None]:
        """Create all parts of an application. If one fails, remove all of them and the application (7.8.3.1)."""
        ids = part_ids(application.id, description)
        try:
            for object_id, part in zip(ids, description.parts, strict=True):
                parent = 0 if part.container is None else ids[part.container]
                yield from self._place(
                    _Wanted(object_id, parent, part.description, False, replace, within=application)
                )
                yield
        except Exception:
            yield from self._remove([application, *(e for e in self if e.inside(application))])
            raise

    def _known(self, parent: int) -> Known:
        """Return what a description may refer to: all QoS profiles, and the topics of the participant of `parent`."""
        container = self._objects.get(parent)
        home = container.participant if container else None
        held = {name: d for (_, name), d in self._references.known.items() if isinstance(d, QosProfile)}
        own = {e.description.name: e.description for e in self if isinstance(e.description, QosProfile)}
        topics = {
            e.description.name: e.description
            for e in self
            if isinstance(e.description, Topic) and e.participant is home
        }
        return Known({**held, **own}, topics)

    def _sources(self, wanted: _Wanted) -> tuple[Entity, ...]:
        kind, description = ObjectKind(wanted.id & 0x0F), wanted.description
        if kind not in _CONTAINER:
            return (wanted.within,) if wanted.within else ()
        container = self._find(wanted.parent, _CONTAINER[kind])
        if isinstance(description, Endpoint) and description.topic is None:
            return container, self._find(description.topic_id, ObjectKind.TOPIC)
        return (container,)

    def _find(self, object_id: int, kind: ObjectKind) -> Entity:
        found = self._objects.get(object_id & 0xFFF0 | kind)
        if found is None:
            wanted = f"{_kind_name(kind)} {object_id >> 4:#05x}"
            raise RefusedError(Status.UNKNOWN_REFERENCE, f"the client has no {wanted}")
        return found

    def _enter(self, entity: Entity) -> None:
        try:
            entity.enter(self._home)
        except BridgeError:
            if entity.id not in self._objects:
                self._discharge(entity)
            raise
        if entity.writer is not None:
            self.publish[entity.id] = entity.publish

    def _charge(self, entity: Entity, representation: int) -> None:
        """Charge the memory of an object until it is removed. Raises RefusedError if it exceeds a limit."""
        if self._home.shares.gate.closed:
            raise RefusedError(Status.RESOURCES, "the agent's memory is nearly all taken")
        cost = cost_of(entity.id, representation)
        if not self._home.shares.objects.take(cost):
            raise RefusedError(Status.RESOURCES, "the objects of all clients have reached object_bytes")
        entity.cost = cost

    def _discharge(self, entity: Entity) -> None:
        self._home.shares.objects.add(-entity.cost)
        entity.cost = 0

    def _leave(self, entity: Entity) -> None:
        self.publish.pop(entity.id, None)
        entity.leave(self._home.shares)

    def _remove(self, entities: list[Entity]) -> Steps[None]:
        """Remove objects, in the reverse order of their creation, so that it may stop midway."""
        for entity in reversed(entities):
            self._objects.pop(entity.id, None)
            self._discharge(entity)
            entity.drop_kept(self._home.shares)
            self._leave(entity)
            yield

    def _made_from(self, source: Entity) -> list[Entity]:
        found = [source]
        for entity in self._objects.values():
            if any(s in found for s in entity.sources):
                found.append(entity)
        return found[1:]


def _kind_name(kind: int) -> str:
    return ObjectKind(kind).name.lower()


def described(entity: Entity) -> object:
    """Return the descriptions of an object and of its sources, for comparison."""
    return entity.description, tuple(source.description for source in entity.sources)
