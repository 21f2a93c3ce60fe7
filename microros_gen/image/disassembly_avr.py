# SPDX-License-Identifier: Apache-2.0
"""What `objdump -d` shows of each function of an AVR (AVR Instruction Set Manual; avr-gcc's ABI).

The frame is the return address, everything that is pushed, and what is subtracted from the stack pointer, which is
the pair of I/O registers 0x3e and 0x3d. With -mcall-prologues, `__prologue_saves__` of libgcc pushes and subtracts.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from microros_gen.image.disassembly import Code
from microros_gen.records import dataclass

RETURN_ADDRESS = {True: 3, False: 2}
"""Bytes that a call pushes, by whether the program counter has 22 bits (more than 128 KiB of flash)."""

_HEAD = re.compile(r"^([0-9a-f]+) <(.+)>:$")
_LINE = re.compile(r"^\s*([0-9a-f]+):\t(\w+)\s*([^;]*)(?:;.*)?$")
_TARGET = re.compile(r"; 0x([0-9a-f]+) <([^>+]+)(?:\+0x([0-9a-f]+))?>")
_ENDS = ("ret", "reti", "jmp", "rjmp", "ijmp", "eijmp")
_INDIRECT = ("icall", "eicall", "ijmp", "eijmp")
_SAVES, _RESTORES, _SWITCH = "__prologue_saves__", "__epilogue_restores__", "__tablejump2__"
_ZERO = "r1"
"""The register that is always 0 between statements."""
_SAVED = 18
"""Registers that __prologue_saves__ pushes from its beginning, with instructions of 2 bytes: r2 to r17, r28, r29."""


@dataclass(frozen=True)
class _Instruction:
    address: int
    mnemonic: str
    operands: tuple[str, ...]
    target: int | None
    label: str
    offset: int


def parse_avr(text: str, extents: Mapping[int, int], wide: bool) -> tuple[Code, ...]:
    """Return every function of the output of `objdump -d --no-show-raw-insn`, in its order.

    `extents` are the sizes of functions by address. What has none, assembly of libraries, is taken apart at each
    address that something goes to, as such functions share their ends. `wide`: the program counter has 22 bits.
    """
    word = RETURN_ADDRESS[wide]
    found = []
    for name, lines, after in _functions(text, extents):
        found.append(_function(name, lines, word))
        if lines[0].address not in extents and lines[-1].mnemonic not in _ENDS:
            found[-1][2].add(after)
    ends = {code.address: end for code, end, _ in found}
    jumps: dict[int, set[int]] = {}
    for code, _, to in found:
        code.calls = {_containing(address, ends) for address in code.calls}
        jumps[code.address] = {_containing(address, ends) for address in to}
        if code.address in extents:
            code.calls |= jumps.pop(code.address)
    _join(tuple(code for code, _, _ in found), jumps, word)
    return tuple(code for code, _, _ in found)


def _join(codes: tuple[Code, ...], jumps: Mapping[int, set[int]], word: int) -> None:
    """Give each part of a library's function what the parts that it can jump to push and call."""
    by_address = {code.address: code for code in codes}
    frames = {code.address: code.frame - word for code in codes}
    calls = {code.address: frozenset(code.calls) for code in codes}
    for begin in jumps:
        code, reached, waiting = by_address[begin], {begin}, [begin]
        while waiting:
            for to in jumps.get(waiting.pop(), set()) - reached:
                if to in jumps:
                    reached.add(to)
                    waiting.append(to)
                else:
                    code.calls.add(to)
        for other in reached - {begin}:
            code.frame += frames[other]
            code.calls |= calls[other]
            code.indirect |= by_address[other].indirect
            code.dynamic |= by_address[other].dynamic


def _containing(address: int, ends: Mapping[int, int]) -> int:
    """Return the function that an address is in: labels of libraries are called, too."""
    if address in ends:
        return address
    return next((start for start, end in ends.items() if start < address <= end), address)


def _functions(text: str, extents: Mapping[int, int]) -> Iterator[tuple[str, list[_Instruction], int]]:
    """Yield each function, or part of a library's, and the address after it."""
    name, lines = "", list[_Instruction]()
    targets = {int(match[1], 16) for match in _TARGET.finditer(text)}
    for line in text.splitlines():
        head, match = _HEAD.match(line), _LINE.match(line)
        found = head or match
        if found is None:
            continue
        address = int(found[1], 16)
        begin = lines[0].address if lines else address
        is_within = address < begin + extents.get(begin, 0)
        is_part = address in targets or (bool(lines) and lines[-1].mnemonic in _ENDS)
        if lines and not is_within and (head or is_part):
            yield name, lines, address
            lines = []
        if head and not lines:
            name = head[2]
        if match:
            lines.append(_instruction(line, match))
    if lines:
        yield name, lines, 0


def _instruction(line: str, match: re.Match[str]) -> _Instruction:
    target = _TARGET.search(line)
    return _Instruction(
        address=int(match[1], 16),
        mnemonic=match[2],
        operands=tuple(part.strip() for part in match[3].split(",")),
        target=int(target[1], 16) if target else None,
        label=target[2] if target else "",
        offset=int(target[3] or "0", 16) if target else 0,
    )


def _function(name: str, lines: list[_Instruction], word: int) -> tuple[Code, int, set[int]]:
    """Return a function, its last address, and where it jumps."""
    begin, end = lines[0].address, lines[-1].address
    code = Code(name, begin, word)
    frame, jumps = _Frame(), set[int]()
    for instruction in lines:
        frame.see(instruction, word)
        if instruction.mnemonic in _INDIRECT:
            code.pointers.append(instruction.address)
        elif instruction.label == _SWITCH and instruction.mnemonic in ("call", "rcall"):
            code.indirect = True
        elif _leaves(instruction, begin, end):
            calls = code.calls if instruction.mnemonic in ("call", "rcall") else jumps
            calls.add(int(instruction.target or 0))
    code.frame += frame.bytes
    code.dynamic = frame.is_dynamic
    return code, end, jumps


def _leaves(instruction: _Instruction, begin: int, end: int) -> bool:
    """Return whether it calls or jumps to another function. A `switch` jumps back by a table."""
    if instruction.target is None or instruction.label in (_SAVES, _RESTORES, _SWITCH):
        return False
    if instruction.mnemonic not in ("call", "rcall", "jmp", "rjmp") and not instruction.mnemonic.startswith(
        "br"
    ):
        return False
    is_call = instruction.mnemonic in ("call", "rcall") and not _reserves(instruction)
    return not begin <= instruction.target <= end or (is_call and instruction.target == begin)


def _reserves(instruction: _Instruction) -> bool:
    """Return whether it is a call of the next instruction, which the compiler uses to move the stack pointer."""
    return instruction.mnemonic == "rcall" and instruction.operands[0] == ".+0"


class _Frame:
    """Adds up by how much the instructions of one function lower the stack pointer, in their order."""

    def __init__(self) -> None:
        self.bytes = 0
        self.is_dynamic = False
        self._loaded: dict[str, int] = {}
        self._copies: dict[str, int | None] = {}
        """How far a copy of the stack pointer was lowered, by its low register; None: nobody can say."""

    def see(self, instruction: _Instruction, word: int) -> None:
        """Take the next instruction; a call pushes `word` bytes."""
        mnemonic, operands = instruction.mnemonic, instruction.operands
        if mnemonic == "push":
            self.bytes += 1
        elif _reserves(instruction):
            self.bytes += word
        elif instruction.label == _SAVES:
            self.bytes += _SAVED - instruction.offset // 2
            self.bytes += self._loaded.get("r26", 0) | self._loaded.get("r27", 0) << 8
        elif mnemonic == "ldi":
            self._loaded[operands[0]] = int(operands[1], 16)
        elif mnemonic == "in" and operands[1] == "0x3d":
            self._copies[operands[0]] = 0
        elif mnemonic == "out" and operands[0] == "0x3d":
            self._moved(operands[1])
        else:
            self._changed(mnemonic, operands)

    def _moved(self, register: str) -> None:
        lowered = self._copies.pop(register, 0 if register == "r28" else None)
        if lowered is None:
            self.is_dynamic = True
        else:
            self.bytes += max(lowered, 0)

    def _changed(self, mnemonic: str, operands: tuple[str, ...]) -> None:
        low = operands[0]
        high = f"r{int(low[1:]) - 1}" if re.fullmatch(r"r[0-9]+", low) else ""
        if mnemonic in ("sbiw", "subi") and low in self._copies:
            self._lower(low, int(operands[1], 16))
        elif mnemonic == "sbci" and high in self._copies:
            value = int(operands[1], 16) << 8
            self._lower(high, value - 0x10000 if value & 0x8000 else value)
        elif mnemonic == "adiw" and low in self._copies:
            self._lower(low, -int(operands[1], 16))
        elif (
            mnemonic in ("sub", "sbc", "add", "adc", "mov", "movw", "ldd", "ld", "pop")
            and operands[-1] != _ZERO
        ):
            for register in (low, high):
                if register in self._copies:
                    self._copies[register] = None

    def _lower(self, register: str, by: int) -> None:
        lowered = self._copies[register]
        self._copies[register] = None if lowered is None else lowered + by
