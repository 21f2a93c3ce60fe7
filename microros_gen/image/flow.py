# SPDX-License-Identifier: Apache-2.0
"""The flow of control inside the functions of a disassembly: which instruction may follow which, and what each calls.

Read are Thumb-2, RISC-V and x86 as GNU objdump writes them (Armv7-M Architecture Reference Manual, A7.7; RISC-V
Unprivileged ISA, 2.5; Intel SDM, volume 2).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

from microros_gen.image.disassembly import functions_of
from microros_gen.image.elf import Elf
from microros_gen.image.sizes import PASSED, Line, sizes_before
from microros_gen.records import dataclass


@dataclass(frozen=True)
class Step:
    """An instruction. `next` may follow it in its function, after what it calls: the function at `call`, or one that a
    register holds (`through`). `returns`: the function may end here, after the call. `lost`: nobody knows what follows.

    `size`: the third argument of the call where it is a constant; `stored`: bytes by which its stores move on; `moved`:
    by which it moves a register on that the function loads from. `tested`: the function whose result a jump tests for
    zero; then `next` has where it goes with zero first. `passes`: the third argument of the call is that of the
    function itself.
    """

    address: int
    next: tuple[int, ...] = ()
    call: int | None = None
    through: bool = False
    returns: bool = False
    lost: bool = False
    size: int | None = None
    stored: int = 0
    moved: int = 0
    tested: int | None = None
    passes: bool = False


@dataclass(frozen=True)
class Flow:
    """The instructions of the function at `address`, which is the first of them.

    `rounds`: of loops with which the compiler copies a constant number of bytes, by the address where they begin.
    """

    name: str
    address: int
    steps: Mapping[int, Step]
    rounds: Mapping[int, int]


_TARGET = re.compile(r"(?:^|[\s,])(?:0x)?([0-9a-f]+) <([^>+]+)(?:\+0x[0-9a-f]+)?>")
_CONDITION = "(?:eq|ne|cs|cc|mi|pl|vs|vc|hi|ls|ge|lt|gt|le|hs|lo)"
_ARM_JUMP = re.compile(rf"^(b{_CONDITION}?|cbn?z)$")
_ARM_RETURN = re.compile(rf"^(?:pop|ldmia|ldm|ldr|bx|mov){_CONDITION}?$")
_ARM_LAST = re.compile(rf"^\w+{_CONDITION}$")
_ARM_STORE = re.compile(r"\], #(\d+)")
_ARM_LOADS = re.compile(r"\[(\w+)")
_ARM_MOVES = re.compile(r"^(\w+), (?:\1, )?#(\d+)\b")
_ARM_WORDS = re.compile(r"^pc, \[(\w+), \w+, lsl #2\]")
_ARM_ADR = re.compile(r"^(?:add\S*|adr\S*) (\w+), pc, .*\(adr \w+, ([0-9a-f]+) ")
_RISCV_JUMP = re.compile(r"^b(?:eq|ne|lt|ge|gt|le)[uz]?z?$")
_X86_JUMP = re.compile(r"^j(?!mp)\w+$")
_LAST_WORDS = ("udf", "ud2", "hlt", "ebreak", "unimp", "bkpt")


def read_flows(text: str, image: Elf) -> Mapping[int, Flow]:
    """Return the functions of the output of `objdump -d --no-show-raw-insn` by address. Other processors: none."""
    read = _READERS.get(image.machine)
    if read is None:
        return {}
    extents = {s.address: s.size for s in image.symbols if s.function and s.size}
    found: dict[int, Flow] = {}
    for name, address, lines in functions_of(text, extents):
        end = address + extents.get(address, lines[-1][0] + 1 - address if lines else 0)
        within = [line for line in lines if address <= line[0] < end]
        places = frozenset(line[0] for line in within)
        steps: dict[int, Step] = {}
        for at, line in enumerate(within):
            after = within[at + 1][0] if at + 1 < len(within) else None
            steps[line[0]] = read(line, after, places, within[max(0, at - 8) : at], image)
        if image.arm:
            sizes = sizes_before(within, {a: step.next for a, step in steps.items()})
            steps.update(
                (a, _sized(steps[a], size)) for a, size in sizes.items() if steps[a].call is not None
            )
            steps.update((a, replace(steps[a], moved=far)) for a, far in _moves(within))
        copies = dict(_copies(within)) if image.arm else {}
        found[address] = Flow(name, address, steps, copies)
    return found


def _sized(step: Step, size: int) -> Step:
    return replace(step, passes=True) if size == PASSED else replace(step, size=size)


def _moves(lines: Sequence[Line]) -> Iterator[tuple[int, int]]:
    """Yield where a function on Arm adds a constant to a register that it loads from."""
    bases = {
        base for _, word, operands in lines if word.startswith("ldr") for base in _ARM_LOADS.findall(operands)
    }
    for address, word, operands in lines:
        match = _ARM_MOVES.match(operands) if word.split(".")[0] in ("add", "adds") else None
        if match and match[1] in bases:
            yield address, int(match[2])


def _follow(after: int | None) -> tuple[int, ...]:
    return () if after is None else (after,)


def _target(operands: str) -> int | None:
    match = _TARGET.search(operands.split("#")[0])
    return int(match[1], 16) if match else None


def _jump(
    address: int,
    operands: str,
    after: int | None,
    places: frozenset[int],
    is_conditional: bool,
    test: tuple[int, bool] | None = None,
) -> Step:
    """Return a jump: inside of the function, or to another one, which returns in its place.

    `test`: the function whose result it tests, and whether it jumps where that is zero.
    """
    to, on = _target(operands), _follow(after) if is_conditional else ()
    if to is None:
        return Step(address, lost=True)
    if to in places:
        if test is not None and on:
            return Step(address, (to, *on) if test[1] else (*on, to), tested=test[0])
        return Step(address, (to, *on))
    return Step(address, on, call=to, returns=True)


def _arm(line: Line, after: int | None, places: frozenset[int], before: Sequence[Line], image: Elf) -> Step:
    address, mnemonic, operands = line
    word, on = mnemonic.split(".")[0], _follow(after)
    if word == "bl":
        return Step(address, on, call=_target(operands))
    if word == "blx":
        return Step(address, on, through=True)
    if _ARM_JUMP.match(word):
        test = _test_of(before, word, operands)
        return _jump(address, operands, after, places, word != "b", test)
    if word in ("tbb", "tbh"):
        return Step(address, _table(address, word == "tbh", image, places))
    words = _ARM_WORDS.match(operands) if word == "ldr" else None
    if words and before and (start := _ARM_ADR.match(" ".join(before[-1][1:]))) and start[1] == words[1]:
        return Step(address, _words(int(start[2], 16), image, places))
    if _ARM_RETURN.match(word) and _loads_pc(word, operands):
        more = on if _ARM_LAST.match(word) else ()
        is_plain = operands.startswith(("lr", "pc, [sp]", "pc, lr")) or "{" in operands
        is_through = not is_plain and word.startswith("bx")
        return Step(address, more, through=is_through, returns=True, lost=not is_plain and not is_through)
    if word in _LAST_WORDS:
        return Step(address)
    stored = _ARM_STORE.search(operands) if word.startswith("str") else None
    return Step(address, on, stored=int(stored[1]) if stored else 0, lost=after is None)


def _loads_pc(word: str, operands: str) -> bool:
    if word.startswith("bx"):
        return True
    return bool(re.search(r"\bpc\}", operands)) if "{" in operands else operands.startswith("pc,")


def _test_of(before: Sequence[Line], word: str, operands: str) -> tuple[int, bool] | None:
    """Return the function whose result (r0) a jump on Arm tests, and whether it jumps where that is zero."""
    is_zero = word in ("cbz", "beq")
    if word in ("cbz", "cbnz") and not operands.startswith("r0,"):
        return None
    if word not in ("cbz", "cbnz", "beq", "bne"):
        return None
    has_compared = word.startswith("cb")
    for _, mnemonic, arguments in reversed(before):
        earlier = mnemonic.split(".")[0]
        if earlier == "bl":
            to = _target(arguments)
            return (to, is_zero) if has_compared and to is not None else None
        if earlier == "cmp" and not has_compared:
            if arguments.strip() != "r0, #0":
                return None
            has_compared = True
        elif arguments.startswith(("r0,", "{")) or earlier.startswith(("b", "cb", "it")) or not has_compared:
            return None
    return None


def _copies(lines: Sequence[Line]) -> Iterator[tuple[int, int]]:
    """Yield the begin and the rounds of loops on Arm without jumps, which end where a register has a fixed distance.

    `add end, at, #32 … L: … adds at, #8 … cmp at, end … bne L`: 32 / 8 rounds.
    """
    places = {line[0]: index for index, line in enumerate(lines)}
    for index, (address, mnemonic, operands) in enumerate(lines):
        to = _target(operands) if mnemonic.split(".")[0] == "bne" else None
        if to is None or to not in places or to >= address:
            continue
        body, before = lines[places[to] : index], lines[max(0, places[to] - 8) : places[to]]
        if any(m.startswith(("b", "cb", "tb", "it")) and not m.startswith("bic") for _, m, _ in body):
            continue
        compared = [o.split(", ") for _, m, o in body if m.split(".")[0] == "cmp"]
        for at, end in ((c[0], c[1]) for c in compared if len(c) == 2):
            steps = [_constant(o, rf"^{at}, (?:{at}, )?#(\d+)") for _, m, o in body if m.startswith("add")]
            ends = [_constant(o, rf"^{end}, {at}, #(\d+)") for _, m, o in before if m.startswith("add")]
            moved = [s for s in steps if s]
            far = [e for e in ends if e]
            if len(moved) == 1 and len(far) == 1 and far[0] % moved[0] == 0:
                yield to, far[0] // moved[0]


def _constant(operands: str, pattern: str) -> int | None:
    match = re.match(pattern, operands)
    return int(match[1]) if match else None


def _table(address: int, is_half: bool, image: Elf, places: frozenset[int]) -> tuple[int, ...]:
    """Return where a branch by a table goes: the table follows it and ends where the first of its targets begins."""
    width = 2 if is_half else 1
    return _entries(address + 4, width, image, places, lambda entry: address + 4 + 2 * entry)


def _words(begin: int, image: Elf, places: frozenset[int]) -> tuple[int, ...]:
    """Return where a load of the program counter from a table of addresses goes, whose last bit says Thumb."""
    return _entries(begin, 4, image, places, lambda entry: entry & ~1)


def _entries(
    begin: int, width: int, image: Elf, places: frozenset[int], place: Callable[[int], int]
) -> tuple[int, ...]:
    found = set[int]()
    section = next((s for s in image.loaded if s.address <= begin < s.end and s.kind != "bss"), None)
    content = image.content(section)[begin - section.address :] if section is not None else b""
    at = 0
    while at + width <= len(content) and (not found or begin + at < min(found)):
        to = place(int.from_bytes(content[at : at + width], "little"))
        if to not in places:
            break
        found.add(to)
        at += width
    return tuple(sorted(found))


def _riscv(line: Line, after: int | None, places: frozenset[int], before: Sequence[Line], image: Elf) -> Step:
    address, word, operands = line
    on = _follow(after)
    if word in ("ret", "mret") or (word == "jr" and operands.strip() in ("ra", "t0")):
        return Step(address, returns=True)
    if word == "jal":
        return Step(address, on, call=_target(operands))
    if word == "jalr":
        return Step(address, on, through=True)
    if word == "jr":
        return Step(address, through=True, returns=True)
    if word == "j" or _RISCV_JUMP.match(word):
        return _jump(address, operands, after, places, word != "j")
    if word in _LAST_WORDS:
        return Step(address)
    return Step(address, on, lost=after is None)


def _x86(line: Line, after: int | None, places: frozenset[int], before: Sequence[Line], image: Elf) -> Step:
    address, word, operands = line
    on = _follow(after)
    if word.startswith("ret") or operands.startswith("ret"):
        return Step(address, returns=True)
    if word.startswith("call"):
        return (
            Step(address, on, through=True) if "*" in operands else Step(address, on, call=_target(operands))
        )
    if word.startswith("jmp"):
        if "*" in operands:
            return Step(address, through=True, returns=True)
        return _jump(address, operands, after, places, is_conditional=False)
    if _X86_JUMP.match(word):
        return _jump(address, operands, after, places, is_conditional=True)
    if word in _LAST_WORDS:
        return Step(address)
    return Step(address, on, lost=after is None or word.startswith("rep"))


_READERS = {"EM_ARM": _arm, "EM_RISCV": _riscv, "EM_X86_64": _x86}
"""By e_machine: what reads an instruction."""
