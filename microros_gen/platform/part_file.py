# SPDX-License-Identifier: Apache-2.0
"""A part's folder → Part: its component.yaml, and cpu.yaml or os.yaml next to it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source, Span, nearest
from microros_gen.documents.files import is_file, read_text, reason_of
from microros_gen.documents.tree_read import check_keys, expect_mapping
from microros_gen.documents.tree_read import read_text as text_at
from microros_gen.documents.tree_values import bool_of, child, entries, int_of, items, text_of
from microros_gen.documents.yaml_tree import MappingNode, YamlNode, parse_yaml
from microros_gen.platform.capabilities import capabilities
from microros_gen.platform.part import Cpu, Divisor, Driver, Fraction, Image, Os, Part, VectorTable
from microros_gen.platform.target import Target
from microros_gen.records import dataclass
from microros_gen.selection.component import Component
from microros_gen.selection.component_file import parse_component
from microros_gen.selection.extension import INSTALLED, Extensions, digest_of, own_name
from microros_gen.selection.find_components import BOARD_FILE, COMPONENT_FILE, part_files, parts_folder

_CPU_KEYS = (
    "image",
    "vector_table",
    "timer_interrupt",
    "fpu_flags",
    "stdio_heap",
    "small_data",
    "starts_itself",
    "narrow",
    "registers",
    "optional_registers",
    "drivers",
)
_IMAGE_KEYS = ("entry", "first", "first_section", "uart_handler")
_TABLE_KEYS = ("words", "least")
_DRIVER_KEYS = ("divisor", "fraction", "tx_irq", "stdio")
_BAUD_KEYS = {"divisor": ("by", "least", "most"), "fraction": ("of_hz", "bits", "unused")}
_TRANSPORTS = ("udp", "tcp", "serial", "canfd")
_OS_KEYS = ("hosted", "linker_script", "tick", "task_stack", "parts", "device", "clock_wraps")


@dataclass(frozen=True)
class PartFolder:
    """The folder of a part, and where it is from; `own`: it does not ship with the tool."""

    path: Path
    origin: str
    own: bool

    @property
    def is_component(self) -> bool:
        """Whether the part has C files; a board can be a `board.yaml` alone."""
        return is_file(self.path / COMPONENT_FILE)


def builtin_parts(kind: str) -> tuple[str, ...]:
    """Return the names of the parts of a kind that ship with the tool, sorted."""
    files = (path for name in part_files(kind) for path in (parts_folder() / kind).glob(f"*/{name}"))
    return tuple(sorted({path.parent.name for path in files}))


def find_part(
    kind: str, name: str, near: Path, span: Span | None, diagnostics: Diagnostics, extensions: Extensions
) -> PartFolder | None:
    """Find a part by its name, or a folder of the user's by its path relative to `near` (with a / in it).

    A name that is not built in is looked for in `extensions`. None and an error in `diagnostics` if nothing has it.
    """
    if "/" in name or "\\" in name:
        return PartFolder(near / name, f"folder {own_name(near / name)}", own=True)
    if name in builtin_parts(kind):
        return PartFolder(parts_folder() / kind / name, "", own=False)
    extension = extensions.part(kind, name, span, diagnostics)
    folder = extension.part(kind, name) if extension is not None else None
    if extension is None or folder is None:
        known = builtin_parts(kind)
        hint = nearest(name, known) or f"Known: {', '.join(known)}; or give a folder, ./{name}"
        diagnostics.error(f"unknown {kind} '{name}'", span, hint, id="MG-6004")
        return None
    return PartFolder(folder, extension.origin, own=True)


def read_part(
    kind: str,
    name: str,
    near: Path,
    span: Span | None,
    diagnostics: Diagnostics,
    extensions: Extensions = INSTALLED,
) -> Part | None:
    """Read a part that `find_part` finds.

    None without an error for a board that is a `board.yaml` alone. None and errors in `diagnostics` if the part does
    not exist, or one of its files is invalid.
    """
    place = find_part(kind, name, near, span, diagnostics, extensions)
    if place is None or (not place.is_component and is_file(place.path / BOARD_FILE) and kind == "board"):
        return None
    found = Diagnostics()
    component = _component(place.path, span, found)
    if place.own and component is not None and not found.has_errors():
        component = replace(component, origin=place.origin, digest=_digest(place.path, span, found))
    part = Part(kind, component, own=place.own) if component is not None else None
    if part is not None and kind in ("cpu", "os"):
        part = _with_facts(part, place.path / f"{kind}.yaml", found)
    if place.own and component is not None:
        _check(component, kind, span, found)
    diagnostics.extend(found)
    return None if found.has_errors() else part


def brought_parts(part: Part | None, span: Span | None, diagnostics: Diagnostics) -> tuple[Part, ...]:
    """Read the built-in parts that an operating system brings: they provide what the parts before them do not."""
    named = part.os.parts if part is not None and part.os is not None else ()
    read = (read_part(kind, name, parts_folder(), span, diagnostics) for kind, name in named)
    return tuple(each for each in read if each is not None)


def own_part_files(target: Target) -> tuple[tuple[str, Path], ...]:
    """Return every file of the target's parts that do not ship with the tool: what it is, and its path."""
    found = []
    for part in target.parts:
        folder = part.component.folder
        for path in sorted(p for p in folder.rglob("*") if p.is_file()) if part.own else ():
            found.append((f"part {part.component.name}/{path.relative_to(folder).as_posix()}", path))
    return tuple(found)


def _component(folder: Path, span: Span | None, diagnostics: Diagnostics) -> Component | None:
    source = _source(folder / COMPONENT_FILE, span, diagnostics)
    component = parse_component(source, diagnostics) if source is not None else None
    return replace(component, folder=folder) if component is not None else None


def _digest(folder: Path, span: Span | None, diagnostics: Diagnostics) -> str:
    try:
        return digest_of(folder)
    except OSError as error:
        what = f"cannot read '{error.filename}': {error.strerror}"
        diagnostics.error(what, span, "Keep only the files of the part in its folder", id="MG-6060")
        return ""


def _source(path: Path, span: Span | None, diagnostics: Diagnostics) -> Source | None:
    try:
        return Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        diagnostics.error(
            f"cannot read '{path}': {reason_of(error)}", span, "Give the folder of a part", id="MG-6005"
        )
        return None


def _check(component: Component, kind: str, span: Span | None, diagnostics: Diagnostics) -> None:
    """Report what the file of a user's part says and the tool does not know."""
    place = f"the {kind} '{component.name}'"
    if component.layer != "port" or not component.name.startswith("port_"):
        diagnostics.error(
            f"{place} is not a part of a platform",
            span,
            "Write `component: port_…`, `layer: port`",
            id="MG-6006",
        )
    named = [provision.capability for provision in component.provides]
    asks = (*component.asks, *(ask for provision in component.provides for ask in provision.asks))
    named += [ask.capability for ask in asks]
    for name in sorted(set(named) - set(capabilities())):
        hint = nearest(name, capabilities()) or f"Known: {', '.join(capabilities())}"
        diagnostics.error(f"{place} names an unknown capability '{name}'", span, hint, id="MG-6007")
    for provision in component.provides:
        if provision.waits_for_room and provision.capability not in _TRANSPORTS:
            what = f"{place} has 'waits_for_room' at '{provision.capability}', which is not a transport"
            hint = f"Remove it there; transports are {', '.join(_TRANSPORTS)}"
            diagnostics.error(what, span, hint, id="MG-3294")
    for file in component.files:
        if not (component.folder / "src" / file.path).is_file():
            diagnostics.error(
                f"{place} has no file 'src/{file.path}'", span, "Add it, or remove its name", id="MG-6008"
            )


def _with_facts(part: Part, path: Path, diagnostics: Diagnostics) -> Part:
    if not path.is_file():
        return replace(part, cpu=Cpu()) if part.kind == "cpu" else replace(part, os=Os())
    source = _source(path, None, diagnostics)
    tree = parse_yaml(source, diagnostics) if source is not None else None
    node = expect_mapping(tree, path.name, diagnostics)
    if node is None:
        return part
    if part.kind == "cpu":
        return replace(part, cpu=_cpu(node, diagnostics))
    check_keys(node, _OS_KEYS, (), diagnostics)
    hosted = bool_of(node.get("hosted")) or False
    linker_script = text_at(node, "linker_script", diagnostics)
    stack, least, context = (
        int_of(child(node.get("task_stack"), key)) for key in ("default", "least", "context")
    )
    return replace(
        part,
        os=Os(
            hosted,
            linker_script,
            text_at(node, "tick", diagnostics),
            stack or Os.task_stack,
            least or Os.task_stack_least,
            text_of(child(node.get("task_stack"), "macro")) or "",
            text_of(child(node.get("task_stack"), "header")) or "",
            tuple((entry.key, text_of(entry.value) or "") for entry in entries(node.get("parts"))),
            text_at(node, "device", diagnostics),
            context or Os.task_stack_context,
            bool_of(node.get("clock_wraps")) or False,
        ),
    )


def _cpu(node: MappingNode, diagnostics: Diagnostics) -> Cpu:
    check_keys(node, _CPU_KEYS, (), diagnostics)
    return Cpu(
        image=_image(node.get("image"), diagnostics),
        vector_table=_vector_table(node.get("vector_table"), diagnostics),
        timer_interrupt=text_at(node, "timer_interrupt", diagnostics),
        fpu_flags=_texts(node.get("fpu_flags")),
        stdio_heap=bool_of(node.get("stdio_heap")) or False,
        small_data=bool_of(node.get("small_data")) or False,
        starts_itself=bool_of(node.get("starts_itself")) or False,
        narrow=bool_of(node.get("narrow")) or False,
        registers=_texts(node.get("registers")),
        optional_registers=_texts(node.get("optional_registers")),
        drivers=tuple(
            driver
            for entry in entries(node.get("drivers"))
            if (driver := _driver(entry.key, entry.value, diagnostics)) is not None
        ),
    )


def _image(value: YamlNode | None, diagnostics: Diagnostics) -> Image | None:
    node = expect_mapping(value, "'image'", diagnostics)
    if node is None:
        return None
    keys = (*_IMAGE_KEYS, "no_handler", "console_handler")
    check_keys(node, keys, _IMAGE_KEYS, diagnostics)
    return Image(*(text_at(node, key, diagnostics) for key in keys))


def _vector_table(value: YamlNode | None, diagnostics: Diagnostics) -> VectorTable | None:
    node = expect_mapping(value, "'vector_table'", diagnostics)
    if node is None:
        return None
    check_keys(node, (*_TABLE_KEYS, "fixed"), _TABLE_KEYS, diagnostics)
    words, least = (int_of(node.get(key)) or 0 for key in _TABLE_KEYS)
    fixed = tuple((entry.key, text_of(entry.value) or "") for entry in entries(node.get("fixed")))
    return VectorTable(words, least, fixed)


def _driver(name: str, value: YamlNode, diagnostics: Diagnostics) -> Driver | None:
    node = expect_mapping(value, f"'drivers.{name}'", diagnostics)
    if node is None:
        return None
    check_keys(node, _DRIVER_KEYS, (), diagnostics)
    kinds = [kind for kind in _BAUD_KEYS if kind in node.entries]
    if len(kinds) != 1:
        diagnostics.error(f"'drivers.{name}' takes one of divisor, fraction", node.span, id="MG-6009")
        return None
    baud = expect_mapping(node.get(kinds[0]), f"'drivers.{name}.{kinds[0]}'", diagnostics)
    if baud is None:
        return None
    keys = _BAUD_KEYS[kinds[0]]
    check_keys(baud, keys, keys, diagnostics)
    numbers = [int_of(child(baud, key)) or 0 for key in keys]
    rate = Divisor(*numbers) if kinds[0] == "divisor" else Fraction(*numbers)
    return Driver(name, rate, int_of(node.get("tx_irq")) or 0, bool_of(node.get("stdio")) or False)


def _texts(node: YamlNode | None) -> tuple[str, ...]:
    return tuple(text_of(item) or "" for item in items(node))
