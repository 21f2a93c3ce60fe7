# SPDX-License-Identifier: Apache-2.0
"""Static storage of a message under its limits: one typed struct, and the steps that bind a message to it.

A topic whose own limits are lower than those of its type has a separate struct and bind function.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from microros_gen.application.limit_tree import LimitTree, limit_text, put_limit
from microros_gen.diagnostics import Diagnostics
from microros_gen.interfaces.types import (
    ArrayType,
    Field,
    Message,
    NamedType,
    Primitive,
    ScalarValue,
    SequenceType,
    StringType,
    TypeName,
    element_of,
)
from microros_gen.typesupport.plan.capacity import TopicLimits
from microros_gen.typesupport.plan.layout import Extent, StructLayouts, struct_extent
from microros_gen.typesupport.plan.names import c_name
from microros_gen.typesupport.plan.own_limits import TopicNames
from microros_gen.typesupport.plan.size import PLACEHOLDER, FieldLimits, TypeLimits
from microros_gen.typesupport.plan.storage_units import (
    BindMessages,
    BindNumbers,
    BindPart,
    BindStep,
    BindText,
    BindTexts,
    InitMessages,
    SetNumber,
    StorageMember,
    StorageUnit,
)


def plan_storage(
    messages: Mapping[TypeName, Message],
    roots: Mapping[TypeName, TypeLimits | None],
    homes: Mapping[TypeName, TypeLimits | None],
    diagnostics: Diagnostics,
    topics: Sequence[TopicLimits],
    names: TopicNames,
) -> Mapping[TypeName, tuple[StorageUnit, ...]]:
    """Return the units of each root's storage file, and of the types that they share.

    In a file those of `topics` come first, inner units before those that contain them; the type's own is the
    last.
    """
    planned: dict[TypeName, tuple[StorageUnit, ...]] = {}
    pending = [name for name, limits in roots.items() if limits is not None]
    while pending:
        name = pending.pop()
        limits = homes.get(name)
        if name in planned or limits is None:
            continue
        units: list[StorageUnit] = []
        lower = [(names[t.type, t.topic], t.topic, t.limits) for t in topics if t.type == name]
        for base, topic, own in [*lower, (c_name(name), "", limits)]:
            planner = _Planner(messages, homes, name, base, topic, diagnostics)
            planner.unit(name, own, "")
            units += planner.units
            pending += planner.shared
        planned[name] = tuple(units)
    return planned


def storage_extents(
    planned: Mapping[TypeName, tuple[StorageUnit, ...]], layouts: StructLayouts
) -> Mapping[str, Extent]:
    """Return the extent of every storage struct, by its name."""
    units = {unit.name: unit for file in planned.values() for unit in file}
    known: dict[str, Extent] = {}

    def extent(name: str) -> Extent:
        if name not in known:
            parts = {m.name: _member_extent(m, layouts, extent) for m in units[name].members}
            known[name] = struct_extent(parts)[0]
        return known[name]

    for name in units:
        extent(name)
    return known


def _member_extent(member: StorageMember, layouts: StructLayouts, unit: Callable[[str], Extent]) -> Extent:
    if member.unit is not None:
        element = unit(member.unit)
    elif member.message is not None:
        element = layouts.extent(member.message)
    elif member.strings is not None:
        element = layouts.of(member.strings)
    elif member.primitive is not None:
        element = layouts.of(member.primitive)
    else:
        element = layouts.character(member.characters is not None and member.characters.wide)
    size = element.size
    for dimension in member.dimensions:
        size *= dimension
    return Extent(size, element.alignment)


class _Planner:
    """Plans the storage file of one type."""

    def __init__(
        self,
        messages: Mapping[TypeName, Message],
        homes: Mapping[TypeName, TypeLimits | None],
        owner: TypeName,
        base: str,
        topic: str,
        diagnostics: Diagnostics,
    ) -> None:
        self.units: list[StorageUnit] = []
        self.shared: list[TypeName] = []
        self._messages = messages
        self._homes = homes
        self._owner = owner
        self._base = base
        self._topic = topic
        self._diagnostics = diagnostics

    def place(self, path: str) -> str:
        """Return what a user knows the member at `path` by."""
        return f"{self._owner}.{path}" + (f" on {self._topic}" if self._topic else "")

    def limit(self, path: str, kind: str, number: int) -> str:
        """Return the `limits:` that set the member at `path`: of the application, or of the endpoints of the topic."""
        tree: LimitTree = {}
        owner = () if self._topic else (str(self._owner),)
        put_limit(tree, (*owner, *path.split(".")), kind, number, by_kind=True)
        return f"`limits: {limit_text(tree)}`" + (f" at {self._topic}" if self._topic else "")

    def unit(self, name: TypeName, limits: TypeLimits, path: str) -> str:
        """Plan the unit for the use of `name` at `path` ("" for the owner); return its name."""
        if path and self._homes.get(name) == limits:
            self.shared.append(name)
            return f"{c_name(name)}__Storage"
        base = self._base + (f"__{path.replace('.', '__')}" if path else "")
        builder = _UnitBuilder(self, self._messages, self._diagnostics, path)
        builder.fields(name, limits, "")
        uses = tuple(dict.fromkeys(builder.uses))
        if not builder.members:
            builder.members.append(StorageMember(PLACEHOLDER.name, (), primitive=Primitive.UINT8))
        self.units.append(
            StorageUnit(
                f"{base}__Storage",
                f"{base}__bind",
                name,
                path,
                bool(path),
                tuple(builder.members),
                tuple(builder.steps),
                uses,
                self._topic,
            )
        )
        return f"{base}__Storage"


class _UnitBuilder:
    """Gathers members and steps of one unit."""

    def __init__(
        self, planner: _Planner, messages: Mapping[TypeName, Message], diagnostics: Diagnostics, path: str
    ) -> None:
        self.members: list[StorageMember] = []
        self.steps: list[BindStep] = []
        self.uses: list[TypeName] = []
        self._planner = planner
        self._messages = messages
        self._diagnostics = diagnostics
        self._path = path

    def fields(self, name: TypeName, limits: TypeLimits | None, prefix: str) -> None:
        """Add every field of `name`."""
        fields = self._messages[name].fields
        entries = limits.fields if limits else (None,) * len(fields)
        for field, entry in zip(fields, entries, strict=True):
            self._field(field, f"{prefix}{field.name}", entry)

    def _field(self, field: Field, member: str, limits: FieldLimits | None) -> None:
        element = element_of(field.type)
        sequence = isinstance(field.type, SequenceType)
        count = field.type.size if isinstance(field.type, ArrayType) else None
        if sequence:
            count = (limits.sequence or 0) if limits else 0
        defaults = _defaults(field)
        if sequence and count is not None and len(defaults) > count:
            self._too_small(field, member, "sequence", len(defaults), count)
            defaults = defaults[:count]
        if isinstance(element, StringType):
            self._strings(field, element, member, count, (limits.string or 0) if limits else 0, defaults)
        elif isinstance(element, NamedType):
            self._messages_of(element.name, field, member, count, limits.nested if limits else None)
        elif sequence:
            self._numbers(element, member, count or 0, defaults)
        else:
            self._number_defaults(element, member, count, defaults)

    def _numbers(
        self, primitive: Primitive, member: str, count: int, defaults: tuple[ScalarValue, ...]
    ) -> None:
        if count:
            self.members.append(StorageMember(member, (count,), primitive=primitive))
            self.steps.append(BindNumbers(member, member, primitive, count, defaults))

    def _number_defaults(
        self, primitive: Primitive, member: str, count: int | None, defaults: tuple[ScalarValue, ...]
    ) -> None:
        for index, value in enumerate(defaults):
            if value:
                self.steps.append(SetNumber(member, primitive, value, None if count is None else index))

    def _strings(
        self,
        field: Field,
        element: StringType,
        member: str,
        count: int | None,
        length: int,
        defaults: tuple[ScalarValue, ...],
    ) -> None:
        texts = tuple(str(value) for value in defaults)
        for text in texts:
            if text_length(text, element.wide) > length:
                self._too_small(field, member, "string", text_length(text, element.wide), length)
        if count is None:
            self.members.append(StorageMember(member, (length + 1,), characters=element))
            self.steps.append(BindText(member, member, element.wide, texts[0] if texts else ""))
        elif count:
            sequence = isinstance(field.type, SequenceType)
            characters = f"{member}__text" if sequence else member
            if sequence:
                self.members.append(StorageMember(member, (count,), strings=element))
            self.members.append(StorageMember(characters, (count, length + 1), characters=element))
            self.steps.append(BindTexts(member, member, characters, element.wide, count, sequence, texts))

    def _messages_of(
        self, name: TypeName, field: Field, member: str, count: int | None, limits: TypeLimits | None
    ) -> None:
        sequence = isinstance(field.type, SequenceType)
        if limits is None and count is None:
            self.fields(name, None, f"{member}.")
            return
        if count == 0:
            return
        if limits is None and not sequence:
            if self._has_defaults(name):
                self.uses.append(name)
                self.steps.append(InitMessages(member, name, count or 0))
            return
        path = f"{self._path}.{field.name}" if self._path else field.name
        unit = self._planner.unit(name, limits, path) if limits else ""
        bind = unit.removesuffix("__Storage") + "__bind" if unit else None
        if sequence:
            self.members.append(StorageMember(member, (count or 0,), message=name))
        self.uses.append(name)
        if count is None:
            self.members.append(StorageMember(member, (), unit=unit))
            self.steps.append(BindPart(member, member, bind or ""))
            return
        storage = f"{member}__storage" if sequence else member
        if unit:
            self.members.append(StorageMember(storage, (count,), unit=unit))
        init = bind is None and self._has_defaults(name)
        self.steps.append(BindMessages(member, member, name, storage, bind, init, count, sequence))

    def _has_defaults(self, name: TypeName) -> bool:
        for field in self._messages[name].fields:
            element = element_of(field.type)
            if any(_defaults(field)):
                return True
            if isinstance(element, NamedType) and self._has_defaults(element.name):
                return True
        return False

    def _too_small(self, field: Field, member: str, kind: str, needed: int, limit: int) -> None:
        path = f"{self._path}.{member}" if self._path else member
        place = self._planner.place(path)
        self._diagnostics.error(
            f"the default value of '{field.name}' needs a {kind} limit of {needed}, but the limit of {place}"
            f" is {limit}",
            field.span,
            f"Write {self._planner.limit(path, kind, needed)}",
            id="MG-5010",
        )


def text_length(text: str, wide: bool) -> int:
    """Return the length of a text as a limit counts it: UTF-8 bytes, or UTF-16 units."""
    return len(text.encode("utf-16-le")) // 2 if wide else len(text.encode("utf-8"))


def _defaults(field: Field) -> tuple[ScalarValue, ...]:
    if field.default is None:
        return ()
    return field.default if isinstance(field.default, tuple) else (field.default,)
