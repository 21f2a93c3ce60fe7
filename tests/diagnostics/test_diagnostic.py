# SPDX-License-Identifier: Apache-2.0
"""Diagnostics: their printed form, what a collector keeps, and when it raises."""

from __future__ import annotations

import pytest

from microros_gen.diagnostics import (
    Diagnostic,
    Diagnostics,
    Severity,
    Source,
    Span,
    UserError,
    nearest,
    nearest_package,
    reads,
)
from microros_gen.diagnostics.diagnostic import LONGEST_LINE, LONGEST_WORD

FILE = Source("microros.yaml", "version: 1\nnodes:\n\t- nam: x\r\n")


def test_a_place_is_shown_with_its_line_and_a_caret() -> None:
    found = Diagnostic("unknown key 'nodes'", Span(FILE, 2, 1, 6), "Remove it")
    assert found.render() == "microros.yaml:2:1: error: unknown key 'nodes'. Remove it\n  nodes:\n  ^~~~~"


def test_a_tab_before_the_place_stays_a_tab() -> None:
    line, caret = Diagnostic("wrong", Span(FILE, 3, 4)).render().splitlines()[1:]
    assert line == "  \t- nam: x"
    assert caret == "  \t  ^"


def test_a_warning_without_a_place() -> None:
    assert Diagnostic("old", severity=Severity.WARNING).render() == "microros-gen: warning: old"


@pytest.mark.parametrize("line", [0, 4, 99])
def test_a_place_beyond_the_text_shows_no_line(line: int) -> None:
    assert Diagnostic("wrong", Span(FILE, line, 1)).render() == f"microros.yaml:{line}:1: error: wrong"


def test_the_block_follows_the_place() -> None:
    assert Diagnostic("m", Span(FILE, 1, 1), block=("a: 1", "b: 2")).render().splitlines()[-2:] == [
        "a: 1",
        "b: 2",
    ]


@pytest.mark.parametrize("column", [1, 500, 1000])
def test_of_a_long_line_the_part_around_the_place_is_shown(column: int) -> None:
    text = "".join(chr(ord("a") + i % 26) for i in range(1000))
    shown, caret = Diagnostic("m", Span(Source("f", text), 1, column)).render().splitlines()[1:]
    assert len(shown) <= 2 + LONGEST_LINE + 2
    assert shown[caret.index("^")] == text[column - 1]


def test_a_long_word_is_cut() -> None:
    text = Diagnostic(f"unknown type '{'x' * 5000}'").headline()
    assert len(text) < LONGEST_WORD + 100
    assert text.endswith("…")


def test_a_collector_keeps_each_diagnostic_once_and_raises_at_the_end() -> None:
    diagnostics = Diagnostics()
    diagnostics.warning("w", id="MG-0001")
    diagnostics.check()
    diagnostics.error("e", Span(FILE, 1, 1), id="MG-0002")
    diagnostics.error("e", Span(FILE, 1, 1), id="MG-0002")
    with pytest.raises(UserError) as raised:
        diagnostics.check()
    assert [d.message for d in raised.value.diagnostics] == ["w", "e"]
    assert raised.value.status == 2
    assert str(raised.value) == "microros-gen: warning: w [MG-0001]\nmicroros.yaml:1:1: error: e [MG-0002]"


@pytest.mark.parametrize(
    ("name", "hint"), [("Nodes", "Did you mean 'nodes'?"), ("nods", "Did you mean 'nodes'?"), ("qqq", None)]
)
def test_the_nearest_name(name: str, hint: str | None) -> None:
    assert nearest(name, ["limits", "nodes", "pools"]) == hint


@pytest.mark.parametrize("name", ["std_mgs", "stdmsgs", "Std_msgs", "std_msg", "std_mesages"])
def test_the_nearest_package(name: str) -> None:
    known = ["action_msgs", "example_interfaces", "sensor_msgs", "std_msgs", "std_srvs"]
    assert nearest_package(name, known) == "Did you mean 'std_msgs'?"


@pytest.mark.parametrize("name", ["pico_msgs", "motor_interfaces", "msgs", "mesgs", "my_actions"])
def test_packages_are_not_alike_by_their_endings(name: str) -> None:
    assert nearest_package(name, ["action_msgs", "example_interfaces", "std_msgs", "std_srvs"]) is None


def test_what_a_reader_raises_by_mistake_names_its_text() -> None:
    @reads
    def broken(source: Source) -> None:
        raise KeyError(source.text[:7])

    @reads
    def endless(source: Source) -> None:
        endless(source)

    with pytest.raises(UserError, match=r"microros\.yaml:1:1: error: internal error: KeyError: 'version'"):
        broken(FILE)
    with pytest.raises(UserError, match="nested too deeply"):
        endless(FILE)
