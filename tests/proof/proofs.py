# SPDX-License-Identifier: Apache-2.0
"""What proofs.yaml says, and how one run of Frama-C's Eva goes: its command, what it reached, and its alarms."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import yaml

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from microros_gen.typesupport.plan.types import TypePlan
from tests.proof.message_header import header, stems
from tests.support.paths import ROOT
from tests.support.quality import corpus
from tests.support.quality.corpus import INTERFACES, tree_key

FOLDER = Path(__file__).resolve().parent
DRIVERS = FOLDER / "drivers"
CACHE = ROOT / "build" / "proof"
"""What frama-c printed, by all that it read."""
MACHDEPS = {
    "gcc_x86_64": (),
    "gcc_x86_32": (),
    "ppc_32": ("-DCDR_HOST_IS_LITTLE_ENDIAN=0",),
}
"""Frama-C's name of a machine, and what the preprocessor (that of the host) is told of it."""
COMMON = (
    *("-eva", "-eva-no-print", "-eva-no-show-progress", "-no-autoload-plugins"),
    *("-load-module", "eva,inout,metrics,variadic,scope"),
    *("-warn-special-float", "none"),  # what arrives may be no number; nothing computes with it
    *("-warn-invalid-pointer", "-warn-left-shift-negative", "-warn-signed-downcast"),
    *("-eva-split-limit", "100000", "-eva-split-return", "full", "-eva-interprocedural-splits"),
)
_ALARM = re.compile(r"^\[eva:alarm\] (?P<file>\S+?):(?P<line>\d+): Warning:\s*(?P<text>(?:.|\n  )*)", re.M)
_COVERED = re.compile(r"^  (\w+): (\d+) stmts out of (\d+) \(", re.M)


@dataclass(frozen=True)
class Proof:
    """One entry of proofs.yaml."""

    name: str
    what: str
    bound: str
    driver: str
    application: str
    sources: tuple[str, ...]
    before: Mapping[str, str]
    options: tuple[str, ...]
    machdeps: tuple[str, ...]
    variants: tuple[Mapping[str, str], ...]
    slice: tuple[int, ...]
    unreached: Mapping[str, str]


@dataclass(frozen=True)
class Alarm:
    """What Eva could not show: a place in a generated tree, and its words."""

    file: str
    line: int
    text: str


@dataclass(frozen=True)
class Run:
    """One analysis: of a proof, for one machine and variant. `reached` is statements of how many by function."""

    proof: Proof
    machdep: str
    variant: Mapping[str, str]
    seconds: float
    alarms: tuple[Alarm, ...]
    reached: Mapping[str, tuple[int, int]]
    failure: str


def load(path: Path = FOLDER / "proofs.yaml") -> tuple[Proof, ...]:
    """Return the proofs in their order."""
    return tuple(_proof(entry) for entry in yaml.safe_load(path.read_text(encoding="utf-8")))


def _proof(entry: Mapping[str, Any]) -> Proof:
    values: dict[str, Any] = {"before": {}, "options": "", "variants": [{}], "slice": [], "unreached": {}}
    values |= {"machdeps": list(MACHDEPS)} | dict(entry)
    variants = tuple({k: str(v) for k, v in variant.items()} for variant in values["variants"])
    values |= {"options": tuple(str(values["options"]).split()), "variants": variants}
    values |= {key: tuple(values[key]) for key in ("sources", "machdeps", "slice")}
    return Proof(**values)


def is_installed() -> bool:
    return shutil.which("frama-c") is not None


@dataclass(frozen=True)
class Tree:
    """A generated tree, and its message types."""

    folder: Path
    types: tuple[TypePlan, ...]

    def key(self) -> str:
        """Return a key of the current content of its C files."""
        return tree_key(corpus.Tree("", self.folder, ()))


@cache
def tree(name: str, out: Path) -> Tree:
    """Generate applications/NAME.yaml below `out`, once."""
    paths = (INTERFACES / "quality_msgs", shipped_folder())
    options = compiler.Options(config=FOLDER / "applications" / f"{name}.yaml", interface_paths=paths)
    generated = compiler.generate(options, out / name)
    planned, folder = generated.planned, generated.out
    return Tree(folder, tuple(planned.project.types))


def runs(proof: Proof) -> Iterator[tuple[str, int]]:
    """Yield machine and number of the variant of each run."""
    for number in range(len(proof.variants)):
        for machdep in proof.machdeps:
            yield machdep, number


def command(
    proof: Proof, source_tree: Tree, machdep: str, variant: Mapping[str, str], place: Path
) -> list[str]:
    """Return the command of a run; `place` is a folder for its files."""
    defines = [f"-D{key}={value}" for key, value in variant.items() if key.isupper()]
    includes = [f"-I{place}", f"-I{place}/drivers", "-Iinclude", "-I."]
    files = sorted({file for pattern in proof.sources for file in _found(source_tree, pattern, variant)})
    before = [
        f"{file}:-include {place / 'drivers' / head}"
        for pattern, head in proof.before.items()
        for file in _found(source_tree, pattern, variant)
    ]
    arguments = " ".join([*includes, *defines, *MACHDEPS[machdep]])
    parts = ["frama-c", "-machdep", machdep, f"-cpp-extra-args={arguments}", *COMMON, *proof.options]
    parts += [f"-cpp-extra-args-per-file={','.join(before)}"] if before else []
    driver = place / "drivers" / proof.driver
    return [*parts, str(driver), *files, "-then", "-metrics", "-metrics-eva-cover"]


def _found(source_tree: Tree, pattern: str, variant: Mapping[str, str]) -> list[str]:
    """Return files of the tree; TYPES in a pattern is replaced by the prefixes of the files of the variant's types."""
    starts = stems(source_tree.types, variant["type"]) if "TYPES" in pattern else [""]
    patterns = [pattern.replace("TYPES", start) for start in starts]
    found = {
        p.relative_to(source_tree.folder).as_posix()
        for each in patterns
        for p in source_tree.folder.glob(each)
    }
    assert found, f"no file {pattern}"
    return sorted(found)


def run(proof: Proof, source_tree: Tree, machdep: str, number: int, place: Path) -> Run:
    """Analyze; `failure` is what frama-c says when it could not."""
    variant = proof.variants[number]
    here = place / f"{proof.name}-{machdep}-{number}"
    shutil.copytree(DRIVERS, here / "drivers", dirs_exist_ok=True)
    if "type" in variant:
        (here / "types.h").write_text(header(source_tree.types, variant["type"]), encoding="utf-8")
    words = command(proof, source_tree, machdep, variant, here)
    kept = CACHE / f"{_key(source_tree, here, [word.replace(str(here), '') for word in words])}.json"
    if kept.is_file():
        text, seconds = json.loads(kept.read_text(encoding="utf-8"))
        return read(proof, machdep, variant, seconds, subprocess.CompletedProcess(words, 0, text, ""))
    started = time.monotonic()
    environment = {
        **os.environ,
        "PWD": str(source_tree.folder),
    }  # frama-c takes that for the folder that it is in
    done = subprocess.run(
        words, cwd=source_tree.folder, env=environment, capture_output=True, text=True, check=False
    )
    seconds = time.monotonic() - started
    (here / "log.txt").write_text(" ".join(words) + "\n" + done.stdout + done.stderr, encoding="utf-8")
    found = read(proof, machdep, variant, seconds, done)
    if not found.failure:
        CACHE.mkdir(parents=True, exist_ok=True)
        kept.write_text(json.dumps([done.stdout, seconds]), encoding="utf-8")
    return found


def _key(source_tree: Tree, here: Path, words: Sequence[str]) -> str:
    """Return the key of a run: its command, and every C file that it may read."""
    digest = hashlib.sha256(repr(words).encode())
    for path in sorted(here.rglob("*.[ch]")):
        digest.update(path.relative_to(here).as_posix().encode() + path.read_bytes())
    return hashlib.sha256((digest.hexdigest() + source_tree.key()).encode()).hexdigest()


def read(
    proof: Proof,
    machdep: str,
    variant: Mapping[str, str],
    seconds: float,
    done: subprocess.CompletedProcess[str],
) -> Run:
    """Make sense of what frama-c printed."""
    alarms = tuple(
        Alarm(match["file"], int(match["line"]), " ".join(match["text"].split()))
        for match in _ALARM.finditer(done.stdout)
    )
    reached = {name: (int(some), int(all_)) for name, some, all_ in _COVERED.findall(done.stdout)}
    complete = "done for function main" in done.stdout and reached and "  Some errors and" not in done.stdout
    if done.returncode == 0 and complete and "main" in reached:
        return Run(proof, machdep, variant, seconds, alarms, reached, "")
    return Run(proof, machdep, variant, seconds, alarms, reached, (done.stdout + done.stderr)[-3000:])


def reached_by(each: Sequence[Run]) -> dict[str, tuple[int, int]]:
    """Return the most statements that one of the runs of a proof reaches, by function."""
    most: dict[str, tuple[int, int]] = {}
    for name, (some, every) in ((n, r) for run in each for n, r in run.reached.items()):
        base = re.sub(
            r"_\d+$", "", name
        )  # a static inline function of a header: one for each file that has it
        known = most.get(base, (0, every))
        most[base] = max(known, (some, every), key=lambda pair: pair[0] / pair[1])
    return most
