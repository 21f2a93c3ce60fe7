# SPDX-License-Identifier: Apache-2.0
"""Eva of Frama-C over a slice of the proof, and over wrong code (docs/verification/proof.md)."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest

from tests.proof import proofs, report
from tests.proof.proofs import Proof, Tree
from tests.support.paths import ROOT

needs_frama_c = pytest.mark.skipif(not proofs.is_installed(), reason="no frama-c (Debian: frama-c-base)")
QUICK = ("frame_byte", "encode")
"""Proofs of which `make test` has a run; `make system` has one of each."""
SLOW = ("fragments", "frame_line", "handlers", "sequence")
"""Proofs that CI leaves to `make system`: the others go over the same kinds of code in less time."""


def _marks_of(proof: Proof) -> list[pytest.MarkDecorator]:
    if proof.name in QUICK:
        return []
    return [pytest.mark.system, *([pytest.mark.variant] if proof.name in SLOW else [])]


SLICE = [
    pytest.param(proof, number, id=f"{proof.name}-{number}", marks=_marks_of(proof))
    for proof in proofs.load()
    for number in proof.slice
]
HOST = "gcc_x86_64"


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("proof")


@needs_frama_c
@pytest.mark.parametrize(("proof", "number"), SLICE)
def test_slice(proof: Proof, number: int, place: Path) -> None:
    run = proofs.run(proof, proofs.tree(proof.application, place), HOST, number, place)
    assert report.problems(run) == []


def test_each_proof_has_a_run_in_the_suite() -> None:
    """A driver that no longer fits the code is seen in the change that causes it."""
    assert [proof.name for proof in proofs.load() if not proof.slice] == []


@needs_frama_c
@pytest.mark.long
def test_everything(place: Path) -> None:
    each = [
        proofs.run(proof, proofs.tree(proof.application, place), machdep, number, place)
        for proof in proofs.load()
        for machdep, number in proofs.runs(proof)
    ]
    assert [text for run in each for text in report.problems(run)] == []
    assert report.unexplained(each) == []


def _done(text: str, code: int = 0) -> subprocess.CompletedProcess[str]:
    return subprocess.CompletedProcess([], code, text, "")


MUTATIONS = {
    "bytes that are left": (
        "decode",
        "src/cdr_decode/cdr_decode.c",
        "if (bytes > left) {",
        "if (bytes > (uint64_t)left + 1U) {",
    ),
    "length of a string": (
        "decode",
        "src/cdr_decode/cdr_decode_text.c",
        "if (size > limit) {",
        "if (size > limit + 2U) {",
    ),
    "piece of a sample": (
        "fragments",
        "src/stream_reliable_input/xrce_fragments.c",
        "size > (size_t)fragments->sample.size - fragments->arrived",
        "size > (size_t)fragments->sample.size + 1u - fragments->arrived",
    ),
    "size of a frame": (
        "frame_byte",
        "src/framing/xrce_framing.c",
        "framing->size - 1u < capacity",
        "framing->size - 1u <= capacity",
    ),
    "limit of a string": (
        "encode",
        "src/std_msgs/string__type_support.c",
        "message->data.size, 4U,",
        "message->data.size, 5U,",
    ),
}

_MARKS: Mapping[str, list[pytest.MarkDecorator]] = {
    "size of a frame": [],
    "piece of a sample": [pytest.mark.system, pytest.mark.variant],
}


@needs_frama_c
@pytest.mark.parametrize(
    ("name", "file", "right", "wrong"),
    [
        pytest.param(*values, id=key, marks=_MARKS.get(key, [pytest.mark.long]))
        for key, values in MUTATIONS.items()
    ],
)
def test_a_wrong_check_is_an_alarm(name: str, file: str, right: str, wrong: str, tmp_path: Path) -> None:
    """One check of a copy is off by one or two: the same run that finds nothing finds that."""
    proof = next(proof for proof in proofs.load() if proof.name == name)
    source_tree = proofs.tree(proof.application, tmp_path)
    source = source_tree.folder / file
    text = source.read_text(encoding="utf-8")
    assert right in text
    source.write_text(text.replace(right, wrong), encoding="utf-8")
    run = proofs.run(proof, Tree(source_tree.folder, source_tree.types), HOST, 0, tmp_path)
    assert run.alarms


def test_a_run_that_stops_is_no_proof() -> None:
    """What frama-c prints is read: an alarm, what was reached, and an analysis that did not come to its end."""
    proof = proofs.load()[0]
    text = (
        "[eva] done for function main\n[eva:alarm] src/a.c:7: Warning: \n  out of bounds read.\n[metrics] \n"
        "  main: 3 stmts out of 4 (75.0%)\n"
    )
    run = proofs.read(proof, HOST, {}, 1.0, _done(text))
    assert (run.failure, run.reached) == ("", {"main": (3, 4)})
    assert [(a.file, a.line, a.text) for a in run.alarms] == [("src/a.c", 7, "out of bounds read.")]
    assert report.problems(run) == ["frame_byte gcc_x86_64: src/a.c:7: out of bounds read."]
    assert proofs.read(proof, HOST, {}, 1.0, _done(text.replace("done for function", ""))).failure
    assert proofs.read(proof, HOST, {}, 1.0, _done(text, 1)).failure


def test_every_alarm_that_stays_is_justified() -> None:
    assert all(entry.file and entry.text and entry.why for entry in report.justified())


def test_commands_of_the_page_are_there() -> None:
    """docs/verification/proof.md names targets, files and proofs that exist; other tests run them."""
    page = report.PAGE.read_text(encoding="utf-8")
    names = {proof.name for proof in proofs.load()}
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    lines = [line for block in re.findall(r"```sh\n(.*?)```", page, re.DOTALL) for line in block.splitlines()]
    assert len(lines) == 4
    for words in (line.partition("#")[0].split() for line in lines):
        if words[0] == "make":
            assert f"\n{words[1]}: " in makefile
            continue
        files = [word for word in words if word.startswith("tests/")]
        files += [word.replace(".", "/") + ".py" for word in words if word.startswith("tests.")]
        assert files
        assert all((ROOT / file).is_file() for file in files)
        assert "prove.py" not in files[0] or words[-1] in names
