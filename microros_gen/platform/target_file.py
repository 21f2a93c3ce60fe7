# SPDX-License-Identifier: Apache-2.0
"""Target files → Target. A file may extend another one: `merge_target` lays it over what that one says."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise
from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source, nearest, reads
from microros_gen.documents.files import read_text
from microros_gen.documents.tree_values import (
    bool_of,
    child,
    entries,
    int_of,
    items,
    number_of,
    size_of,
    text_of,
)
from microros_gen.documents.yaml_tree import (
    Entry,
    MappingNode,
    ScalarNode,
    SequenceNode,
    YamlNode,
    parse_yaml,
)
from microros_gen.platform.capabilities import capabilities
from microros_gen.platform.part import KINDS, Part
from microros_gen.platform.part_file import brought_parts, read_part
from microros_gen.platform.stdio_file import check_stdio, read_stdio, tx_offset
from microros_gen.platform.target import (
    OWN_DRIVER,
    Emulator,
    Memory,
    Region,
    Target,
    Uart,
    UniqueId,
)
from microros_gen.selection.extension import INSTALLED, Extensions

SCHEMA = Path(__file__).with_name("target.schema.json")
PORTS_FILE = Path(__file__).with_name("ports.yaml")
_REQUIRED = ("target", "summary", "os", "compilers", "archivers", "package")
_ADDED = ("c_flags", "link_flags", "libraries")
_ADDRESS_SPACE = 1 << 32


@reads
def parse_target(source: Source, diagnostics: Diagnostics, builtin: bool = False) -> MappingNode | None:
    """Return what one target file says; None and errors in `diagnostics` where it does not hold.

    A user's file is validated against its JSON Schema; `builtin` files are not, tests do that.
    """
    found = Diagnostics()
    tree = parse_yaml(source, found)
    if not found.has_errors() and not (builtin and isinstance(tree, MappingNode)):
        from microros_gen.documents.schema import load_schema, validate

        validate(tree, source, load_schema(SCHEMA), found)
    if isinstance(tree, MappingNode) and not found.has_errors():
        tree = _with_parts(tree, found)
    diagnostics.extend(found)
    return tree if isinstance(tree, MappingNode) and not found.has_errors() else None


@cache
def _ports() -> MappingNode:
    tree = parse_yaml(Source(PORTS_FILE.name, read_text(PORTS_FILE)), Diagnostics())
    assert isinstance(tree, MappingNode)
    return tree


def _with_parts(node: MappingNode, diagnostics: Diagnostics) -> MappingNode:
    """Write `port:` out as its parts (ports.yaml), at the same place."""
    port = node.entries.get("port")
    if port is None:
        return node
    known = _ports().entries
    name = text_of(port.value) or ""
    if name not in known:
        hint = nearest(name, known) or f"Write `cpu:` and `os:` instead; {', '.join(known)} are taken, too"
        diagnostics.error(f"unknown port '{name}'", port.value.span, hint, id="MG-6010")
        return node
    parts = {
        entry.key: Entry(entry.key, port.key_span, replace(entry.value, span=port.value.span))
        for entry in entries(known[name].value)
        if isinstance(entry.value, ScalarNode)
    }
    rest = {key: entry for key, entry in node.entries.items() if key != "port"}
    return MappingNode({**parts, **rest}, node.span)


def merge_target(node: MappingNode, base: MappingNode) -> MappingNode:
    """Lay `node` over the target that it extends: lists of flags and libraries grow, all else is replaced."""
    merged = {**base.entries, **node.entries}
    for key in _ADDED:
        own, below = node.entries.get(key), base.entries.get(key)
        if own is not None and below is not None:
            both = SequenceNode((*items(below.value), *items(own.value)), own.value.span)
            merged[key] = Entry(key, own.key_span, both)
    return MappingNode(merged, node.span)


def target_of(
    node: MappingNode, diagnostics: Diagnostics, extensions: Extensions = INSTALLED
) -> Target | None:
    """Return the target that a (merged) tree describes; None and errors where something lacks or contradicts."""
    for key in _REQUIRED:
        if key not in node.entries:
            hint = f"Add `{key}: …`, or `extends: cortex-m4` and its like, which have it"
            diagnostics.error(f"missing key '{key}' in the target", node.span, hint, id="MG-6011")
    if diagnostics.has_errors():
        return None
    target = _target(node, _parts(node, diagnostics, extensions))
    _check(node, target, diagnostics)
    return None if diagnostics.has_errors() else target


def _parts(node: MappingNode, diagnostics: Diagnostics, extensions: Extensions) -> tuple[Part, ...]:
    """Read the parts that a target names, and those that they bring; a path is relative to the file that has it."""
    found: dict[str, Part] = {}
    for kind in KINDS:
        value = node.get(kind)
        if value is not None:
            folder = Path(value.span.source.name).parent
            name = text_of(value) or ""
            part = read_part(kind, name, folder, value.span, diagnostics, extensions)
            for each in (part, *brought_parts(part, value.span, diagnostics)):
                if each is not None:
                    found.setdefault(each.component.name, each)
    return tuple(found.values())


def _target(node: MappingNode, parts: tuple[Part, ...]) -> Target:
    hosted = bool_of(node.get("hosted"))
    if hosted is None:
        hosted = next((part.os.hosted for part in parts if part.os is not None), False)
    return Target(
        name=_text(node, "target"),
        summary=_text(node, "summary"),
        parts=parts,
        compilers=_texts(node.get("compilers")),
        archivers=_texts(node.get("archivers")),
        package=_text(node, "package"),
        c_flags=_texts(node.get("c_flags")),
        link_flags=_texts(node.get("link_flags")),
        libraries=_texts(node.get("libraries")),
        image_suffix=_text(node, "image_suffix"),
        hosted=hosted,
        data_model=text_of(node.get("data_model")) or Target.data_model,
        transport=text_of(node.get("transport")),
        clock_hz=int_of(node.get("clock_hz")) or 0,
        cpu_hz=int_of(node.get("cpu_hz")) or 0,
        cycles_per_instruction=_cycles(node.get("cycles_per_instruction")),
        flash=_region(node.get("flash")),
        ram=_region(node.get("ram")),
        uart=_uart(node.get("uart"), parts),
        unique_id=_unique_id(node.get("unique_id")),
        emulator=_emulator(node.get("emulator")),
        interrupts=tuple(
            sorted((int(e.key), text_of(e.value) or "") for e in entries(node.get("interrupts")))
        ),
        registers=tuple(sorted((e.key, int_of(e.value) or 0) for e in entries(node.get("registers")))),
        memories=tuple(_memory(e) for e in entries(node.get("memories"))),
        clocks_hook=text_of(child(node.get("hooks"), "clocks")) or "",
        watchdog_hook=text_of(child(node.get("hooks"), "watchdog")) or "",
        stdio=read_stdio(node.get("stdio"), parts),
        provides=_texts(node.get("provides")),
    )


def _cycles(node: YamlNode | None) -> Fraction | None:
    """Return the number as it is written: 1.1 is eleven tenths."""
    number = number_of(node)
    return Fraction(str(number)) if number is not None else None


def _region(node: YamlNode | None) -> Region | None:
    if node is None:
        return None
    origin, size, offset = child(node, "origin"), child(node, "size"), child(node, "offset")
    return Region(int_of(origin) or 0, size_of(size) or 0, size_of(offset) or 0)


def _memory(entry: Entry) -> Memory:
    region = _region(entry.value) or Region(0, 0)
    return Memory(entry.key, region, _texts(child(entry.value, "holds")))


def _uart(node: YamlNode | None, parts: tuple[Part, ...]) -> Uart | None:
    if node is None:
        return None
    base, irq, clock_hz = (int_of(child(node, key)) or 0 for key in ("base", "irq", "clock_hz"))
    pins = [int_of(child(node, key)) for key in ("tx_pin", "rx_pin")]
    tx_pin, rx_pin = (-1 if pin is None else pin for pin in pins)
    driver, tx_irq = text_of(child(node, "driver")) or "", int_of(child(node, "tx_irq"))
    if tx_irq is None:
        tx_irq = irq + tx_offset(driver, parts)
    return Uart(driver, base, irq, clock_hz, tx_pin, rx_pin, tx_irq)


def _unique_id(node: YamlNode | None) -> UniqueId | None:
    if node is None:
        return None
    return UniqueId(int_of(child(node, "address")) or 0, int_of(child(node, "words")) or 0)


def _emulator(node: YamlNode | None) -> Emulator | None:
    if node is None:
        return None
    program, package = (text_of(child(node, key)) or "" for key in ("program", "package"))
    return Emulator(program, package, _texts(child(node, "arguments")))


def _check(node: MappingNode, target: Target, diagnostics: Diagnostics) -> None:
    """Report what the schema cannot say: what belongs together, and what the parts do not have."""
    _check_provides(node, diagnostics)
    _check_memory(node, diagnostics)
    _check_uart(node, target, diagnostics)
    _check_interrupts(node, target, diagnostics)
    check_stdio(node, target, diagnostics)
    _check_image_keys(node, target, diagnostics)
    _check_registers(node, target, diagnostics)
    if target.linker_script is not None and target.cpu.image is None:
        hint = "Add `image: {entry: …, first: …, first_section: …, uart_handler: …}` to its cpu.yaml"
        diagnostics.error(
            f"{target.cpu_name} has no start-up code for an image", node.span, hint, id="MG-6012"
        )


def _check_provides(node: MappingNode, diagnostics: Diagnostics) -> None:
    for item in items(node.get("provides")):
        name = text_of(item) or ""
        if name not in capabilities():
            hint = nearest(name, capabilities()) or f"Known: {', '.join(capabilities())}"
            diagnostics.error(f"unknown capability '{name}'", item.span, hint, id="MG-6013")


def _check_registers(node: MappingNode, target: Target, diagnostics: Diagnostics) -> None:
    cpu, name_of = target.cpu, target.cpu_name
    known = (*cpu.registers, *cpu.optional_registers)
    for entry in entries(node.get("registers")):
        if entry.key not in known:
            hint = nearest(entry.key, known) or f"Known: {', '.join(known) or 'none'}"
            diagnostics.error(f"{name_of} has no register '{entry.key}'", entry.key_span, hint, id="MG-6014")
    if target.hosted or not target.has_image:
        return
    for name in cpu.registers:
        if child(node.get("registers"), name) is None:
            hint = f"Add `registers: {{{name}: 0x…}}`"
            diagnostics.error(f"{name_of} needs the address of {name}", node.span, hint, id="MG-6015")


def _check_uart(node: MappingNode, target: Target, diagnostics: Diagnostics) -> None:
    uart, driver = node.get("uart"), child(node.get("uart"), "driver")
    if driver is None:
        return
    if text_of(driver) == OWN_DRIVER:
        for entry in entries(uart):
            if entry.key != "driver":
                message = f"'uart.{entry.key}' has no effect: the application drives the line"
                diagnostics.error(
                    message, entry.key_span, "Remove it; its handlers go into `interrupts:`", id="MG-6016"
                )
        return
    for key in ("base", "irq"):
        if child(uart, key) is None:
            diagnostics.error(
                f"missing key '{key}' in 'uart'", (uart or node).span, f"Add `{key}: …`", id="MG-6017"
            )
    name = text_of(driver) or ""
    if target.cpu.driver(name) is None:
        known = (*(item.name for item in target.cpu.drivers), OWN_DRIVER)
        has = f"Its drivers are: {', '.join(known)}. Without `uart:` the application provides port_serial_*"
        diagnostics.error(
            f"{target.cpu_name} has no driver '{name}'",
            driver.span,
            nearest(name, known) or has,
            id="MG-6018",
        )


def _check_memory(node: MappingNode, diagnostics: Diagnostics) -> None:
    flash, ram = node.get("flash"), node.get("ram")
    for name, present, other, missing in (("flash", flash, "ram", ram), ("ram", ram, "flash", flash)):
        if present is not None and missing is None:
            hint = f"Add `{other}: {{origin: 0x20000000, size: 64 KiB}}`"
            diagnostics.error(
                f"'{name}' without '{other}' is not enough for an image", present.span, hint, id="MG-6019"
            )
    if flash is None or ram is None:
        return
    if node.get("clock_hz") is None:
        hint = "Add `clock_hz: …`, the frequency of the system timer"
        diagnostics.error("an image needs the key 'clock_hz'", node.span, hint, id="MG-6020")
    _check_regions(node, diagnostics)


def _check_regions(node: MappingNode, diagnostics: Diagnostics) -> None:
    """Report memories that end beyond the address space, overlap, or hold what another one holds."""
    parts = [(name, value) for name in ("flash", "ram") if (value := node.get(name)) is not None]
    parts += [(f"memories.{e.key}", e.value) for e in entries(node.get("memories"))]
    regions = sorted(((_region(value) or Region(0, 0), name, value) for name, value in parts), key=_origin_of)
    for region, name, value in regions:
        if region.origin + region.size > _ADDRESS_SPACE:
            diagnostics.error(
                f"'{name}' ends beyond the 32-bit address space", value.span, "Lower its size", id="MG-6021"
            )
        if region.offset >= region.size:
            diagnostics.error(
                f"'{name}.offset' leaves no room in '{name}'", value.span, "Lower the offset", id="MG-6022"
            )
    for (first, name, value), (second, other, after) in pairwise(regions):
        if first.origin + first.size > second.origin:
            names = " and ".join(f"'{n}'" for n in sorted((name, other)))
            later = max(value, after, key=lambda part: (part.span.line, part.span.column))
            diagnostics.error(f"{names} overlap", later.span, "Lower a size, or move an origin", id="MG-6023")
    held: dict[str, str] = {}
    for entry in entries(node.get("memories")):
        for item in items(child(entry.value, "holds")):
            what = text_of(item) or ""
            if held.setdefault(what, entry.key) != entry.key:
                message = f"'{what}' is already in 'memories.{held[what]}'"
                diagnostics.error(message, item.span, "Remove it here or there", id="MG-6024")


def _origin_of(part: tuple[Region, str, YamlNode]) -> int:
    return part[0].origin


def _check_image_keys(node: MappingNode, target: Target, diagnostics: Diagnostics) -> None:
    """Report keys that only an image has."""
    if target.cpu.starts_itself:
        _check_foreign_start(node, target, diagnostics)
        return
    if node.get("flash") is not None and target.os.linker_script and not target.hosted:
        return
    for owner, key in (("memories", None), ("stdio", None), ("hooks", "clocks")):
        found = node.get(owner) if key is None else child(node.get(owner), key)
        if found is not None:
            name = owner if key is None else f"{owner}.{key}"
            hint = "Add `flash` and `ram`, or remove it"
            diagnostics.error(
                f"'{name}' has no effect without an image of this project", found.span, hint, id="MG-6025"
            )


def _check_foreign_start(node: MappingNode, target: Target, diagnostics: Diagnostics) -> None:
    """Report keys of start-up code, vectors and linker script where those are the C library's."""
    for owner, key in (
        ("memories", None),
        ("stdio", None),
        ("interrupts", None),
        ("hooks", "clocks"),
        ("flash", "offset"),
    ):
        found = node.get(owner) if key is None else child(node.get(owner), key)
        if found is not None:
            name = owner if key is None else f"{owner}.{key}"
            diagnostics.error(
                f"'{name}' has no effect: the C library of {target.cpu_name} starts the image",
                found.span,
                "Remove it; write it as the C library documents (`ISR(…)`, `-Wl,--section-start`)",
                id="MG-6035",
            )


def _check_interrupts(node: MappingNode, target: Target, diagnostics: Diagnostics) -> None:
    taken = dict.fromkeys(target.uart.interrupts if target.uart else (), "uart")
    irq, stdio = child(node.get("stdio"), "irq"), target.stdio
    if irq is not None and stdio is not None and stdio.interrupt is not None:
        if stdio.interrupt in taken and target.uart is not None and target.uart.base != stdio.base:
            text = f"interrupt {stdio.interrupt} is taken by 'uart'"
            diagnostics.error(text, irq.span, "Write the interrupt of this UART", id="MG-6034")
        taken.setdefault(stdio.interrupt, "stdio")
    for entry in entries(node.get("interrupts")):
        owner = taken.get(int(entry.key))
        if owner is not None:
            hint = f"Remove it here, or remove `{owner}:`"
            diagnostics.error(
                f"interrupt {entry.key} is taken by '{owner}'", entry.key_span, hint, id="MG-6030"
            )


def _text(node: MappingNode, key: str) -> str:
    return text_of(node.get(key)) or ""


def _texts(node: YamlNode | None) -> tuple[str, ...]:
    return tuple(text_of(item) or "" for item in items(node))
