# SPDX-License-Identifier: Apache-2.0
"""Plans of message types → the C files of their type support."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

from jinja2 import Environment

from microros_gen.plan.types import TypePlan
from microros_gen.plan.types_names import guard, include_path
from microros_gen.render.types_encode import EncoderViews
from microros_gen.render.types_storage import storage_view
from microros_gen.render.types_struct import functions_view, struct_view


@dataclass(frozen=True)
class HeaderView:
    """message.h.j2."""

    ros_name: str
    guard: str
    includes: tuple[str, ...]


def render_types(type_plans: Sequence[TypePlan], environment: Environment) -> dict[str, bytes]:
    """Return path → contents of every file of the types, in the order of the plans.

    `type_plans` must hold every type that one of them is made of.
    """
    renderer = _Renderer(type_plans, environment)
    for plan in type_plans:
        renderer.add(plan)
    return renderer.files


class _Renderer:
    """Prints views through templates."""

    def __init__(self, type_plans: Sequence[TypePlan], environment: Environment) -> None:
        self.files: dict[str, bytes] = {}
        self._plans = {plan.name: plan for plan in type_plans}
        self._encoders = EncoderViews(self._plans)
        self._environment = environment

    def add(self, plan: TypePlan) -> None:
        """Print every file of one type."""
        own = {plan.files.struct, plan.files.functions}
        functions = _values(functions_view(plan))
        self._print(plan.files.struct, "struct.h", _values(struct_view(plan)))
        self._print(plan.files.functions, "functions.h", functions)
        self._print(plan.files.functions_source, "functions.c", functions)
        if plan.wire is not None:
            own.add(plan.files.type_support)
            view = _values(self._encoders.view(plan))
            source_includes = view["includes"]
            self._print(
                plan.files.type_support,
                "type_support.h",
                {**view, "includes": view["header_includes"]},
            )
            self._print(
                plan.files.type_support_source, "type_support.c", {**view, "includes": source_includes}
            )
        if plan.storage:
            own.add(plan.files.storage)
            view = _values(storage_view(plan, self._plans))
            self._print(plan.files.storage, "storage.h", {**view, "includes": view["header_includes"]})
            self._print(plan.files.storage_source, "storage.c", view)
        includes = tuple(sorted(include_path(path) for path in own))
        header = HeaderView(str(plan.name), guard(plan.files.header), includes)
        self._print(plan.files.header, "message.h", _values(header))

    def _print(self, path: str, template: str, view: dict[str, Any]) -> None:
        text = self._environment.get_template(f"types/{template}.j2").render(view)
        self.files[path] = text.encode("utf-8")


def _values(view: Any) -> dict[str, Any]:
    """Return the members of a view by name."""
    return {field.name: getattr(view, field.name) for field in fields(view)}
