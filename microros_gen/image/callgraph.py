# SPDX-License-Identifier: Apache-2.0
"""The call graph of an image, with the stack that each function needs.

Frames come from gcc (`-fcallgraph-info=su`, its manual, "Developer Options") where it compiled the function, else from
the disassembly; calls come from both. Calls through pointers go to what the member that they go through can hold: the
type support's encode, encoded_size and decode, else what `pointers` finds.
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Mapping
from dataclasses import field
from typing import Literal

from microros_gen.image.attribution import Chunk
from microros_gen.image.disassembly import Code, parse_disassembly
from microros_gen.image.disassembly_avr import parse_avr
from microros_gen.image.elf import THUMB, Elf
from microros_gen.image.folder import Folder
from microros_gen.image.lines import Lines, source_places
from microros_gen.image.link_time import is_made_by_linker
from microros_gen.image.pointers import Pointers, read_pointers
from microros_gen.records import dataclass
from microros_gen.toolchain.identity import CALL_GRAPH
from microros_gen.toolchain.toolchain import run, sibling

INDIRECT = "__indirect_call"
TYPE_MEMBERS = ("encode", "encoded_size", "decode")
AVR = "EM_AVR"
"""Its compiler of Debian, gcc 5, writes no call graph: frames are those of the disassembly."""
_AVR_ARCHITECTURE, _AVR_6 = 0x7F, 6
"""Of e_flags (binutils, include/elf, avr.h): avr6 has a program counter of 22 bits."""
_ARCHIVERS = {"EM_ARM": "arm-none-eabi-ar", "EM_RISCV": "riscv64-unknown-elf-ar", AVR: "avr-ar"}
"""Of an image whose tool chain nobody named."""
ALLOCATOR_MEMBERS = ("allocate", "deallocate", "reallocate", "zero_allocate")

_NODE = re.compile(r'^node: \{ title: "([^"]*)" label: "([^"]*)"')
_EDGE = re.compile(r'^edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)" label: "([^"]*)"')
_USAGE = re.compile(r"^(\d+) bytes \(([\w,]+)\)$")


@dataclass(frozen=True)
class Frame:
    """What gcc says of a function: bytes, whether that is all, and where it calls through pointers."""

    size: int
    bounded: bool
    pointers: tuple[str, ...] = ()
    calls: tuple[str, ...] = ()


@dataclass
class Node:
    """A function. `frame` None: nothing is known of it. `open` says what keeps its need from being bounded."""

    name: str
    address: int
    frame: int | None
    origin: str
    source: str | None
    calls: set[int] = field(default_factory=set)
    open: set[str] = field(default_factory=set)


@dataclass(frozen=True)
class CallGraph:
    """Nodes by address. `compiled` is false where the compiler told no frames (clang): then nothing is bounded."""

    nodes: Mapping[int, Node]
    machine: str
    compiled: bool

    def named(self, name: str) -> Node | None:
        """Return the function of that name, the first by address."""
        found = [n for n in self.nodes.values() if n.name == name]
        return min(found, key=lambda n: n.address) if found else None


def parse_call_graph(text: str) -> Mapping[str, Frame]:
    """Return the functions of a .ci file by name, those without a frame left out."""
    sizes: dict[str, tuple[int, bool]] = {}
    calls: dict[str, list[tuple[str, str]]] = {}
    for line in text.splitlines():
        node, edge = _NODE.match(line), _EDGE.match(line)
        if node:
            usage = _USAGE.match(node[2].split("\\n")[-1])
            if usage:
                sizes[node[1]] = (int(usage[1]), usage[2] != "dynamic")
        elif edge:
            calls.setdefault(edge[1], []).append((edge[2], edge[3]))
    return {
        _plain(title): Frame(
            size,
            bounded,
            tuple(place for target, place in calls.get(title, ()) if target == INDIRECT),
            tuple(_plain(target) for target, _ in calls.get(title, ()) if target != INDIRECT),
        )
        for title, (size, bounded) in sizes.items()
    }


def build_call_graph(folder: Folder, image: Elf, chunks: Iterable[Chunk]) -> CallGraph:
    """Return the call graph of the linked image."""
    functions = {p.address: p for p in chunks if p.function and p.symbol}
    frames = _frames(folder, functions.values())
    nodes = {address: _node(chunk, frames) for address, chunk in functions.items()}
    disassembled = _disassembled(folder, image, functions)
    for code in disassembled:
        _add_code(nodes, code, _is_external(image, code))
    pointers = read_pointers(folder, image, functions)
    _add_compiled(folder, nodes, functions, frames, _constructors(image), pointers)
    pointing = [at for code in disassembled for at in code.pointers]
    places = source_places(Lines(image), pointing) if pointing else {}
    for code in disassembled:
        for address in code.pointers:
            place = places.get(address, f"{address:#x}")
            _add_targets(nodes[code.address], place, *reached(folder, place, functions, pointers))
    return CallGraph(nodes, image.machine, bool(frames or (image.machine == AVR and disassembled)))


def _frames(folder: Folder, functions: Iterable[Chunk]) -> Mapping[tuple[str, str], Frame]:
    found: dict[tuple[str, str], Frame] = {}
    for source in sorted({p.source for p in functions if p.source}):
        path = folder.object_path(source)
        path = path.with_suffix(".ci") if path is not None else None
        if path is not None and path.is_file():
            known = parse_call_graph(path.read_text(encoding="utf-8", errors="replace"))
            found.update({(source, name): frame for name, frame in known.items()})
    return found


def _node(chunk: Chunk, frames: Mapping[tuple[str, str], Frame]) -> Node:
    names = (str(chunk.symbol), *chunk.aliases)
    for name in names:
        frame = frames.get((chunk.source or "", name))
        if frame:
            node = Node(names[0], chunk.address, frame.size, "compiler", chunk.source)
            if not frame.bounded:
                node.open.add(f"{names[0]}: a frame of variable size")
            return node
    node = Node(names[0], chunk.address, None, "unknown", chunk.source)
    if chunk.owner.group == "application" and frames:
        without = (
            "link it without -flto" if is_made_by_linker(_file(chunk)) else f"compile it with {CALL_GRAPH}"
        )
        node.open.add(f"what {_file(chunk)} calls through pointers ({without})")
    return node


def _file(chunk: Chunk) -> str:
    return (chunk.source or "the application").rpartition("/")[2]


def disassembly_text(folder: Folder, image: Elf) -> str:
    """Return what objdump of its tool chain says of an image; empty: it does not exist, or it fails."""
    archiver = str(folder.tools.get("archiver") or _ARCHIVERS.get(image.machine, "ar"))
    program = sibling(archiver, "ar", "objdump")
    if program is None:
        return ""
    result = run([program, "-d", "--no-show-raw-insn", str(image.path.resolve())], folder.path)
    return result.stdout if result.returncode == 0 else ""


def _disassembled(folder: Folder, image: Elf, functions: Mapping[int, Chunk]) -> tuple[Code, ...]:
    extents = {s.address: s.size for s in image.symbols if s.function and s.size}
    text = disassembly_text(folder, image)
    if image.machine == AVR:
        of_libraries = {a for a, p in functions.items() if p.owner.group in ("compiler", "C library")}
        extents = {address: size for address, size in extents.items() if address not in of_libraries}
        wide = image.flags & _AVR_ARCHITECTURE == _AVR_6
        return parse_avr(text, extents, wide)
    return parse_disassembly(text, image.machine, extents)


def _is_external(image: Elf, code: Code) -> bool:
    sections = [s for s in image.loaded if s.address <= code.address < s.end and s.kind != "bss"]
    return any(s.name.startswith((".plt", ".iplt")) for s in sections)


def _add_code(nodes: dict[int, Node], code: Code, external: bool) -> None:
    node = nodes.get(code.address)
    if external:
        name = code.name.split("@")[0]
        nodes[code.address] = Node(
            name, code.address, None, "shared library", None, set(), {f"{name} (shared library)"}
        )
        return
    if node is None:
        node = nodes.setdefault(code.address, Node(code.name, code.address, None, "unknown", None))
    node.calls |= code.calls
    if node.frame is None:
        node.frame, node.origin = code.frame, "disassembly"
        if code.dynamic:
            node.open.add(f"{node.name}: moves the stack pointer by a register")
        if code.indirect:
            node.open.add(f"{node.name}: a call through a pointer")


def _add_compiled(
    folder: Folder,
    nodes: Mapping[int, Node],
    functions: Mapping[int, Chunk],
    frames: Mapping[tuple[str, str], Frame],
    constructors: frozenset[int],
    pointers: Pointers,
) -> None:
    """Add what the compiler knows of calls: those through pointers; the others where there is no disassembly."""
    exported = {p.symbol: a for a, p in functions.items()}
    local = {(p.source, p.symbol): a for a, p in functions.items()}
    for address, chunk in functions.items():
        frame = frames.get((chunk.source or "", str(chunk.symbol)))
        if frame is None:
            continue
        for name in frame.calls:
            to = local.get((chunk.source, name), exported.get(name))
            if to is not None:
                nodes[address].calls.add(to)
        for place in frame.pointers:
            place = place.rpartition(":")[0]
            member, targets = reached(folder, place, functions, pointers)
            if member is None and (chunk.source or "").startswith("src/port_"):
                nodes[address].calls |= constructors
                continue
            _add_targets(nodes[address], place, member, targets)


def reached(
    folder: Folder, place: str, functions: Mapping[int, Chunk], pointers: Pointers
) -> tuple[str | None, frozenset[int] | None]:
    """Return the member that a call at `file:line` goes through, and the functions that it can hold.

    None where nobody knows.
    """
    member = _member(folder, place, pointers.members)
    targets: frozenset[int] | None = _targets(member, functions)
    if member and not targets:
        targets = pointers.targets(member)
    return member, targets


def _add_targets(node: Node, place: str, member: str | None, targets: frozenset[int] | None) -> None:
    node.calls |= targets or frozenset()
    if targets is None or not member:
        what = f"the callback {member}" if member else "a call through a pointer"
        node.open.add(f"{node.name}: {what} ({place})")


def _constructors(image: Elf) -> frozenset[int]:
    """Return what runs before main: start-up code calls it through a table (.init_array)."""
    size = image.bits // 8
    order: Literal["little", "big"] = "little" if image.little else "big"
    content = b"".join(image.content(s) for s in image.loaded if s.name in (".init_array", ".preinit_array"))
    words = {int.from_bytes(content[at : at + size], order) for at in range(0, len(content), size)}
    return frozenset(word & ~THUMB if image.arm else word for word in words)


def _targets(member: str | None, functions: Mapping[int, Chunk]) -> frozenset[int]:
    """Return where a call through a member can go: the type support, or what backs the default allocator."""
    if member in TYPE_MEMBERS:
        found = (a for a, p in functions.items() if p.owner.group == "type support")
        return frozenset(a for a in found if str(functions[a].symbol).endswith(f"__{member}"))
    if member in ALLOCATOR_MEMBERS:
        return frozenset(a for a, p in functions.items() if p.symbol == f"microros_arena_{member}")
    return frozenset()


def _member(folder: Folder, place: str, pointers: Container[str]) -> str | None:
    """Return the member, or the variable among `pointers`, that a call at `file:line` goes through."""
    name, _, line = place.rpartition(":")
    lines = _lines_of(folder, name)
    text = lines[int(line) - 1] if line.isdigit() and int(line) <= len(lines) else ""
    found = re.findall(r"(?:->|\.)(\w+)\s*\(", text)
    known = [m for m in found if m in (*TYPE_MEMBERS, *ALLOCATOR_MEMBERS)]
    if not found:
        found = [name for name in re.findall(r"(\w+)\s*\(", text) if name in pointers]
    return known[0] if known else found[0] if found else None


def _lines_of(folder: Folder, name: str) -> list[str]:
    """Return the lines of a source, which the compiler was told relative to where it ran."""
    folders = folder.linked.folders if folder.linked is not None else ()
    for base in (folder.path, *folders):
        try:
            return (base / name).read_text(encoding="utf-8", errors="replace").splitlines()
        except OSError:
            continue
    return []


def _plain(title: str) -> str:
    return title.rsplit(":", 1)[-1]
