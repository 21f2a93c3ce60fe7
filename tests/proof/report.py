# SPDX-License-Identifier: Apache-2.0
"""The report of the proof: justified alarms, what was not reached, and the tables of docs/verification/proof.md."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cache

import yaml

from tests.proof.proofs import FOLDER, Alarm, Proof, Run, load, reached_by
from tests.support.paths import ROOT

PAGE = ROOT / "docs" / "verification" / "proof.md"
BEGIN, END = "<!-- proof: begin -->\n", "<!-- proof: end -->\n"


@dataclass(frozen=True)
class Justified:
    """An alarm that stays: its place and words (patterns), and why it is none."""

    file: str
    text: str
    why: str


@cache
def justified() -> tuple[Justified, ...]:
    """Return the entries of alarms.yaml."""
    entries = yaml.safe_load((FOLDER / "alarms.yaml").read_text(encoding="utf-8")) or []
    return tuple(Justified(**entry) for entry in entries)


def is_justified(alarm: Alarm, known: Sequence[Justified]) -> bool:
    return any(fnmatchcase(alarm.file, j.file) and fnmatchcase(alarm.text, j.text) for j in known)


def name(run: Run) -> str:
    """Return the proof, the machine and the variant."""
    values = " ".join(f"{key}={value}" for key, value in run.variant.items())
    return " ".join(part for part in (run.proof.name, run.machdep, values) if part)


def line(run: Run) -> str:
    return f"{name(run)}: {len(run.alarms)} alarms, {run.seconds:.1f} s"


def problems(run: Run) -> list[str]:
    """Return what has to be fixed or justified after this run."""
    found = [
        f"{name(run)}: {alarm.file}:{alarm.line}: {alarm.text}"
        for alarm in run.alarms
        if not is_justified(alarm, justified())
    ]
    return [*found, f"{name(run)}: {run.failure}"] if run.failure else found


def gaps(proof: Proof, each: Sequence[Run]) -> dict[str, tuple[int, int]]:
    """Return functions of which no run of `proof` reaches every statement; those of drivers count."""
    own_runs = [run for run in each if run.proof.name == proof.name]
    return {f: pair for f, pair in reached_by(own_runs).items() if pair[0] < pair[1]}


def reason(proof: Proof, function: str) -> str:
    """Return why some of its statements are not reached: its own entry of proofs.yaml, or that of all others (`*`)."""
    return proof.unreached.get(function, proof.unreached.get("*", ""))


def unexplained(each: Sequence[Run]) -> list[str]:
    """Return functions with statements that are not reached and have no reason in proofs.yaml."""
    return [
        f"{proof.name}: {function} reaches {some} of {every} statements, and proofs.yaml does not say why"
        for proof in load()
        for function, (some, every) in sorted(gaps(proof, each).items())
        if not reason(proof, function)
    ]


def tables(each: Sequence[Run]) -> str:
    """Return the part of docs/verification/proof.md that the runs make."""
    version = subprocess.run(["frama-c", "-version"], capture_output=True, text=True, check=True).stdout
    alarms = sum(len(run.alarms) for run in each)
    lines = [
        f"Frama-C {version.strip()}: {len(each)} runs, {alarms} alarms ({len(justified())} justified).\n\n",
        "| proof | what | for every input up to | runs | functions | statements | alarms |\n",
        "|---|---|---|---|---|---|---|\n",
    ]
    for proof in load():
        own_runs = [run for run in each if run.proof.name == proof.name]
        most = reached_by(own_runs)
        some, every = (sum(pair[i] for pair in most.values()) for i in (0, 1))
        cells = (
            proof.name,
            proof.what,
            _bounds(proof),
            str(len(own_runs)),
            str(len(most)),
            f"{some} of {every}",
        )
        lines.append(f"| {' | '.join(cells)} | {sum(len(run.alarms) for run in own_runs)} |\n")
    lines.append("\nStatements that no run reaches:\n\n")
    for proof in load():
        for function, (some, every) in sorted(gaps(proof, each).items()):
            lines.append(
                f"- {proof.name}: `{function}`, {every - some} of {every}: {reason(proof, function)}\n"
            )
    return "".join(lines)


def _bounds(proof: Proof) -> str:
    """Return the bound in words, with the values of each variant."""
    names = ("type", "PRIMITIVE", "ID_FIRST", "FIRST", "LAST", "CAPACITY")
    each = [[v[name].rpartition("/")[2] for name in names if name in v] for v in proof.variants]
    values = ", ".join("…".join(part) for part in each if part)
    return f"{proof.bound} ({values})" if values else proof.bound


def write(each: Sequence[Run]) -> None:
    """Put the tables into docs/verification/proof.md."""
    text = PAGE.read_text(encoding="utf-8")
    before, after = text[: text.index(BEGIN) + len(BEGIN)], text[text.index(END) :]
    PAGE.write_text(before + tables(each) + after, encoding="utf-8")
