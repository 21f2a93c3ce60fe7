# SPDX-License-Identifier: Apache-2.0
"""The pages of the C API: one for each folder below include/, from the headers of the components."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from types import SimpleNamespace
from typing import cast

from generators.c_headers import Item, Section, read_header
from generators.markdown import cell
from microros_gen.client.plan.runtime import WAITED_KINDS
from microros_gen.client.plan.values import Values
from microros_gen.client.views.components import umbrellas
from microros_gen.client.views.contributions import Contributed, contributed
from microros_gen.client.views.init_options import InitOptions, init_options
from microros_gen.documents.templates import make_environment
from microros_gen.selection.component import Catalogue, Component
from microros_gen.selection.find_components import components_folder, load_catalogue

PORT_HEADERS = {
    "microros/port.h": "base",
    "microros/port_uart.h": "port_bare",
    "microros/port_cortex_m.h": "port_cortex_m",
    "microros/port_riscv.h": "port_riscv",
}
"""What a port implements or may use; the other headers below microros/ are the library's own."""

CONFIG = "microros_config.h"
_CLIENT = "existing_client"
_TITLES = {
    "microros": "Ports and configuration",
    _CLIENT: "Names of the existing client",
}
_FOLDERS = {"uxr": _CLIENT, "ucdr": _CLIENT, "rmw_microxrcedds_c": _CLIENT}
_TRANSPORTS = ("udp", "tcp", "serial", "custom")
_REFUSAL = re.compile(r"^#define (\w+) \1__\w+\n", re.MULTILINE)
"""Placeholder for a function of another transport; its name tells the caller what to set."""

_MANY = 6
_WORD = re.compile(r"`(\w+)(\(\))?`")


@dataclass(frozen=True)
class Header:
    """A public header, and the component that brings it."""

    name: str
    component: str
    sections: tuple[Section, ...]

    @property
    def page(self) -> str:
        """The page that it is on: `rcl` for rcl/node.h."""
        folder = self.name.split("/")[0]
        return _FOLDERS.get(folder, folder)


_EVERYTHING_HOLDS = cast(Values, SimpleNamespace(holds=lambda _when: True, value=lambda _path: 0))
"""Values of a plan for which every condition holds."""


class _NothingDeclared:
    """A feature of a plan whose lists are all empty: what each header has whatever an application declares."""

    def __getattr__(self, name: str) -> tuple[()]:
        return ()


@cache
def _catalogue() -> Catalogue:
    return load_catalogue()


def _ready() -> list[Component]:
    return [component for component in _catalogue().values() if component.ready]


@cache
def headers() -> tuple[Header, ...]:
    """Return every public header of the components that can be built, sorted by name."""
    found = dict(PORT_HEADERS)
    for component in _ready():
        found |= dict.fromkeys(component.headers, component.name)
    for component in _ready():  # one that replaces an empty header says what is in it
        found |= {r.header: component.name for r in component.contributes.replaces if r.header in found}
    found.pop(CONFIG)
    everything = frozenset(found)
    return tuple(Header(n, found[n], tuple(_sections(found[n], n, everything))) for n in sorted(found))


def _sections(component: str, name: str, everything: frozenset[str]) -> list[Section]:
    folder = _catalogue()[component].folder / "include"
    path = folder / name
    if path.is_file():
        return read_header(path.read_text(encoding="utf-8"))
    environment = make_environment([folder])
    shared = _contributed()
    included = [_include(h) for h in shared.includes[name] if h.startswith("microros/")]
    seen: dict[str, list[Section]] = {}
    for transport in _TRANSPORTS:
        view = {
            "headers": everything,
            "umbrellas": umbrellas(tuple(sorted(everything))),
            "contributed": shared,
            "init_options": _all_init_options(),
            "waits": SimpleNamespace(present=WAITED_KINDS, absent=()),
            "selection": SimpleNamespace(has=lambda _name: True),
            "plan": SimpleNamespace(
                transport=SimpleNamespace(kind=transport, device="/dev/ttyUSB0"),
                features=SimpleNamespace(of=lambda _name: _NothingDeclared()),
            ),
        }
        text = _REFUSAL.sub("", environment.get_template(f"{name}.j2").render(view))
        seen[text] = read_header(text)
    return [*_joined(list(seen.values())), *(section for text in included for section in read_header(text))]


@cache
def _contributed() -> Contributed:
    """Return what all components contribute, as if every condition held."""
    return contributed(_ready(), _EVERYTHING_HOLDS)


@cache
def _all_init_options() -> InitOptions:
    """Return the functions of every transport, as if all were selected."""
    return init_options(_ready(), (), _EVERYTHING_HOLDS)


def _include(header: str) -> str:
    """Return the text of a header that another one includes for its component."""
    (path,) = components_folder().glob(f"*/include/{header}")
    return path.read_text(encoding="utf-8")


def _joined(variants: list[list[Section]]) -> list[Section]:
    """Return one header that has what each of its variants declares, and says what all of them say."""
    first, *others = variants
    if not others:
        return first
    items = dict.fromkeys(item for variant in variants for section in variant for item in section.items)
    remarks = [variant[0].remark.split("\n\n") for variant in variants]
    common = [part for part in remarks[0] if all(part in other for other in remarks)]
    common.append("Which of these functions are there follows from `transport:`.")
    return [Section(first[0].title, "\n\n".join(common), tuple(items))]


@cache
def pages() -> Mapping[str, str]:
    """Return Markdown by page: `rcl` → text."""
    known = headers()
    where = {
        name: f"{header.page}.md#{name}"
        for header in known
        for section in header.sections
        for item in section.items
        for name in item.names
    }
    texts: dict[str, list[str]] = {}
    for header in known:
        parts = texts.setdefault(header.page, [f"# {_TITLES.get(header.page, f'`{header.page}/`')}"])
        parts += _header(header, where)
    texts["microros"] += _configuration()
    return {page: "\n\n".join(parts) + "\n" for page, parts in sorted(texts.items())}


def _header(header: Header, where: Mapping[str, str]) -> Iterator[str]:
    yield f"## {header.name}"
    yield f"Component `{header.component}`."
    for section in header.sections:
        if section.title:
            yield f"**{cell(section.title)}**"
        yield from _prose(section.remark, where)
        for item in section.items:
            yield from _item(item, where)


def _item(item: Item, where: Mapping[str, str]) -> Iterator[str]:
    if item.names:
        first, *others = item.names
        shown = [first, *others] if len(item.names) <= _MANY else [first, "…"]
        title = ", ".join(f"`{name}`" for name in shown)
        marks = "".join(f'<a id="{name}"></a>' for name in others)
        yield f"### {title} {{: #{first} }}"
        if marks:
            yield marks
    yield f"```c\n{item.text}\n```"
    yield from _prose(item.doc, where)


def _prose(text: str, where: Mapping[str, str]) -> Iterator[str]:
    """Yield paragraphs; indented lines stay as they are, names of the API become links."""
    for paragraph in re.split(r"\n\s*\n", text) if text else ():
        if all(line.startswith("  ") for line in paragraph.splitlines()):
            yield f"```c\n{paragraph}\n```"
        else:
            yield _WORD.sub(lambda found: _link(found, where), cell(paragraph))


def _link(found: re.Match[str], where: Mapping[str, str]) -> str:
    return f"[{found[0]}]({where[found[1]]})" if found[1] in where else found[0]


def _configuration() -> Iterator[str]:
    """Yield the section of the plan's constants: names alone, since each plan has its own values."""
    text = (components_folder() / "base" / "include" / f"{CONFIG}.j2").read_text(encoding="utf-8")
    yield f"## {CONFIG}"
    yield (
        "Component `base`. The plan as constants; the values are in OUT/include/microros_config.h. "
        "Sizes are bytes, times milliseconds; a constant is there when the selection needs it."
    )
    config = _contributed().config
    for part in text.split("\n/* ")[2:]:
        title = part.split(" */")[0].split(":")[0]
        lines = "\n".join([part, *config.get(title, ())])
        names = dict.fromkeys(re.findall(r"^#define (MICROROS_\w+)", lines, re.MULTILINE))
        if names and "." not in title:
            yield f"{cell(title)}: " + ", ".join(f"`{name}`" for name in names)
