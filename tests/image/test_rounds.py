# SPDX-License-Identifier: Apache-2.0
"""Bounds of loops and copies, from C sources."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import pytest

import microros_gen
from microros_gen.image.paths import Length
from microros_gen.image.rounds import Source, Sources

HEADER = """\
#define MICROROS_TASKS 3u /* the last one runs the session */
#define MICROROS_MTU (2u * MICROROS_TASKS + 0x10)
enum { FIRST = 4, SECOND, THIRD = SECOND + 2 };
"""


def of_lines(
    text: str,
    ends: Sequence[int],
    own: Sequence[int] = (),
    inner: Sequence[int] = (),
    function: tuple[str, int | None] = ("work", None),
) -> int | str:
    left, own_places, within = ([("src/part/file.c", line) for line in lines] for lines in (ends, own, inner))
    found = Sources(lambda _: text, [HEADER]).rounds(left, own_places, within, function)
    return found.count if isinstance(found, Length) else found


def rounds(text: str, *lines: int, inner: Sequence[int] = ()) -> int | str:
    return of_lines(text, lines, inner=inner)


@pytest.mark.parametrize(
    ("text", "most"),
    [
        ("for (uint8_t i = 0; i < (uint8_t)MICROROS_TASKS - 1u; ++i) {\n  a[i] = 1;\n}", 2),
        ("for (size_t i = 0U; i < THIRD; i++)\n  a[i] = 1;", 7),
        ("for (i = 0; i < MICROROS_MTU; ++i) {\n  b = (i == 2) ? c : i <= 4;\n}", 22),
        ("while (*at != 0) { /* at most MICROROS_MTU / 4 rounds */\n  ++at;\n}", 5),
        ("/* at most (FIRST + 1) * 2 rounds */\nwhile (*at != 0) {\n  ++at;\n}", 10),
        ("do { /* at most MICROROS_NONE or SECOND rounds */\n  ++at;\n} while (*at != 0);", 5),
    ],
)
def test_a_loop_has_the_bound_that_its_source_says(text: str, most: int) -> None:
    assert rounds(text, text.count("\n") + 1) == most


@pytest.mark.parametrize(
    "text",
    [
        "while (*at != 0) {\n  ++at;\n}",
        "for (i = 0; i < count; ++i) {\n  a[i] = 1;\n}",
        "for (i = 0; i < MICROROS_TASKS; ++i) {\n  i = 0;\n}",
        "for (i = 0; i < MICROROS_TASKS; ++i) {\n  --i;\n}",
        "for (i = 0; i < MICROROS_TASKS; ++i) {\n  change(&i);\n}",
        "for (i = 0; i < MICROROS_TASKS; ++k) {\n  a[i] = 1;\n}",
        "for (;;) {\n  a[i] = 1;\n}",
        "while (*at != 0) { /* at most MICROROS_NONE rounds */\n  ++at;\n}",
        "while (*at != 0) { /* at most 2 - 3 rounds */\n  ++at;\n}",
    ],
)
def test_another_loop_has_none(text: str) -> None:
    assert rounds(text, 2) == "src/part/file.c:1"


def test_of_several_loops_the_largest_counts_and_one_without_a_bound_is_enough() -> None:
    inner = "  for (k = 0; k < 4; ++k) {\n    b();\n  }\n"
    text = f"for (i = 0; i < 9; ++i) {{\n  a();\n{inner}}}\nwhile (c()) {{\n  d();\n}}\n"
    assert (rounds(text, 4), rounds(text, 2), rounds(text, 2, inner=[4])) == (4, 9, 9)
    assert of_lines(text, ends=[2, 4], own=[2], inner=[4]) == 9, "one that has a separate loop in the code"
    assert rounds(text, 2, 8) == "src/part/file.c:7"
    assert rounds("a = 1;", 1) == "no line of a source"


def test_a_copy_that_the_compiler_makes_a_loop_has_no_more_rounds_than_bytes() -> None:
    text = "/* at most 4 * FIRST bytes */\nmemcpy(a, b, 16);\n"
    assert of_lines(text, ends=[2], own=[2]) == 16
    assert of_lines(f"for (;;) {{\n{text}}}\n", ends=[3], own=[3]) == 16, "in a loop of the source"
    assert of_lines(text.replace("FIRST", "NONE"), ends=[2], own=[2]) == "no line of a source"
    assert of_lines(f"{text}b();\n", ends=[2], own=[2, 3]) == "no line of a source", "more than the copy"
    assert of_lines(text, ends=[2], own=[2], inner=[2]) == "no line of a source"
    read = text.replace("4 * FIRST", "BYTES_READ")
    assert of_lines(read, ends=[2], own=[2]) == "no line of a source"


NEST = """\
void work(int * at)
{
  for (i = 0; i < 9; ++i) {
    while (*at != 0) { /* at most 4 rounds */
      ++at;
    }
    b();
  }
}
static void part(void)
{
  while (c()) { /* at most 5 rounds */
    d();
  }
}
"""


def test_where_the_compiler_makes_one_loop_of_two_both_numbers_count() -> None:
    """Each of the 9 rounds of the outer loop also looks a fifth time whether the inner one goes on."""
    assert of_lines(NEST, ends=[3], own=[3, 4, 5, 7]) == 9 * 4 + 9
    assert of_lines(NEST, ends=[3, 5], own=[3, 5]) == 9 * 4 + 9
    assert of_lines(NEST, ends=[3], own=[3, 4, 7], inner=[4]) == 9, (
        "only its first instructions are of the outer loop"
    )
    assert of_lines(NEST, ends=[4], own=[3, 4, 5]) == 4, (
        "an instruction of the outer loop that was moved into the inner one"
    )
    endless = NEST.replace("i = 0; i < 9; ++i", ";;")
    assert of_lines(endless, ends=[4], own=[3, 4, 5]) == "src/part/file.c:3"


def test_the_loop_of_an_inlined_function_may_be_one_with_that_around_it() -> None:
    assert of_lines(NEST, ends=[3], own=[3, 12, 13], inner=[4], function=("work", None)) == 9 * 5 + 9
    assert of_lines(NEST, ends=[3], own=[3, 4, 13], inner=[4, 12], function=("work", None)) == 9
    assert of_lines(NEST, ends=[13], own=[3, 13], function=("work", None)) == 5
    assert of_lines(NEST, ends=[13], own=[3, 13], function=("other", None)) == 9 * 5 + 9, (
        "nobody knows which is around"
    )


@pytest.mark.parametrize(
    "text",
    [
        "for (i = 0; i < 3; ++i) { for (k = 0; k < 9; ++k) {\n  a();\n} }",
        "#define TIMES(n) for (k = 0; k < (n); ++k)\nfor (i = 0; i < 3; ++i) {\n  TIMES(9) a();\n}",
        "void f(void)\n{\n  for (i = 0; i < 3; ++i) {\n  again:\n    if (a()) { goto again; }\n  }\n}",
    ],
    ids=["one line", "macro", "goto"],
)
def test_a_loop_whose_lines_have_another_one_has_no_bound(text: str) -> None:
    begin = text[: text.index("for (i")].count("\n") + 1
    assert rounds(text, begin) == f"src/part/file.c:{begin}"


def test_a_macro_that_repeats_nothing_and_a_jump_forward_leave_the_bound() -> None:
    text = "#define ONCE(x) do { x; } while (0)\nfor (i = 0; i < 3; ++i) {\n  ONCE(a());\n}"
    assert rounds(text, 2) == 3
    forward = "void f(void)\n{\n  for (i = 0; i < 3; ++i) {\n    goto end;\n  }\nend:\n  a();\n}"
    assert rounds(forward, 3) == 3


def test_functions_of_one_code_with_different_comments_have_no_bound() -> None:
    """The compiler keeps one for both, and with it the lines and comments of one."""
    code = (
        "static void {0}(char * {1})\n{{\n  while (*{1}) {{ /* at most {2} rounds */\n    ++{1};\n  }}\n}}\n"
    )
    alike = code.format("a", "x", 3) + code.format("b", "y", 3)
    assert rounds(alike, 3) == 3
    assert rounds(code.format("a", "x", 3) + code.format("b", "y", 9), 3) == "src/part/file.c:3"


def test_constants_are_what_the_compiler_makes_of_them() -> None:
    def bound(defines: str, most: str) -> int | str:
        return rounds(f"{defines}\nfor (i = 0; i < {most}; ++i) {{\n  a();\n}}", 1 + len(defines.split("\n")))

    assert bound("#define LOOSE 2 + 6", "16 - LOOSE") == 16 - 2 + 6
    assert bound("#define OCTAL 010", "20 - OCTAL") == 12
    assert bound("enum { SUM = 2 + 6 };", "16 - SUM") == 8
    several = "#if A\n#define N 80\n#else\n#define N 2\n#endif"
    assert bound(several, "N") == "src/part/file.c:6"


def test_a_comment_names_the_size_of_a_function() -> None:
    text = "while (size != 0) { /* at most 2 * size of put + 1 or 9 rounds */\n  ++at;\n}"
    assert of_lines(text, ends=[2], function=("put", 4)) == 9
    assert of_lines(text, ends=[2], function=("put", 3)) == 7
    assert of_lines(text, ends=[2], function=("put", None)) == 9
    assert of_lines(text, ends=[2], function=("take", 3)) == 9, "it is inlined, and the size another one"


def test_a_comment_says_how_many_bytes_a_call_handles() -> None:
    call = "copy(a, b, size);"
    text = f"{call} /* at most MICROROS_MTU bytes */\n{call}\n/* at most 9 bytes */\n{call}"
    sources = Sources(lambda _: text, [HEADER])
    assert [sources.size(("file.c", line)) for line in (1, 2, 4)] == [22, None, 9]


def test_a_comment_says_in_how_many_rounds_a_call_is_reached() -> None:
    text = "take(a); /* at most 1 + MICROROS_MTU / 12 calls */\ntake(a); /* at most 4 rounds */"
    sources = Sources(lambda _: text, [HEADER])
    assert [sources.calls(("file.c", line)) for line in (1, 2)] == [1 + 22 // 12, None]


def test_a_comment_of_the_outer_loop_does_not_bound_the_inner_one() -> None:
    text = "for (;;) { /* at most 4 rounds */\n  while (*at != 0) {\n    ++at;\n  }\n}"
    assert (rounds(text, 1), rounds(text, 3)) == (4, "src/part/file.c:2")


COMPONENTS = Path(microros_gen.__file__).parent / "components"
WAITS = "port_time_ms() - start <"
"""A loop that ends at a time, and rests in each round."""


COPY = re.compile(r"\bmem(?:cpy|move)\((?:[^;]|\n)*?,\s*(?P<size>[^,;]+)\);")
CONSTANT = re.compile(r"sizeof|^[A-Z_0-9]+u?$|^\(size_t\)[A-Z_]+$")
IN_BYTES = ("loaned_messages", "read", "stream_reliable_input", "transport_canfd")


@pytest.mark.parametrize("component", IN_BYTES)
def test_the_copies_of_what_arrives_have_a_bound(component: str) -> None:
    """A comment at each says how many bytes it has, as without one the task of the session has no bound."""
    found = []
    for path in sorted((COMPONENTS / component / "src").glob("[cx]*.c*")):
        text = path.read_text()
        source = Source(text)
        for match in COPY.finditer(text):
            if not CONSTANT.search(match["size"].strip()):
                found.append((path.name, source.stated(text.count("\n", 0, match.start()) + 1, "bytes")))
    assert found
    assert [name for name, stated in found if stated is None] == []


BOUNDED = (
    *("framing", "peer", "seal", "stream_best_effort", "stream_reliable", "stream_reliable_input"),
    *("transport_canfd", "transport_tcp", "write"),
)


@pytest.mark.parametrize("component", BOUNDED)
def test_the_loops_of_what_sends_and_receives_have_a_bound(component: str) -> None:
    """Without one `lock: auto` would be refused for an application that has the component."""
    declared = "".join(path.read_text() for path in COMPONENTS.glob("*/component.yaml"))
    declared += (COMPONENTS / "base" / "include" / "microros_config.h.j2").read_text()
    defines = "".join(f"#define {name} 8u\n" for name in {*re.findall(r"\bMICROROS_[A-Z0-9_]+", declared)})
    own = sorted((COMPONENTS / component).rglob("*.[ch]"))
    headers = [defines, *(path.read_text() for path in own if path.suffix == ".h")]
    headers += [re.sub("{%.*?%}", "", path.read_text()) for path in (COMPONENTS / component).rglob("*.h.j2")]
    headers.append((COMPONENTS / "tasks" / "include" / "microros" / "xrce_turn_bytes.h").read_text())
    sources = Sources(lambda name: Path(name).read_text(), headers)
    bounds = {
        (path.name, loop.first): sources.rounds([(str(path), loop.first)])
        for path in own
        for loop in Source(path.read_text()).loops
        if WAITS not in loop.head
    }
    assert bounds
    assert [place for place, most in bounds.items() if isinstance(most, str)] == []


@pytest.mark.parametrize(
    "path", ["framing/src/xrce_framing_send.c", "transport_tcp/src/xrce_transport_tcp.c"]
)
def test_what_a_line_sends_is_longer_where_it_is_sealed(path: str) -> None:
    """A record has 32 bytes more than its message; the bound also covers a message of the handshake."""
    source, plain = COMPONENTS / path, "#define MICROROS_MTU 512u\nenum { XRCE_TCP_PREFIX = 2 };\n"
    seal = (COMPONENTS / "seal" / "include" / "microros" / "xrce_messages.h").read_text()

    def most(*headers: str) -> list[int]:
        sources = Sources(lambda name: Path(name).read_text(), headers)
        bounds = (sources.rounds([(str(source), loop.first)]) for loop in Source(source.read_text()).loops)
        return [bound.count for bound in bounds if isinstance(bound, Length) and bound.count > 2]

    assert most(plain)
    for sealed, bound in zip(most(plain, seal), most(plain), strict=True):
        assert bound + 32 <= sealed <= bound + 60
