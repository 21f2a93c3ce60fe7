# SPDX-License-Identifier: Apache-2.0
"""What `objdump -d` shows of each function: whom it calls, and how far it moves the stack pointer.

The frame is the sum of everything that a function pushes or subtracts, wherever it does: never less than what it
needs, as long as no loop pushes. What moves the stack pointer by a register is called dynamic.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field


@dataclass
class Code:
    """A function of the image. `calls` are addresses; `indirect`: it calls or jumps through a register.

    `pointers`: addresses of such calls, where each is to be looked at.
    """

    name: str
    address: int
    frame: int
    calls: set[int] = field(default_factory=set)
    indirect: bool = False
    dynamic: bool = False
    pointers: list[int] = field(default_factory=list)


_HEAD = re.compile(r"^([0-9a-f]+) <(.+)>:$")
_LINE = re.compile(r"^\s*([0-9a-f]+):\t([\w.]+(?: [a-z]\w*)?)\s*(.*)$")
_TARGET = re.compile(r"(?:^|[\s,])(?:0x)?([0-9a-f]+) <([^>+]+)(?:\+0x[0-9a-f]+)?>")
_BRANCH = re.compile(
    r"^(b|bl|blx|b(eq|ne|cs|cc|mi|pl|vs|vc|hi|ls|ge|lt|gt|le|hs|lo|al)|cbn?z|b(ltu|geu|\w*z)|call|tail|j\w*)"
    r"(\.[nw])?[lq]?$"
)
_CALL = re.compile(r"^(bl|blx|callq?|jal)$")


def parse_disassembly(text: str, machine: str, extents: Mapping[int, int]) -> tuple[Code, ...]:
    """Return every function of the output of `objdump -d --no-show-raw-insn`, in its order.

    `extents` are the sizes of functions by address: a label inside of one does not start another function.
    """
    found = functions_of(text, extents)
    return tuple(_function(name, address, lines, machine) for name, address, lines in found)


def functions_of(
    text: str, extents: Mapping[int, int]
) -> Iterator[tuple[str, int, list[tuple[int, str, str]]]]:
    """Yield name, address and instructions of each function (address, mnemonic, operands), as parse_disassembly."""
    name, address, lines = "", 0, list[tuple[int, str, str]]()
    for line in text.splitlines():
        head = _HEAD.match(line)
        if head and name and int(head[1], 16) < address + extents.get(address, 0):
            continue
        if head:
            if name:
                yield name, address, lines
            name, address, lines = head[2], int(head[1], 16), []
            continue
        match = _LINE.match(line)
        if match:
            mnemonic = match[2].removeprefix("notrack ").removeprefix("bnd ")
            first, _, more = mnemonic.partition(" ")
            lines.append((int(match[1], 16), first, f"{more} {match[3]}".strip()))
    if name:
        yield name, address, lines


def _function(name: str, address: int, lines: Iterable[tuple[int, str, str]], machine: str) -> Code:
    lines = list(lines)
    end = lines[-1][0] if lines else address
    frame = {"EM_X86_64": 8, "EM_386": 4}.get(machine, 0)
    code = Code(name, address, frame)
    for _, mnemonic, operands in lines:
        moved = _moved(mnemonic, operands, machine)
        if moved is None:
            code.dynamic = True
        else:
            code.frame += moved
        if not _BRANCH.match(mnemonic):
            code.indirect |= _jumps_by_load(mnemonic, operands)
            continue
        target = _TARGET.search(operands.split("#")[0])
        if target:
            to = int(target[1], 16)
            if not address <= to <= end or (to == address and _CALL.match(mnemonic)):
                code.calls.add(to)
        else:
            code.indirect |= _is_indirect(mnemonic, operands)
    return code


def _is_indirect(mnemonic: str, operands: str) -> bool:
    if mnemonic.startswith(("call", "jmp")):
        return "*" in operands
    if mnemonic == "jr":
        return operands.strip() != "ra"
    return mnemonic in ("blx", "jalr")


def _jumps_by_load(mnemonic: str, operands: str) -> bool:
    return (
        mnemonic in ("bx", "mov")
        and operands.startswith(("pc,", "r", "ip"))
        and (mnemonic == "bx" or (operands.startswith("pc,") and "lr" not in operands))
    )


def _moved(mnemonic: str, operands: str, machine: str) -> int | None:
    """Return by how many bytes an instruction lowers the stack pointer; None: nobody can say."""
    if machine == "EM_ARM":
        return _moved_arm(mnemonic.split(".")[0], operands)
    if machine in ("EM_X86_64", "EM_386"):
        return _moved_x86(mnemonic, operands, 8 if machine == "EM_X86_64" else 4)
    if machine == "EM_RISCV":
        match = re.match(r"sp,sp,-(\d+)", operands)
        return int(match[1]) if mnemonic.endswith(("add", "addi", "addi16sp")) and match else 0
    return None


def _moved_arm(mnemonic: str, operands: str) -> int | None:
    if mnemonic in ("push", "vpush") or (mnemonic in ("stmdb", "vstmdb") and operands.startswith("sp!")):
        return _registers(operands[operands.index("{") :])
    match = re.search(r"\[sp, #-(\d+)\]!", operands)
    if match:
        return int(match[1])
    if mnemonic in ("sub", "subw", "subs") and operands.startswith("sp,"):
        match = re.match(r"sp, (?:sp, )?#(\d+)", operands)
        return int(match[1]) if match else None
    return 0


def _registers(text: str) -> int:
    """Return the bytes of a register list: `{r4, r6-r8, lr}`, `{d8-d15}`."""
    total = 0
    for part in text.strip("{} ").split(","):
        match = re.match(r"\s*([a-z])(\d+)-[a-z](\d+)", part)
        count = int(match[3]) - int(match[2]) + 1 if match else 1
        total += count * (8 if part.strip().startswith("d") else 4)
    return total


def _moved_x86(mnemonic: str, operands: str, word: int) -> int | None:
    stack = "%rsp" if word == 8 else "%esp"
    if mnemonic.startswith("push"):
        return word
    match = re.match(rf"\$0x([0-9a-f]+),{stack}$", operands)
    if mnemonic.startswith("sub") and operands.endswith(f",{stack}"):
        return int(match[1], 16) if match else None
    if mnemonic.startswith("and") and match:
        return int(-int(match[1], 16) & 0xFFF)
    match = re.match(rf"-0x([0-9a-f]+)\({stack}\),{stack}$", operands)
    return int(match[1], 16) if mnemonic.startswith("lea") and match else 0
