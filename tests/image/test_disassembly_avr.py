# SPDX-License-Identifier: Apache-2.0
"""Frames and calls of AVR functions, from excerpts of what avr-objdump 2.26 prints."""

from __future__ import annotations

import pytest

from microros_gen.image.disassembly import Code
from microros_gen.image.disassembly_avr import parse_avr


def listing(name: str, address: int, *instructions: str) -> str:
    """Return the lines of a function whose instructions have 2 bytes each."""
    lines = [f"{address:08x} <{name}>:"]
    lines += [f"    {address + 2 * i:x}:\t{text}" for i, text in enumerate(instructions)]
    return "\n".join(lines) + "\n"


def parsed(*instructions: str, wide: bool = False) -> Code:
    text = listing("f", 0x100, *instructions, "ret")
    [code] = parse_avr(text, {0x100: 2 * len(instructions) + 2}, wide)
    return code


SAVES = "jmp\t0x6d6c\t; 0x6d6c <__prologue_saves__+0x4>"
TO_Y = ("in\tr28, 0x3d\t; 61", "in\tr29, 0x3e\t; 62")
FROM_Y = ("in\tr0, 0x3f\t; 63", "cli", "out\t0x3e, r29\t; 62", "out\t0x3f, r0\t; 63", "out\t0x3d, r28\t; 61")
LEAVES = ("adiw\tr28, 0x0e\t; 14", *FROM_Y)


@pytest.mark.parametrize(
    ("instructions", "frame"),
    [
        ((), 0),
        (("push\tr28", "push\tr29", "pop\tr29", "pop\tr28"), 2),
        (("rcall\t.+0      \t; 0x102 <f+0x2>",), 2),
        ((*TO_Y, "sbiw\tr28, 0x0e\t; 14", *FROM_Y, *LEAVES), 14),
        ((*TO_Y, "subi\tr28, 0x50\t; 80", "sbci\tr29, 0x01\t; 1", *FROM_Y), 336),
        ((*TO_Y, "subi\tr28, 0x50\t; 80", "sbc\tr29, r1", *FROM_Y), 80),
        ((*TO_Y, "sbiw\tr28, 0x0e", *FROM_Y, "subi\tr28, 0xF2", "sbci\tr29, 0xFF", *FROM_Y), 14),
        (("ldi\tr26, 0x2C\t; 44", "ldi\tr27, 0x01\t; 1", SAVES), 16 + 300),
        (("sbiw\tr28, 0x01", "ld\tr24, Y"), 0),
        (("in\tr30, 0x3d", "in\tr31, 0x3e", "adiw\tr30, 0x0b", "out\t0x3e, r31", "out\t0x3d, r30"), 0),
    ],
)
def test_what_lowers_the_stack_pointer_is_counted(instructions: tuple[str, ...], frame: int) -> None:
    code = parsed(*instructions)
    assert (code.frame, code.dynamic) == (2 + frame, False)


def test_a_wide_program_counter_has_a_byte_more() -> None:
    assert parsed("push\tr28", wide=True).frame == 4
    assert parsed("rcall\t.+0      \t; 0x102 <f+0x2>", wide=True).frame == 6


def test_a_frame_of_variable_size_is_dynamic() -> None:
    moved = (
        "in\tr24, 0x3d",
        "in\tr25, 0x3e",
        "sub\tr24, r22",
        "sbc\tr25, r23",
        "out\t0x3e, r25",
        "out\t0x3d, r24",
    )
    assert parsed(*moved).dynamic


def test_calls_jumps_and_pointers() -> None:
    code = parsed(
        "call\t0x200\t; 0x200 <g>",
        "rjmp\t.+2      \t; 0x106 <f+0x6>",
        "eicall",
        "jmp\t0x81ac\t; 0x81ac <__tablejump2__>",
        "jmp\t0x8300\t; 0x8300 <__epilogue_restores__+0x4>",
        "jmp\t0x300\t; 0x300 <h>",
    )
    assert code.calls == {0x200, 0x300}
    assert code.pointers == [0x104]
    assert not code.indirect


def test_functions_of_a_library_share_their_ends() -> None:
    """As in avr-libc: a jump to a part pushes nothing, a call to a part does, and a loop is no recursion."""
    text = listing(
        "first",
        0x100,
        "breq\t.+6      \t; 0x108 <second+0x2>",
        "push\tr16",
        "rjmp\t.-6      \t; 0x100 <first>",
    )
    text += listing(
        "second",
        0x106,
        "add\tr24, r24",
        "push\tr17",
        "rcall\t.+6      \t; 0x112 <third+0x2>",
        "brne\t.-14     \t; 0x100 <first>",
        "ret",
    )
    text += listing("third", 0x110, "push\tr18", "ret")
    codes = {code.address: code for code in parse_avr(text, {}, False)}
    assert codes[0x100].frame == codes[0x108].frame == 2 + 1 + 1
    assert codes[0x100].calls == {0x112}
    assert codes[0x110].frame == 2 + 1
    assert codes[0x112].frame == 2
    assert all(0x100 not in code.calls for code in codes.values())
