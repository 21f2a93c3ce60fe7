# SPDX-License-Identifier: Apache-2.0
"""What is generated for each message type: names, files, sizes, encoding steps, storage. Plan only."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

from microros_gen.diagnostics import Diagnostics
from microros_gen.model.types import Message, TypeName
from microros_gen.plan.capacity import Capacities
from microros_gen.plan.layout import DataModel, StructLayouts
from microros_gen.plan.types_names import TypeFiles, c_name, dds_name, type_files
from microros_gen.plan.types_size import TypeLimits, WireSizes, is_fixed
from microros_gen.plan.types_storage import StorageUnit, plan_storage, storage_extents
from microros_gen.plan.types_wire import WirePlan, plan_wire

LARGEST_BODY = 0xFFFFFFF0
"""Positions in a body are uint32_t in C, and rounding one up must not wrap."""


@dataclass(frozen=True)
class TypePlan:
    """One message type.

    `root`: declared by the application, so it has a type support handle; the others are parts of roots.
    `received`: it needs a decoder. Sizes are bytes of the CDR body under the limits (0 for a part
    that is never a root and whose limits differ from use to use); `struct_size` and `storage_size` are of the
    target's data model, None when that is not known.
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
    wire: WirePlan | None
    storage: tuple[StorageUnit, ...]
    struct_size: int | None
    storage_size: int | None

    @property
    def headers(self) -> tuple[str, ...]:
        """Paths of its headers below the output folder, sorted."""
        found = [self.files.header, self.files.struct, self.files.functions]
        found += [self.files.type_support] if self.wire else []
        found += [self.files.storage] if self.storage else []
        return tuple(sorted(found))

    @property
    def sources(self) -> tuple[str, ...]:
        """Paths of its C files below the output folder, sorted."""
        found = [self.files.functions_source]
        found += [self.files.type_support_source] if self.wire else []
        found += [self.files.storage_source] if self.storage else []
        return tuple(sorted(found))


def plan_types(
    messages: Mapping[TypeName, Message],
    capacities: Capacities,
    type_hash: Callable[[TypeName], str],
    diagnostics: Diagnostics,
    received: Collection[TypeName] = (),
    data_model: DataModel | None = None,
) -> tuple[TypePlan, ...]:
    """Plan every type of `messages` (closed, in dependency order; the roots are those of `capacities`).

    With a `data_model` the sizes of structs and storage are known here, and asserted in the C code.
    """
    wires = plan_wire(messages, capacities.limits)
    storages = plan_storage(messages, capacities.limits, wires.home_limits, diagnostics)
    sizes = WireSizes(messages)
    layouts = StructLayouts(messages, data_model) if data_model else None
    extents = storage_extents(storages, layouts) if layouts else {}
    plans = []
    for name, message in messages.items():
        limits = wires.home_limits.get(name)
        sized = name in wires.home_limits or is_fixed(message, messages)
        largest = sizes.largest(name, limits) if sized else 0
        if largest > LARGEST_BODY:
            diagnostics.error(
                f"{name} takes up to {largest} bytes under its limits",
                message.span,
                f"Lower its limits: a message has at most {LARGEST_BODY} bytes",
            )
        units = storages.get(name, ())
        plans.append(
            TypePlan(
                name=name,
                message=message,
                files=type_files(name),
                c_name=c_name(name),
                dds_name=dds_name(name),
                type_hash=type_hash(name),
                root=name in capacities.limits,
                received=name in received,
                fixed_size=is_fixed(message, messages),
                max_encoded_size=largest,
                min_encoded_size=sizes.smallest(name),
                limits=limits,
                wire=wires.plans.get(name),
                storage=units,
                struct_size=layouts.extent(name).size if layouts else None,
                storage_size=extents[units[-1].name].size if units and layouts else None,
            )
        )
    return tuple(plans)
