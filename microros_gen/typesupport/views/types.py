# SPDX-License-Identifier: Apache-2.0
"""Plans of message types → the C files of their type support.

A file holds one message, or every message of a service or an action, as rosidl_generator_c lays them out.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import fields
from pathlib import PurePosixPath
from typing import Any

from jinja2 import Environment

from microros_gen.documents.ahead import compute_ahead
from microros_gen.interfaces.dds_names import dds_type
from microros_gen.interfaces.derived import SERVICE_PARTS, declaring_name, derived_name
from microros_gen.records import dataclass
from microros_gen.typesupport.plan.names import c_name, guard, include_path
from microros_gen.typesupport.plan.types import TypePlan
from microros_gen.typesupport.views.encode import EncoderViews
from microros_gen.typesupport.views.notes import message_note
from microros_gen.typesupport.views.storage import storage_view
from microros_gen.typesupport.views.struct import functions_view, struct_view


@dataclass(frozen=True)
class ServiceView:
    """The handle of a service type: what its C names begin with, its function, and its name on the wire."""

    name: str
    handle: str
    dds_name: str


_WORTH_A_PROCESS = 200
"""Headers of messages, of which half take as long as starting a process and copying the memory that it touches."""


def render_types(
    type_plans: Sequence[TypePlan],
    environment: Environment,
    services: bool = False,
    pools: Collection[str] = (),
    fork: bool = False,
) -> dict[str, bytes]:
    """Return path → contents of every file of the types, in the order of the plans.

    `type_plans` must hold every type that one of them is made of. `services`: service types get handles.
    `pools` are the kinds of elements that messages which are sent have storage for. `fork`: where they are many,
    another process prints half of them (`compute_ahead` says where that is possible).
    """
    files: dict[str, list[TypePlan]] = {}
    for plan in type_plans:
        files.setdefault(plan.files.header, []).append(plan)
    renderer = _Renderer(type_plans, environment, services, pools)
    headers = list(files.values())
    half = len(headers) // 2
    ahead = (
        compute_ahead(lambda _: renderer.printed(headers[half:]))
        if fork and len(headers) >= _WORTH_A_PROCESS
        else None
    )
    first = renderer.printed(headers[:half])
    taken = ahead.take() if ahead is not None else {}
    return {**first, **(taken or renderer.printed(headers[half:]))}


class _Renderer:
    """Prints views through templates."""

    def __init__(
        self,
        type_plans: Sequence[TypePlan],
        environment: Environment,
        services: bool,
        pools: Collection[str],
    ) -> None:
        self._files: dict[str, bytes] = {}
        self._plans = {plan.name: plan for plan in type_plans}
        self._encoders = EncoderViews(self._plans)
        self._environment = environment
        self._services = services
        self._pools = frozenset(pools)

    def printed(self, headers: Iterable[Sequence[TypePlan]]) -> dict[str, bytes]:
        """Return every file of messages, which come by their headers."""
        self._files = {}
        for plans in headers:
            self._add(plans)
        return self._files

    def _add(self, plans: Sequence[TypePlan]) -> None:
        """Print every file of the messages that share one header."""
        paths = plans[0].files
        own = [paths.functions, paths.struct]
        functions = [functions_view(plan, self._plans, self._pools) for plan in plans]
        self._print(paths.struct, "struct.h", _file(plans, paths.struct, map(struct_view, plans)))
        self._print(paths.functions, "functions.h", _file(plans, paths.functions, functions))
        self._print(paths.functions_source, "functions.c", _file(plans, paths.functions, functions))
        encoded = [self._encoders.view(plan) for plan in plans if plan.wire is not None]
        if encoded:
            own.append(paths.type_support)
            service = _service(plans) if self._services else None
            header = {**_file(plans, paths.type_support, encoded, "header_includes"), "service": service}
            source = {**_file(plans, paths.type_support, encoded), "service": service}
            if service:
                header["includes"] = _with(
                    header["includes"], "rosidl_runtime_c/service_type_support_struct.h"
                )
                source["includes"] = _with(source["includes"], "microros/service_type.h")
            self._print(paths.type_support, "type_support.h", header)
            self._print(paths.type_support_source, "type_support.c", source)
        stored = [storage_view(plan, self._plans) for plan in plans if plan.storage]
        if stored:
            own.append(paths.storage)
            is_single = len(stored) == 1
            wording = {
                "subject": f"a {stored[0].ros_name}" if is_single else f"each message of {_title(plans)}",
                "fini": f"{stored[0].name}__fini" if is_single else "its __fini",
            }
            header = {**_file(plans, paths.storage, stored, "header_includes"), **wording}
            self._print(paths.storage, "storage.h", header)
            self._print(paths.storage_source, "storage.c", _file(plans, paths.storage, stored))
        view = {
            "title": _title(plans),
            "guard": guard(paths.header),
            "notes": [message_note(plan) for plan in plans],
            "points": not all(plan.fixed_size for plan in plans),
            "functions": PurePosixPath(paths.functions).name,
            "storage": PurePosixPath(paths.storage).name if stored else "",
            "includes": tuple(sorted(map(include_path, own))),
        }
        self._print(paths.header, "message.h", view)

    def _print(self, path: str, template: str, view: dict[str, Any]) -> None:
        text = self._environment.get_template(f"types/{template}.j2").render(view)
        self._files[path] = text.encode("utf-8")


def _with(includes: tuple[str, ...], more: str) -> tuple[str, ...]:
    return tuple(sorted({*includes, more}))


def _service(plans: Sequence[TypePlan]) -> ServiceView | None:
    """Return the view of the service whose messages these are; None where they are not of one, or one is missing."""
    name = declaring_name(plans[0].name)
    roots = {plan.name for plan in plans if plan.root}
    if name.kind != "srv" or not {derived_name(name, part) for part in SERVICE_PARTS} <= roots:
        return None
    handle = f"rosidl_typesupport_c__get_service_type_support_handle__{c_name(name)}"
    return ServiceView(c_name(name), handle, dds_type(name))


def _title(plans: Sequence[TypePlan]) -> str:
    """Return the name of the interface that the file is made from."""
    return str(declaring_name(plans[0].name))


def _file(
    plans: Sequence[TypePlan], header: str, views: Iterable[Any], includes: str = "includes"
) -> dict[str, Any]:
    """Return the view of one file: that of its messages, and what they include together.

    `header` is the header that the file is, or belongs to: it is not among its own includes. What the views
    have in common (the header of the struct) is taken from the first one.
    """
    messages = list(views)
    own = include_path(header)
    return {
        **_values(messages[0]),
        "title": _title(plans),
        "messages": messages,
        "includes": _united(messages, includes, own),
        "system_includes": _united(messages, "system_includes", own),
    }


def _united(views: Iterable[Any], name: str, own: str) -> tuple[str, ...]:
    return tuple(sorted({include for view in views for include in getattr(view, name, ())} - {own}))


def _values(view: Any) -> dict[str, Any]:
    """Return the members of a view by name."""
    return {field.name: getattr(view, field.name) for field in fields(view)}
