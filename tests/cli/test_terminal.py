# SPDX-License-Identifier: Apache-2.0
"""What a terminal shows besides the text: colors, progress and the next step; without one the text is plain."""

from __future__ import annotations

import io
import re
import shlex
from pathlib import Path

import pytest

from microros_gen.cli.terminal import Progress, colored_diagnostics, wants_color
from tests.support.command_line import Runner
from tests.support.pseudo_terminal import at_terminal

ESCAPE = "\x1b"
_CONTROL = re.compile(r"\x1b\[[0-9;]*[mK]")


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(
    ("environ", "terminal", "pipe"),
    [
        ({}, True, False),
        ({"TERM": "dumb"}, False, False),
        ({"NO_COLOR": "1"}, False, False),
        ({"NO_COLOR": ""}, True, False),
        ({"FORCE_COLOR": "1"}, True, True),
        ({"FORCE_COLOR": "0"}, True, False),
        ({"CLICOLOR_FORCE": "1"}, True, True),
        ({"CLICOLOR": "0"}, False, False),
        ({"CLICOLOR": "0", "CLICOLOR_FORCE": "1"}, True, True),
        ({"NO_COLOR": "1", "FORCE_COLOR": "1"}, False, False),
        ({"CLICOLOR": "1"}, True, False),
    ],
)
def test_when_there_are_colors(environ: dict[str, str], terminal: bool, pipe: bool) -> None:
    assert wants_color(Terminal(), environ) is terminal
    assert wants_color(io.StringIO(), environ) is pipe


def test_colors_change_no_character() -> None:
    text = (
        "a.yaml:3:1: error: unknown key 'x'. Did you mean 'y'? [MG-1002]\n"
        "  x: ': error: '\n"
        "  ^\n"
        "microros-gen: warning: something else [MG-1003]\n"
        "nodes:\n"
    )
    colored = colored_diagnostics(text)
    assert _CONTROL.sub("", colored) == text
    assert f"{ESCAPE}[31m{ESCAPE}[1merror{ESCAPE}[0m" in colored
    assert f"{ESCAPE}[33m{ESCAPE}[1mwarning{ESCAPE}[0m" in colored
    assert colored.splitlines()[1] == "  x: ': error: '", "the user's own line stays as it is"
    assert colored.splitlines()[2] == f"  {ESCAPE}[32m^{ESCAPE}[0m"


def test_a_mistake_at_a_terminal_has_the_text_of_a_pipe(folder: Path, run: Runner) -> None:
    (folder / "microros.yaml").write_text("version: 1\nprofils: [pure_sender]\n")
    piped = run("resolve").err
    assert ESCAPE not in piped
    shown = at_terminal(["resolve"], folder)
    assert shown.status == 2
    assert ESCAPE in shown.text
    assert _CONTROL.sub("", shown.text) == piped
    assert at_terminal(["resolve"], folder, NO_COLOR="1").text == piped
    assert ESCAPE in at_terminal(["resolve"], folder, pipe_stdout=True).text, "stderr is the terminal"


def test_color_can_be_forced_into_a_pipe(folder: Path, run: Runner, monkeypatch: pytest.MonkeyPatch) -> None:
    plain = run("resolve", "--profile", "nope").err
    monkeypatch.setenv("FORCE_COLOR", "1")
    forced = run("resolve", "--profile", "nope").err
    assert ESCAPE in forced
    assert _CONTROL.sub("", forced) == plain


def test_the_step_after_generate(folder: Path, run: Runner) -> None:
    """It is shown also when nothing changed since the last run, and repeats the options, quoted for a shell."""
    arguments = ["--profile", "pure_sender", "--component", "+timers", "-o", "an output"]
    expected = "next       microros-gen build --profile pure_sender --component +timers --output 'an output'"
    for _ in range(2):
        shown = at_terminal(["generate", *arguments, "--depfile", "d"], folder)
        assert _CONTROL.sub("", shown.text).splitlines()[-1] == expected
    assert "next" not in at_terminal(["generate", *arguments], folder, pipe_stdout=True).piped
    assert run("resolve", *shlex.split(expected)[3:-2]).status == 0, "the options are those of a selection"


@pytest.mark.builds
def test_building_shows_progress_and_the_next_step(folder: Path) -> None:
    arguments = ["build", "--component", "cdr", "-o", "out"]
    shown = at_terminal(arguments, folder, MICROROS_GEN_OBJECTS="off")
    assert shown.status == 0, shown.text
    frames = re.findall(r"\r\x1b\[Kcompiling (\d+) of (\d+): (\S+)", shown.text)
    total = len(frames)
    assert [(int(done), int(of)) for done, of, _ in frames] == [(n, total) for n in range(1, total + 1)]
    assert f"compiled   {total} objects" in _CONTROL.sub("", shown.text)
    _, after = shown.text.rsplit("\r\x1b[K", 1)
    assert "compiling" not in after, "the line is removed before the summary goes on"
    last = _CONTROL.sub("", shown.text).splitlines()[-1]
    assert last in ("next       microros-gen size out", "next       microros-gen run out")
    assert last.split()[2] == ("run" if list((folder / "out/bin").glob("*")) else "size")
    again = at_terminal(arguments, folder)
    assert "compiling" not in again.text, "nothing had to be compiled"
    assert at_terminal(last.split()[1:], folder).status == 0 or "run" in last


@pytest.mark.parametrize("variables", [{"CI": "true"}, {"TERM": "dumb"}])
def test_no_progress_in_ci_and_on_a_dumb_terminal(variables: dict[str, str]) -> None:
    stream = Terminal()
    with Progress(stream, variables) as progress:
        progress(1, 2, "a.c")
    assert stream.getvalue() == ""


def test_progress_fits_into_the_line_and_goes_when_compiling_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "30")
    stream = Terminal()

    def fail() -> None:
        with Progress(stream, {}) as progress:
            progress(1, 12, "src/a_component_with_a_long_name/file.c")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    first, last = stream.getvalue().split("\r\x1b[K")[1:]
    assert len(first) == 29
    assert first.startswith("compiling 1 of 12: src/")
    assert last == ""
