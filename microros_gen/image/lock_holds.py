# SPDX-License-Identifier: Apache-2.0
"""The longest time for which each task of an image holds the library's lock, in instructions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from microros_gen.diagnostics import Diagnostic
from microros_gen.diagnostics.notes import notes_of
from microros_gen.image.attribution import Chunk
from microros_gen.image.callgraph import disassembly_text, reached
from microros_gen.image.decoders import least_of
from microros_gen.image.dwarf import read_units
from microros_gen.image.elf import Elf
from microros_gen.image.flow import Flow, Step, read_flows
from microros_gen.image.folder import Folder
from microros_gen.image.guards import Written
from microros_gen.image.holds import Hold, Holds, Rules
from microros_gen.image.inlined import Inlined
from microros_gen.image.lines import Lines, source_places
from microros_gen.image.link_time import refuse_remade
from microros_gen.image.paths import UNIT, Length, inner_parts, parts_of
from microros_gen.image.pointers import read_pointers
from microros_gen.image.report import SizeReport
from microros_gen.image.rounds import READ, SIZE_OF, Sources, is_of_cdr
from microros_gen.image.samples import Samples
from microros_gen.records import dataclass

OF_SESSION = "rclc_tasks_run_session"
"""The entry of the task that receives and sends."""
_ASKS_TURN = ("xrce_turn_is_mine", "xrce_turn_begin")
"""Functions that say to all other tasks that they do not receive and send, unless one of them borrows the turn."""
_BORROWS = "xrce_turn_borrow"
_LIBRARIES = ("C library", "compiler")
_BEGINS = re.compile(r"^cdr_(?:loan_)?decode$")
"""Functions that begin to read a message."""
_UNKNOWN = "an unknown number of bytes"
_READS_ON = re.compile(r"^(?:cdr_get_\w+|\w+__decode)$")
"""Functions that read what follows in a message, and leave it behind."""
_THIRD_IS_SIZE = re.compile(
    r"^(?:mem(?:cpy|move|set|cmp|chr|ccpy)|str(?:ncpy|ncmp)|__aeabi_mem(?:cpy|move)[48]?)(?:\.|$)"
)
"""Functions of libraries whose third argument says how many bytes they handle. Others may have any number there."""


@dataclass(frozen=True)
class TaskHold:
    """How long the task `name` holds the lock: `holds`, the longest first. `automatic`: the application file wants the
    number to follow from the image. `used`: instructions that the analysis used, 0: a time that the file has.
    `unseen`: why it may have further holds."""

    name: str
    holds: tuple[Hold, ...]
    automatic: bool
    used: int
    found: bool = True
    unseen: frozenset[str] = frozenset()

    @property
    def open(self) -> tuple[str, ...]:
        """What keeps its longest hold from having a bound; empty: it has one."""
        if not self.found:
            return ("its entry is not in the image",)
        return tuple(sorted(self.unseen.union(*(hold.length.open for hold in self.holds))))

    @property
    def instructions(self) -> int | None:
        """The longest hold; None: nobody can say."""
        return None if self.open else max((hold.length.count for hold in self.holds), default=0)


class _Image:
    """The code of an image, and what is known of it besides."""

    def __init__(self, report: SizeReport, image: Elf, port: int | None) -> None:
        folder = report.folder
        refuse_remade(folder, report.chunks)
        self._functions: Mapping[int, Chunk] = {
            p.address: p for p in report.chunks if p.function and p.symbol
        }
        self.flows = read_flows(disassembly_text(folder, image), image)
        self.names = {a: str(p.symbol) for a, p in self._functions.items()}
        self.names.update({a: flow.name for a, flow in self.flows.items() if a not in self.names})
        self._lines, self._inlined, self._port = Lines(image), Inlined(image), port
        self._units = read_units(image)
        self._sources = Sources(_reader(folder), _headers(folder), _decoders(folder))
        self._samples = Samples(folder)
        self._sized = self._functions_with_size(_sized_names(folder))
        self._targets = _targets(folder, image, self._functions, self.flows, self._lines)

    def address(self, name: str) -> int | None:
        """Return the address of a function, or None if the image does not contain it."""
        return min((a for a, n in self.names.items() if n == name), default=None)

    def rules(self, zero: frozenset[int] = frozenset()) -> Rules:
        """Return what the code does not say."""
        return Rules(
            self._rounds,
            self._targets.get,
            self._bytes,
            self._of_port,
            zero,
            self._calls,
            self._has_size,
            self._of_call,
            self._sources.body,
        )

    def _rounds(self, flow: Flow, head: int, part: frozenset[int], size: int | None) -> Length:
        if head in flow.rounds:
            return Length(flow.rounds[head])
        if self._is_library(flow.address):
            return self._of_library(flow, part, size)
        inner = inner_parts({a: flow.steps[a].next for a in part}, head)
        own = part.difference(*inner)
        ends = [self._places(_left(flow, each)) for each in (part, *inner)]
        within = [place for each in ends[1:] for place in each]
        rounds = self._sources.rounds(ends[0], self._places(own), within, (flow.name, size))
        if isinstance(rounds, Length):
            return rounds if self._decodes(flow.address) else rounds.of(self._sources.body)
        written = [self._written(flow, a) for a in _left(flow, part)]
        if (
            written
            and not inner
            and (most := [w.count for w in written if w is not None])
            and None not in written
        ):
            return Length(max(most))
        return Length(1, frozenset({f"{flow.name}: a loop without a bound ({rounds})"}))

    def _places(self, addresses: Iterable[int]) -> list[tuple[str, int]]:
        places = map(self._lines.place, addresses)
        return sorted({place for place in places if place is not None})

    def _of_library(self, flow: Flow, part: frozenset[int], size: int | None) -> Length:
        """Return the rounds of a loop of memcpy and the like: each handles a byte or more, of `size` at most.

        What every round moves a register on by, from which it loads, is handled at once, but for the first and last.
        """
        if size is None:
            return Length(1, frozenset({_UNKNOWN}))
        forks = sum(1 for a in part if sum(to in part for to in flow.steps[a].next) > 1)
        stored = 0 if forks else sum(flow.steps[a].stored for a in part)
        far = max((flow.steps[a].moved for a in part if _is_in_each_round(flow, part, a)), default=0)
        if size == READ:
            return Length(2 if far and not stored else 0, rate=-(-UNIT // (stored or far or 1)))
        return Length(size // stored if stored else min(size, size // far + 2) if far else size)

    def _functions_with_size(self, names: frozenset[str]) -> frozenset[int]:
        """Return the functions whose work depends on their third argument: of libraries, of `names`, and what hands
        it on to those."""
        found = {a for a, flow in self.flows.items() if flow.name in names or self._is_library(a)}
        passing = {a: {s.call for s in flow.steps.values() if s.passes} for a, flow in self.flows.items()}
        while more := {a for a, to in passing.items() if a not in found and not found.isdisjoint(to)}:
            found |= more
        return frozenset(found)

    def _has_size(self, flow: Flow) -> bool:
        """Return whether each round of the loops of a function handles a byte or more, wherever it begins."""
        return self._is_library(flow.address)

    def _is_library(self, address: int) -> bool:
        chunk = self._functions.get(address)
        return chunk is not None and chunk.owner.group in _LIBRARIES

    def _bytes(self, flow: Flow, step: Step, size: int | None) -> int | None:
        if step.call is None or step.call not in self._sized:
            return None
        is_argument = not self._is_library(step.call) or _THIRD_IS_SIZE.match(self.names.get(step.call, ""))
        if is_argument and (step.size is not None or (step.passes and size is not None)):
            return step.size if step.size is not None else size
        if not self._is_library(step.call):
            return None
        place, written = self._lines.place(step.address), self._written(flow, step.address)
        if written is not None:
            return written.bytes
        found = self._sources.size(place) if place is not None else None
        return self._sources.body if found == READ and not self._decodes(flow.address) else found

    def _decodes(self, address: int) -> bool:
        """Return whether a function reads a message, and has no part that reads another one."""
        name = self.names.get(address, "").partition(".")[0]
        return not _BEGINS.match(name) and self._sources.decodes(self._units.get(address, ""))

    def _of_call(self, flow: Flow, step: Step, to: int, length: Length) -> Length:
        """Return the length of a call: how much is read is known where a message begins; and where it is open."""
        name = self.names.get(to, "")
        if not self._is_library(to):
            length = length.called(self._sources.all_calls(self._units.get(to, ""), name.partition(".")[0]))
        if _UNKNOWN in length.open and not self._is_library(flow.address):
            at = self._sources.shown(self._lines.place(step.address))
            why = f"{flow.name}: {name} is called for {_UNKNOWN} ({at})"
            length = replace(length, open=length.open - {_UNKNOWN} | {why})
        if self._decodes(flow.address):
            if not self._decodes(to) or not _READS_ON.match(name):
                return replace(length, least=0)
            return replace(length, apart=length.rate > 0, least=max(length.least, least_of(name)))
        return length.of(self._samples.size(name) or self._sources.body)

    def _written(self, flow: Flow, address: int) -> Written | None:
        """Return what the function of microros/cdr.h that an instruction is of writes at most."""
        place = self._lines.place(address)
        if place is None or not is_of_cdr(place[0]):
            return None
        unit = self._units.get(flow.address, "")
        return self._sources.written(self._inlined.calls(address), flow.name, unit)

    def _calls(self, flow: Flow, step: Step) -> int | None:
        place = None if self._is_library(flow.address) else self._lines.place(step.address)
        return self._sources.calls(place) if place is not None else None

    def _of_port(self, name: str, length: Length) -> Length:
        return Length(self._port) if length.open and self._port is not None else length


def _is_in_each_round(flow: Flow, part: frozenset[int], address: int) -> bool:
    """Return whether no way round a loop leaves out an instruction of it."""
    others = {
        a: [to for to in flow.steps[a].next if to in part and to != address] for a in part if a != address
    }
    return not any(len(each) > 1 or each[0] in others[each[0]] for each in parts_of(others))


def _left(flow: Flow, part: frozenset[int]) -> list[int]:
    """Return the instructions of a loop after which it may be over."""
    return [a for a in part if any(to not in part for to in flow.steps[a].next) or flow.steps[a].returns]


def _reader(folder: Folder) -> Any:
    folders = (folder.path, *(folder.linked.folders if folder.linked is not None else ()))

    def read(name: str) -> str:
        for base in folders:
            try:
                return (base / name).read_text(encoding="utf-8", errors="replace")
            except OSError:
                continue
        return ""

    return read


def _sized_names(folder: Folder) -> frozenset[str]:
    """Return the functions of which a comment says that the rounds of a loop depend on their size."""
    sources = (path for path in (folder.path / "src").rglob("*.c"))
    return frozenset(
        n for p in sources for n in SIZE_OF.findall(p.read_text(encoding="utf-8", errors="replace"))
    )


def _decoders(folder: Folder) -> list[str]:
    paths = sorted(Path(folder.path / "src").rglob("*__decode.c"))
    return [path.read_text(encoding="utf-8", errors="replace") for path in paths]


def _headers(folder: Folder) -> list[str]:
    paths = sorted(Path(folder.path / "include").rglob("*.h"))
    return [path.read_text(encoding="utf-8", errors="replace") for path in paths]


def _targets(
    folder: Folder, image: Elf, functions: Mapping[int, Chunk], flows: Mapping[int, Flow], lines: Lines
) -> Mapping[int, frozenset[int]]:
    """Return where the calls through registers go, by their addresses; those that nobody knows are left out."""
    pointers = read_pointers(folder, image, functions)
    calls = [step.address for flow in flows.values() for step in flow.steps.values() if step.through]
    places = source_places(lines, calls)
    found = ((at, reached(folder, place, functions, pointers)) for at, place in places.items())
    return {at: to for at, (member, to) in found if to is not None and member is not None}


def has_automatic(manifest: Mapping[str, Any]) -> bool:
    """Return whether the number of a task is to follow from the image."""
    return any(task.get("lock_auto") for task in _values(manifest).get("tasks", ()))


def target_notes(manifest: Mapping[str, Any]) -> Sequence[Diagnostic]:
    """Return why no image of the target bounds how long a task holds the lock; nothing where images do."""
    return notes_of(_values(manifest))


def _values(manifest: Mapping[str, Any]) -> Mapping[str, Any]:
    found: Mapping[str, Any] = manifest.get("features", {}).get("tasks", {}).get("values", {})
    return found


def task_holds(report: SizeReport, image: Elf, port: int | None) -> tuple[TaskHold, ...]:
    """Return the holds of the tasks of what was built, in its order; none without tasks.

    `port`: instructions of a call of a function of the port that has no bound; None: it stays open.
    """
    tasks = _values(report.folder.manifest).get("tasks", ())
    code = _Image(report, image, port) if tasks else None
    known: dict[str, _Found | None] = {}
    for task in tasks:
        if code is not None and task["entry"] not in known:
            known[task["entry"]] = _holds_of(code, task["entry"])
    return tuple(
        TaskHold(
            task["name"],
            found.holds if found is not None else (),
            bool(task.get("lock_auto")),
            int(task.get("lock_instructions", 0)),
            found is not None,
            found.unseen if found is not None else frozenset(),
        )
        for task in tasks
        for found in (known[task["entry"]],)
    )


def longest_calls(
    report: SizeReport, image: Elf, functions: Iterable[str], port: int | None = None
) -> Mapping[str, Length]:
    """Return the longest path of each of `functions`, called with the lock; those that the image lacks are left out.

    `port`: instructions of a call of the port that has no bound.
    """
    code = _Image(report, image, port)
    holds = Holds(code.flows, code.names, code.rules())
    found = ((name, code.address(name)) for name in functions)
    lengths = ((name, holds.called(address)) for name, address in found if address is not None)
    return {name: length for name, length in lengths if length is not None}


@dataclass(frozen=True)
class _Found:
    """The holds below the entry of a task, and why there may be others."""

    holds: tuple[Hold, ...]
    unseen: frozenset[str]


def _holds_of(code: _Image, entry: str) -> _Found | None:
    start = code.address(entry)
    if start is None:
        return None
    asks = frozenset(a for a in map(code.address, _ASKS_TURN) if a is not None)
    borrows = code.address(_BORROWS)
    if entry != OF_SESSION:
        found = Holds(code.flows, code.names, code.rules(asks))
        holds = _Found(found.below(start), found.unseen(start))
        if borrows is None or borrows not in found.visited:
            return holds
    found = Holds(code.flows, code.names, code.rules())
    return _Found(found.below(start), found.unseen(start))
