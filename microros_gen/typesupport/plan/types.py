# SPDX-License-Identifier: Apache-2.0
"""What is generated for each message type: names, files, sizes, encoding steps, storage. Plan only."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping

from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.dds_names import dds_type
from microros_gen.interfaces.derived import declaring_name
from microros_gen.interfaces.types import Message, Primitive, TypeName, element_of
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.capacity import Capacities
from microros_gen.typesupport.plan.decode import DecodePlan, decode_files, plan_decoders
from microros_gen.typesupport.plan.layout import WIDE_MODELS, DataModel, StructLayouts
from microros_gen.typesupport.plan.names import TypeFiles, c_name, include_path, type_files
from microros_gen.typesupport.plan.narrow import narrowed
from microros_gen.typesupport.plan.own_limits import LimitSet, plan_limit_sets, sent_limits, topic_names
from microros_gen.typesupport.plan.size import TypeLimits, WireSizes, is_fixed
from microros_gen.typesupport.plan.storage import plan_storage, storage_extents
from microros_gen.typesupport.plan.storage_units import StorageUnit
from microros_gen.typesupport.plan.wire import WirePlan, plan_wire

LARGEST_BODY = 0x7FFFFFF0
"""Sizes are enumerators in C, which are int; rounding a position up must not wrap either."""


@dataclass(frozen=True)
class TypePlan:
    """One message type.

    `root`: declared by the application, so it has a type support handle; the others are parts of roots.
    `received`: its handle has a decoder; `decoder` is None where neither it nor a type that contains it is
    received. Encoded sizes are bytes of the CDR body under the limits (0 for a part
    that is never a root and whose limits differ from use to use). `limits` are those of its handle, `limit_sets`
    those of entities that have lower ones. `models` are the data models that the generated code asserts its sizes for;
    for any other it does not compile. `struct_sizes` and `storage_sizes` are bytes for each of them; `storage_sizes`
    is empty for a type without storage, and `topic_sizes` holds those of storage for one topic, by the name of its
    struct.
    """

    name: TypeName
    message: Message
    files: TypeFiles
    c_name: str
    dds_name: str
    type_hash: str
    root: bool
    received: bool
    fixed_size: bool
    max_encoded_size: int
    min_encoded_size: int
    limits: TypeLimits | None
    limit_sets: tuple[LimitSet, ...]
    wire: WirePlan | None
    decoder: DecodePlan | None
    storage: tuple[StorageUnit, ...]
    struct_sizes: tuple[int, ...]
    storage_sizes: tuple[int, ...]
    topic_sizes: Mapping[str, tuple[int, ...]]
    models: tuple[DataModel, ...] = WIDE_MODELS

    def struct_size(self, model: DataModel) -> int:
        """Return the size of the struct for one of `models`, bytes."""
        return self.struct_sizes[self.models.index(model)]

    def storage_size(self, model: DataModel) -> int:
        """Return the size of the static storage for one of `models`, bytes; 0 where it needs none."""
        return self.storage_sizes[self.models.index(model)] if self.storage_sizes else 0

    def storage_name(self, topic: str) -> str:
        """Return what the names of the storage for messages on `topic` begin with: `sensor_msgs__msg__Imu`."""
        own = (u.name.removesuffix("__Storage") for u in self.storage if u.topic == topic and not u.private)
        return next(own, self.c_name)

    def limit_set(self, kind: str, index: int) -> LimitSet | None:
        """Return the limits of the `index`-th entity of a kind; None where it has those of the type."""
        return next(
            (s for s in self.limit_sets if any((e.kind, e.index) == (kind, index) for e in s.entities)), None
        )

    def limits_of(self, kind: str, index: int) -> TypeLimits | None:
        """Return the limits of that entity's messages: its own, or those of the type."""
        own = self.limit_set(kind, index)
        return own.limits if own else self.limits

    def largest(self, kind: str, index: int) -> int:
        """Return the largest encoded size of that entity's messages, bytes of the CDR body."""
        own = self.limit_set(kind, index)
        return own.max_encoded_size if own else self.max_encoded_size

    @property
    def headers(self) -> tuple[str, ...]:
        """Paths of its headers below the output folder, sorted."""
        found = [self.files.header, self.files.struct, self.files.functions]
        found += [self.files.type_support] if self.wire else []
        found += [decode_files(self.files)[0]] if self.decoder else []
        found += [self.files.storage] if self.storage else []
        return tuple(sorted(found))

    @property
    def sources(self) -> tuple[str, ...]:
        """Paths of its C files below the output folder, sorted."""
        found = [self.files.functions_source]
        found += [self.files.type_support_source] if self.wire else []
        found += [decode_files(self.files)[1]] if self.decoder else []
        found += [self.files.storage_source] if self.storage else []
        return tuple(sorted(found))


def plan_types(
    messages: Mapping[TypeName, Message],
    capacities: Capacities,
    type_hash: Callable[[TypeName], str],
    diagnostics: Diagnostics,
    received: Collection[TypeName] = (),
    models: tuple[DataModel, ...] = WIDE_MODELS,
    exact_float64: bool = False,
) -> tuple[TypePlan, ...]:
    """Plan every type of `messages` (closed, in dependency order; the roots are those of `capacities`).

    `received`: the roots that need a decoder. `models`: those of the target. `exact_float64`: members that a double of
    the target would round are errors.
    """
    converts = any(model.converts_float64 for model in models)
    if all(model.converts_float64 for model in models):
        messages = narrowed(messages)  # otherwise the compiler rounds them where it must
    decoders = plan_decoders(messages, received, converts)
    names = topic_names(capacities)
    sizes = WireSizes(messages)
    sets = plan_limit_sets(capacities.entities, names, sizes)
    wires = plan_wire(messages, capacities.limits, sent_limits(sets), converts)
    storages = plan_storage(
        messages, capacities.limits, wires.home_limits, diagnostics, capacities.topics, names
    )
    layouts = [StructLayouts(messages, model) for model in models]
    extents = [storage_extents(storages, layout) for layout in layouts]
    plans = []
    for name, message in messages.items():
        fixed = is_fixed(message, messages)
        limits = wires.home_limits.get(name)
        units = storages.get(name, ())
        plans.append(
            TypePlan(
                name=name,
                message=message,
                files=type_files(name),
                c_name=c_name(name),
                dds_name=dds_type(name),
                type_hash=type_hash(name),
                root=name in capacities.limits,
                received=name in received,
                fixed_size=fixed,
                max_encoded_size=sizes.largest(name, limits) if fixed or limits else 0,
                min_encoded_size=sizes.smallest(name),
                limits=limits,
                limit_sets=sets.get(name, ()),
                wire=wires.plans.get(name),
                decoder=decoders.get(name),
                storage=units,
                struct_sizes=tuple(layout.extent(name).size for layout in layouts),
                storage_sizes=tuple(known[units[-1].name].size for known in extents) if units else (),
                topic_sizes={
                    unit.name: tuple(known[unit.name].size for known in extents)
                    for unit in units
                    if unit.topic and not unit.private
                },
                models=models,
            )
        )
    _check_sizes(plans, diagnostics)
    if converts and exact_float64:
        _check_doubles(plans, diagnostics)
    _check_files(plans, diagnostics)
    return tuple(plans)


def _check_sizes(plans: Iterable[TypePlan], diagnostics: Diagnostics) -> None:
    for plan in plans:
        if plan.max_encoded_size > LARGEST_BODY:
            diagnostics.too_large(
                f"{plan.name} takes up to {plan.max_encoded_size} bytes under its limits",
                plan.message.span,
                f"Lower its limits: a message has at most {LARGEST_BODY} bytes",
                id="MG-5011",
            )


def _check_doubles(plans: Iterable[TypePlan], diagnostics: Diagnostics) -> None:
    """Report messages with numbers that the C of the target rounds."""
    for plan in plans:
        for field in plan.message.fields:
            if element_of(field.type) is Primitive.FLOAT64:
                diagnostics.error(
                    f"{plan.name} has the float64 member '{field.name}', and a double has only 4 bytes on this target",
                    field.span,
                    "Use a message with float32 members, or float64: converted",
                    id="MG-5014",
                )


def _check_files(plans: Iterable[TypePlan], diagnostics: Diagnostics) -> None:
    """Two names that differ in capitals only (`HTTPServer`, `HttpServer`) give one header, here as in ROS 2."""
    first: dict[str, TypeName] = {}
    reported = set()
    for plan in plans:
        name = declaring_name(plan.name)
        other = first.setdefault(plan.files.header, name)
        if other != name and name not in reported:
            reported.add(name)
            diagnostics.error(
                f"{name} and {other} have the same header in C, {include_path(plan.files.header)}",
                plan.message.span,
                "Rename one of them, or leave it out",
                id="MG-5012",
            )
