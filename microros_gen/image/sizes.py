# SPDX-License-Identifier: Apache-2.0
"""The third argument of each call on Arm, which is a size in many: a constant, or that of the calling function itself.

It is in r2 (Procedure Call Standard for the Arm Architecture, 6.4), and may be moved to other registers before.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

Line = tuple[int, str, str]
"""Address, mnemonic and operands of an instruction."""

PASSED = -1
"""It is the third argument of the function itself."""
_SIZE = "r2"
_LOST_BY_CALLS = frozenset({"r0", "r1", "r2", "r3", "ip", "lr"})
_REGISTER = re.compile(r"\b(?:r\d+|sl|fp|ip|lr)\b")
_ONE_RESULT = re.compile(
    r"^(?:mov|movs|movw|mvn|mvns|add|adds|addw|adc|adcs|sub|subs|subw|sbc|sbcs|rsb|rsbs|mul|muls|mla|mls|and|ands|orr|orrs"
    r"|orn|eor|eors|bic|bics|lsl|lsls|lsr|lsrs|asr|asrs|ror|rors|sdiv|udiv|uxtb|uxth|sxtb|sxth|ubfx|sbfx|bfi|bfc|clz|rev"
    r"|rev16|adr|ldr|ldrb|ldrh|ldrsb|ldrsh)$"
)
_NO_RESULT = re.compile(
    r"^(?:cmp|cmn|tst|teq|str|strb|strh|strd|push|nop|b\w{0,2}|cbz|cbnz|it[te]*|stm\w*|tb[bh])$"
)
_CALL = re.compile(r"^bl(?!e$|t$|s$)")
"""A call, also one with a condition; `ble`, `blt` and `bls` are jumps."""
_MOVES_ON = re.compile(r"\[(\w+)[^\]]*\](?:!|, )|^(\w+)!")


def sizes_before(lines: Sequence[Line], following: Mapping[int, Sequence[int]]) -> Mapping[int, int]:
    """Return what r2 is before each instruction: a constant, or PASSED; left out where it may be something else.

    `lines` are the instructions of a function, and `following` has by the address of each those that may be next.
    """
    if not lines:
        return {}
    by_address = {line[0]: line for line in lines}
    known: dict[int, dict[str, int]] = {lines[0][0]: {_SIZE: PASSED}}
    waiting = [lines[0][0]]
    while waiting:
        at = waiting.pop()
        after = _after(known[at], *by_address[at][1:])
        for to in following.get(at, ()):
            if to not in by_address:
                continue
            both = {n: v for n, v in known[to].items() if after.get(n) == v} if to in known else after
            if known.get(to) != both:
                known[to] = both
                waiting.append(to)
    return {at: values[_SIZE] for at, values in known.items() if _SIZE in values}


def _after(values: Mapping[str, int], mnemonic: str, operands: str) -> dict[str, int]:
    """Return what registers are after an instruction."""
    word, plain = mnemonic.split(".")[0], operands.split("@")[0].strip()
    if _CALL.match(word):
        return {name: value for name, value in values.items() if name not in _LOST_BY_CALLS}
    changed = set(_changed(word, plain, _REGISTER.findall(plain)))
    left = {name: value for name, value in values.items() if name not in changed}
    moved = re.fullmatch(r"(\w+), (?:(\w+)|#(\d+))", plain) if word in ("mov", "movs", "movw") else None
    if moved and moved[3]:
        left[moved[1]] = int(moved[3])
    elif moved and moved[2] in values:
        left[moved[1]] = values[moved[2]]
    return left


def _changed(word: str, operands: str, found: Sequence[str]) -> Iterator[str]:
    """Yield the registers that an instruction may change: all that it names, where it is not known."""
    for match in _MOVES_ON.finditer(operands):
        yield match[1] or match[2]
    if _ONE_RESULT.match(word):
        yield from found[:1]
    elif not _NO_RESULT.match(word):
        yield from found
