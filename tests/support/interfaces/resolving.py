# SPDX-License-Identifier: Apache-2.0
"""Packages in a folder, and requests resolved against them."""

from __future__ import annotations

from pathlib import Path

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import InterfaceSet, resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder
from tests.support.ids import without_id


def package(folder: Path, name: str, kind: str = "msg", **types: str) -> Path:
    """Make a package with the files `Type=text` of one kind."""
    (folder / name / kind).mkdir(parents=True, exist_ok=True)
    for type_name, text in types.items():
        (folder / name / kind / f"{type_name}.{kind}").write_text(text, encoding="utf-8")
    return folder / name


def resolve(finder: InterfaceFinder, *requests: str) -> tuple[InterfaceSet, list[str]]:
    diagnostics = Diagnostics()
    interfaces = resolve_interfaces(tuple(Named(request) for request in requests), finder, diagnostics)
    return interfaces, [without_id(d.headline()) for d in diagnostics]


def names(interfaces: InterfaceSet) -> list[str]:
    return [str(interface.name) for interface in interfaces]
