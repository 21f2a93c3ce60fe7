# SPDX-License-Identifier: Apache-2.0
"""Headers of messages, services and actions that sources include → types that the library must have."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from shlex import quote

from microros_gen.interfaces.find import InterfaceFinder
from microros_gen.migrate.c_tokens import Include
from microros_gen.migrate.draft import Remark
from microros_gen.typesupport.plan.names import snake_case

_HEADER = re.compile(r"(\w+)/(msg|srv|action)/(?:detail/)?(\w+?)(?:__(?:struct|functions|type_support))?\.h")


def included_types(
    includes: Iterable[Include], own: Collection[str], finder: InterfaceFinder
) -> tuple[tuple[str, ...], tuple[Remark, ...]]:
    """Return the types whose headers are included, sorted, and a remark for each header of an unknown one.

    `own` are the paths of the sources' own headers, which are no interfaces though their names look so.
    """
    found: set[str] = set()
    remarks: dict[str, Remark] = {}
    for include in includes:
        match = _HEADER.fullmatch(include.name)
        if match is None or any(path.endswith(f"/{include.name}") for path in own):
            continue
        package, kind, stem = match.groups()
        types = [t for t in finder.types(package) if t.kind == kind and snake_case(t.name) == stem]
        found.update(str(t) for t in types)
        if not types:
            remarks.setdefault(include.name, _unknown(include, package, finder))
    return tuple(sorted(found)), tuple(remarks.values())


def _unknown(include: Include, package: str, finder: InterfaceFinder) -> Remark:
    if include.name.endswith("visibility_control.h"):
        text, hint = "the library has no such header, nor a use for it", "Remove the line"
    elif finder.package(package) is None:
        text, hint = (
            f"unknown interface package '{package}'",
            "Add --interface-path and the folder of the package",
        )
    else:
        text = f"the interface package '{package}' has no such type"
        places = "".join(f" --interface-path {quote(str(path))}" for path in finder.paths)
        hint = f"`microros-gen interfaces {package}{places}` lists its types"
    # Whether what is in an #if is compiled is not known
    return Remark(f"{include.name}: {text}", include.span, refused="" if include.condition else hint)
