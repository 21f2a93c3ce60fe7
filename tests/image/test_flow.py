# SPDX-License-Identifier: Apache-2.0
"""Which instruction may follow which, as objdump writes them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import pytest

from microros_gen.image.elf import Elf
from microros_gen.image.flow import Flow, Step, read_flows


def read(
    machine: str, text: str, content: bytes = b"", sizes: tuple[tuple[int, int], ...] = ()
) -> dict[str, Flow]:
    section = SimpleNamespace(address=0, end=len(content), kind="text")
    symbols = [SimpleNamespace(address=a, size=s, function=True) for a, s in sizes]
    image: Any = SimpleNamespace(machine=machine, arm=machine == "EM_ARM", symbols=symbols, loaded=[section])
    image.content = lambda _: content
    return {flow.name: flow for flow in read_flows(text, cast(Elf, image)).values()}


def function(*lines: str, name: str = "work", begin: int = 0x100) -> str:
    return f"{begin:08x} <{name}>:\n" + "".join(f"     {line}\n" for line in lines)


ARM = function(
    "100:\tpush\t{r4, lr}",
    "102:\tmovs\tr2, #14",
    "104:\tbl\t200 <fill>",
    "108:\tcbz\tr0, 110 <work+0x10>",
    "10a:\tblx\tr3",
    "10c:\tbne.n\t100 <work>",
    "10e:\tpopeq\t{r4, pc}",
    "110:\tstrb.w\tr1, [r3], #1",
    "114:\tb.w\t200 <fill>",
) + function("200:\tbx\tlr", name="fill", begin=0x200)


def test_arm() -> None:
    steps = read("EM_ARM", ARM)["work"].steps
    assert steps[0x104] == Step(0x104, (0x108,), call=0x200, size=14)
    assert steps[0x108] == Step(0x108, (0x110, 0x10A), tested=0x200)
    assert steps[0x10A] == Step(0x10A, (0x10C,), through=True)
    assert steps[0x10C] == Step(0x10C, (0x100, 0x10E))
    assert steps[0x10E] == Step(0x10E, (0x110,), returns=True)
    assert steps[0x110] == Step(0x110, (0x114,), stored=1)
    assert steps[0x114] == Step(0x114, call=0x200, returns=True)


@pytest.mark.parametrize(
    ("lines", "tested"),
    [
        (("bl\t200 <fill>", "cmp\tr0, #0", "beq.n\t10c <work+0xc>"), True),
        (("bl\t200 <fill>", "cmp\tr0, #1", "beq.n\t10c <work+0xc>"), False),
        (("bl\t200 <fill>", "ldr\tr0, [r4]", "cbz\tr0, 10c <work+0xc>"), False),
        (("bl\t200 <fill>", "mov\tr5, r0", "cbz\tr0, 10c <work+0xc>"), True),
        (("bl\t200 <fill>", "mov\tr5, r0", "cbz\tr5, 10c <work+0xc>"), False),
        (("bl\t200 <fill>", "cmp\tr4, #0", "beq.n\t10c <work+0xc>"), False),
    ],
)
def test_a_jump_tests_the_result_of_a_call_only_where_nothing_is_between(
    lines: tuple[str, ...], tested: bool
) -> None:
    placed = [f"{0x100 + 4 * at:x}:\t{line}" for at, line in enumerate((*lines, "bx\tlr"))]
    step = read("EM_ARM", function(*placed))["work"].steps[0x108]
    assert (step.tested == 0x200) is tested
    assert step.next == (0x10C, 0x10C)


def test_a_table_of_jumps_ends_where_its_first_target_begins() -> None:
    code = [f"{at:x}:\tnop" for at in range(0x108, 0x114, 2)]
    text = function("100:\ttbb\t[pc, r1]", "104:\t.word\t0x00030402", *code, "114:\tbx\tlr")
    content = bytes(0x104) + bytes([2, 4, 3, 2]) + bytes(0x20)
    assert read("EM_ARM", text, content)["work"].steps[0x100].next == (0x108, 0x10A, 0x10C)


def test_a_copy_of_a_constant_size_has_its_rounds() -> None:
    lines = (
        "add.w\tlr, r3, #16",
        "ldmia\tr2!, {r0, r1}",
        "adds\tr3, #8",
        "cmp\tr3, lr",
        "bne.n\t104 <work+0x4>",
        "bx\tlr",
    )
    text = function(*(f"{0x100 + 4 * at:x}:\t{line}" for at, line in enumerate(lines)))
    assert read("EM_ARM", text)["work"].rounds == {0x104: 2}
    assert read("EM_ARM", text.replace("lr, r3, #16", "lr, r3, r4"))["work"].rounds == {}
    assert read("EM_ARM", text.replace("adds\tr3, #8", "adds\tr3, r8"))["work"].rounds == {}


def test_risc_v() -> None:
    text = function(
        "100:\tjal\t200 <fill>",
        "104:\tbeqz\ta0,100 <work>",
        "108:\tjalr\ta5",
        "10a:\tj\t200 <fill>",
        "10e:\tjr\ta5",
        "110:\tret",
    )
    steps = read("EM_RISCV", text)["work"].steps
    assert steps[0x100] == Step(0x100, (0x104,), call=0x200)
    assert steps[0x104] == Step(0x104, (0x100, 0x108))
    assert steps[0x108] == Step(0x108, (0x10A,), through=True)
    assert steps[0x10A] == Step(0x10A, call=0x200, returns=True)
    assert steps[0x10E] == Step(0x10E, through=True, returns=True)
    assert steps[0x110] == Step(0x110, returns=True)


def test_x86() -> None:
    text = function(
        "100:\tcall   200 <fill>",
        "105:\tjne    100 <work>",
        "107:\tcall   *%rax",
        "109:\tjmp    200 <fill>",
        "10e:\tnotrack jmp *%rdx",
        "111:\trep stos %al,%es:(%rdi)",
        "113:\tret",
        "114:\tud2",
    )
    steps = read("EM_X86_64", text)["work"].steps
    assert steps[0x100] == Step(0x100, (0x105,), call=0x200)
    assert steps[0x105] == Step(0x105, (0x100, 0x107))
    assert steps[0x107] == Step(0x107, (0x109,), through=True)
    assert steps[0x109] == Step(0x109, call=0x200, returns=True)
    assert steps[0x10E] == Step(0x10E, through=True, returns=True)
    assert steps[0x111] == Step(0x111, (0x113,), lost=True), "it repeats as often as a register says"
    assert steps[0x113] == Step(0x113, returns=True)
    assert steps[0x114] == Step(0x114)


def test_the_code_of_other_processors_is_not_read() -> None:
    assert read("EM_AVR", ARM) == {}


CALL, FILL = "bl\t200 <fill>", function("200:\tbx\tlr", name="fill", begin=0x200)


@pytest.mark.parametrize(
    ("lines", "size", "passes"),
    [
        ((CALL,), None, True),
        (("mov\tr4, r2", CALL, "mov\tr2, r4", CALL), None, True),
        (("movs\tr2, #4", *("adds\tr3, #1",) * 12, CALL), 4, False),
        (("mov.w\tr5, #256\t@ 0x100", "mov\tr2, r5", CALL), 256, False),
        ((CALL, CALL), None, False),
        (("add\tr2, r1", CALL), None, False),
        (("ldrd\tr1, r2, [sp]", CALL), None, False),
        (("pop\t{r2, r3}", CALL), None, False),
        (("str\tr1, [r2, #4]", CALL), None, True),
        (("str\tr1, [r2, #4]!", CALL), None, False),
        (("ldrb\tr3, [r2], #1", CALL), None, False),
        (("it\teq", "moveq\tr2, #3", CALL), None, False),
        (("cmp\tr2, #3", CALL), None, True),
        (("umull\tr1, r2, r3, r4", CALL), None, False),
        (("bfi\tr2, r3, #0, #8", CALL), None, False),
        (("bfc\tr2, #4, #2", CALL), None, False),
        (("movs\tr2, #4", "bic.w\tr2, r2, #3", CALL), None, False),
        (("it\teq", "bleq\t200 <fill>", CALL), None, False),
    ],
)
def test_the_third_argument_of_a_call(lines: tuple[str, ...], size: int | None, passes: bool) -> None:
    placed = [f"{0x100 + 4 * at:x}:\t{line}" for at, line in enumerate((*lines, "bx\tlr"))]
    step = read("EM_ARM", function(*placed) + FILL)["work"].steps[0x100 + 4 * (len(lines) - 1)]
    assert (step.size, step.passes) == (size, passes)


def test_the_third_argument_is_unknown_where_two_ways_to_the_call_differ() -> None:
    ways = ("100:\tcbz\tr0, 108 <work+0x8>", "104:\tmovs\tr2, #4", f"108:\t{CALL}", "10c:\tbx\tlr")
    step = read("EM_ARM", function(*ways) + FILL)["work"].steps[0x108]
    assert (step.size, step.passes) == (None, False)
    same = ("100:\tmovs\tr2, #4", *(f"{int(w[:3], 16) + 4:x}{w[3:]}" for w in ways))
    step = read("EM_ARM", function(*same).replace("108 <work+0x8>", "10c <work+0xc>") + FILL)["work"].steps[
        0x10C
    ]
    assert step.size == 4


def test_what_a_function_loads_from_moves_on_by_a_constant() -> None:
    lines = ("ldrd\tr2, r3, [r1, #8]", "add.w\tr0, r0, #8", "add.w\tr1, r1, #32", "adds\tr1, #4", "bx\tlr")
    text = function(*(f"{0x100 + 4 * at:x}:\t{line}" for at, line in enumerate(lines)))
    steps = read("EM_ARM", text)["work"].steps
    assert [step.moved for step in steps.values()] == [0, 0, 32, 4, 0], "nothing is loaded from r0"
