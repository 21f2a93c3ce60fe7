# SPDX-License-Identifier: Apache-2.0
"""The worst-case stack: the heaviest chain of calls below each public function, main and interrupt handlers.

What cannot be bounded (callbacks of the application, functions of shared libraries, recursion, frames of variable
size) is named; the number then counts everything else.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from microros_gen.image.callgraph import AVR, CallGraph, Node
from microros_gen.image.elf import THUMB, Elf
from microros_gen.records import dataclass
from microros_gen.toolchain.identity import CALL_GRAPH

_API = re.compile(r"^(rclc?|rmw|rcutils|micro_ros_utilities)_")
_PLAN = re.compile(r"__plan_[0-9a-f]{16}$")
_TRAP = re.compile(r"(trap_entry|trap_vector|_Handler|_handler|_isr|_ISR)$")
_BARE = ("EM_ARM", "EM_RISCV")
# avr-libc's names. An interrupt disables all others until it ends (AVR Instruction Set Manual, RETI).
_AVR_VECTOR = re.compile(r"^__vector_[0-9]+$")
# What the hardware pushes when an interrupt comes: 8 words, with the floating-point unit 26, and one to align
# (Armv7-M Architecture Reference Manual, B1.5.7). RISC-V pushes nothing itself.
_ARM_EXCEPTION, _ARM_EXCEPTION_FLOAT = 36, 108
_ARM_HARD_FLOAT = 0x400
# System V ABI for AMD64, 3.2.2: a leaf may use the 128 bytes below the stack pointer.
_RED_ZONE = {"EM_X86_64": 128}


@dataclass(frozen=True)
class Link:
    """A function of a chain: its frame, bytes, and who says so (compiler, disassembly)."""

    name: str
    frame: int
    origin: str


@dataclass(frozen=True)
class Bound:
    """The worst stack of a call of `name`. `open` names what the bytes leave out; empty: a bound."""

    name: str
    bytes: int
    chain: tuple[Link, ...]
    open: tuple[str, ...]
    kind: str


@dataclass(frozen=True)
class StackReport:
    """`functions`: the public ones, heaviest first. `total` is main's (or the reset handler's) with every interrupt
    on top of it once (of an AVR the heaviest, as they do not nest); `hardware` bytes of them are pushed at interrupts
    or lie below the stack pointer.

    `known` is false where the compiler tells no frames: then there are no numbers.
    """

    known: bool
    why: str
    total: int
    main: Bound | None
    handlers: tuple[Bound, ...]
    functions: tuple[Bound, ...]
    hardware: int

    @property
    def open(self) -> tuple[str, ...]:
        """What `total` leaves out."""
        parts = (self.main, *self.handlers) if self.main else self.functions
        return tuple(sorted({name for bound in parts if bound for name in bound.open}))


def stack_report(graph: CallGraph, image: Elf, public: Iterable[str]) -> StackReport:
    """Return the bounds of an image; `public` are the names that the library exports in it."""
    if not graph.compiled:
        why = f"nothing says what functions take (gcc 10 and newer write it beside the objects: {CALL_GRAPH})"
        return StackReport(False, why, 0, None, (), (), 0)
    worst = _Worst(graph)
    start = _start(graph, image)
    main = worst.bound(start, "start") if start else None
    handlers = tuple(worst.bound(n, "interrupt") for n in _handlers(graph, image))
    api = (n for n in map(graph.named, sorted(public)) if n and _API.match(n.name))
    functions = sorted((worst.bound(n, "function") for n in api), key=lambda b: (-b.bytes, b.name))
    hardware = _RED_ZONE.get(image.machine, 0) + _exception(image) * len(handlers)
    most = main.bytes if main else max((b.bytes for b in functions), default=0)
    nested = max if image.machine == AVR else sum
    total = most + nested([b.bytes for b in handlers] or [0]) + hardware
    return StackReport(True, "", total, main, handlers, tuple(functions), hardware)


def bound_of(graph: CallGraph, name: str) -> Bound | None:
    """Return the bound of one function of the image, or None without one of that name."""
    node = graph.named(name)
    return _Worst(graph).bound(node, "function") if node else None


def shown_name(name: str) -> str:
    """Return a function's name as the application writes it: without the suffix that ties it to its plan."""
    return _PLAN.sub("", name)


def _start(graph: CallGraph, image: Elf) -> Node | None:
    """Return where a bare-metal image begins; below an operating system, main: what comes before is not its own."""
    reset = graph.nodes.get(image.entry & ~THUMB if image.arm else image.entry)
    return reset if reset and image.machine in _BARE else graph.named("main")


def _handlers(graph: CallGraph, image: Elf) -> Iterator[Node]:
    """Yield the interrupt and fault handlers: those of the vector table (Cortex-M), or known by their names."""
    if image.machine == AVR:
        yield from (node for _, node in sorted(graph.nodes.items()) if _AVR_VECTOR.match(node.name))
    if image.machine not in _BARE or graph.nodes.get(image.entry & ~THUMB) is None:
        return
    vectors = _vectors(image)
    for address, node in sorted(graph.nodes.items()):
        if address in vectors or (not vectors and _TRAP.search(node.name) and address != image.entry):
            yield node


def _vectors(image: Elf) -> frozenset[int]:
    """Return the handlers of a Cortex-M's vector table: an object whose second word is the reset handler."""
    reset = image.entry & ~THUMB
    for symbol in image.symbols if image.arm else ():
        section = next((s for s in image.loaded if s.index == symbol.section), None)
        if symbol.function or symbol.size < 8 or section is None or section.kind == "bss":
            continue
        begin = symbol.address - section.address
        content = image.content(section)[begin : begin + symbol.size]
        words = [int.from_bytes(content[at : at + 4], "little") for at in range(0, len(content) - 3, 4)]
        if words[1] == reset | THUMB:
            return frozenset(word & ~THUMB for word in words[2:] if word & THUMB) - {reset}
    return frozenset()


def _exception(image: Elf) -> int:
    if not image.arm:
        return 0
    return _ARM_EXCEPTION_FLOAT if image.flags & _ARM_HARD_FLOAT else _ARM_EXCEPTION


class _Worst:
    """The heaviest chain from each function; results are kept. A cycle is open: recursion has no bound."""

    def __init__(self, graph: CallGraph) -> None:
        self._nodes: Mapping[int, Node] = graph.nodes
        self._known: dict[int, tuple[int, tuple[int, ...]]] = {}
        self._recursive: set[int] = set()

    def bound(self, node: Node, kind: str) -> Bound:
        size, path = self._heaviest(node.address, ())
        links = (self._nodes[address] for address in path)
        chain = tuple(Link(shown_name(n.name), n.frame or 0, n.origin) for n in links)
        return Bound(shown_name(node.name), size, chain, tuple(sorted(self._open(node.address))), kind)

    def _heaviest(self, address: int, above: tuple[int, ...]) -> tuple[int, tuple[int, ...]]:
        if address in above:
            self._recursive.add(address)
            return 0, ()
        if address not in self._known:
            node = self._nodes[address]
            called = (a for a in sorted(node.calls) if a in self._nodes and self._nodes[a].frame is not None)
            below = [self._heaviest(a, (*above, address)) for a in called]
            size, path = max(below, key=lambda b: (b[0], len(b[1])), default=(0, ()))
            self._known[address] = ((node.frame or 0) + size, (address, *path))
        return self._known[address]

    def _open(self, address: int) -> set[str]:
        found: set[str] = set()
        seen, waiting = {address}, [address]
        while waiting:
            node = self._nodes.get(waiting.pop())
            if node is None:
                continue
            found |= node.open
            if node.frame is None and node.origin == "unknown":
                found.add(f"{node.name}: no information")
            if node.address in self._recursive:
                found.add(f"{node.name}: recursion")
            new = node.calls - seen
            seen |= new
            waiting += sorted(new)
        return found
