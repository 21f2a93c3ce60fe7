# SPDX-License-Identifier: Apache-2.0
"""Tables of the members of types → their C files, one for each interface, and the list of all."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from jinja2 import Environment

from microros_gen.interfaces.derived import declaring_name
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.members import (
    TABLES_HEADER,
    TABLES_SOURCE,
    TableMember,
    members_source,
    nesting_depth,
    table_members,
)
from microros_gen.typesupport.plan.names import c_name, include_path
from microros_gen.typesupport.plan.types import TypePlan
from microros_gen.typesupport.views.struct import pool_pointer


@dataclass(frozen=True)
class MemberView:
    """One line of a table, and what is asserted about it (empty: nothing)."""

    name: str
    values: str
    assertion: str


@dataclass(frozen=True)
class TableView:
    """The table of one type."""

    name: str
    ros_name: str
    dds_name: str
    pool: str
    members: tuple[MemberView, ...]


def render_members(
    type_plans: Sequence[TypePlan], environment: Environment, pools: Collection[str] = ()
) -> dict[str, bytes]:
    """Return path → contents of the tables of all types; `type_plans` are in dependency order, `pools` as of
    render_types."""
    files: dict[str, list[TypePlan]] = {}
    for plan in type_plans:
        files.setdefault(members_source(plan.files), []).append(plan)
    rendered = {}
    template = environment.get_template("types/members.c.j2")
    for path, plans in files.items():
        title = str(declaring_name(plans[0].name))
        struct = include_path(plans[0].files.struct)
        text = template.render(title=title, struct=struct, tables=[_table(plan, pools) for plan in plans])
        rendered[path] = text.encode()
    view = {
        "depth": nesting_depth({plan.name: plan.message for plan in type_plans}),
        "names": [plan.c_name for plan in type_plans],
        "roots": [plan.c_name for plan in type_plans if plan.root],
    }
    for path, name in ((TABLES_HEADER, "tables.h"), (TABLES_SOURCE, "tables.c")):
        rendered[path] = environment.get_template(f"types/{name}.j2").render(view).encode()
    return rendered


def _table(plan: TypePlan, pools: Collection[str]) -> TableView:
    views = tuple(_member(plan.c_name, member) for member in table_members(plan.message))
    return TableView(plan.c_name, str(plan.name), plan.dds_name, pool_pointer(plan.c_name, pools), views)


def _member(owner: str, member: TableMember) -> MemberView:
    nested = "NULL" if member.nested is None else f"&{c_name(member.nested)}__members"
    place = f"(uint32_t)offsetof({owner}, {member.name})"
    kinds = f"MICROROS_MEMBER_{member.type}, MICROROS_MEMBER_{member.shape}"
    values = f'"{member.name}", {nested}, {place}, {member.count}U, {member.string_bound}U, {kinds}'
    return MemberView(member.name, values, _assertion(owner, member))


def _assertion(owner: str, member: TableMember) -> str:
    """Return what the functions on tables take for granted about the member, as a constant expression."""
    place = f"((const {owner} *)0)->{member.name}"
    element = f"sizeof({member.element})"
    if member.shape in ("SEQUENCE", "BOUNDED"):
        return f"MICROROS_MEMBER_IS_SEQUENCE({place}, {element})"
    return f"sizeof({place}) == " + (f"{member.count}U * {element}" if member.shape == "ARRAY" else element)
