# SPDX-License-Identifier: Apache-2.0
"""What the MISRA C:2012 addon of cppcheck says of the corpus, and the table of it for docs/verification/quality.md.

The addon is called on the dump of each file. Called through `cppcheck --addon`, it says less: cppcheck keeps one
finding a line, because without the texts of the rules all findings have one message.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from pathlib import Path

import yaml

from tests.support.paths import ROOT, TESTS
from tests.support.quality import misra_addon
from tests.support.quality.corpus import Tree, Unit, analyze_together, configuration_flags, run
from tests.support.quality.covering import known_headers

DEVIATIONS = TESTS / "quality" / "misra-deviations.yaml"
PAGE = ROOT / "docs" / "verification" / "quality.md"
OPTIONS = ("--std=c99", "--platform=unix32", "-U__cplusplus", "-Iinclude")
BEGIN, END = "<!-- misra: begin -->\n", "<!-- misra: end -->\n"
SEPARATOR = "\n--\n"
TOGETHER = 20
"""Files that one process of the addon reads."""

# Categories of MISRA C:2012; every rule that is in neither is required.
MANDATORY = frozenset(
    {"9.1", "12.5", "13.6", "17.3", "17.4", "17.6", "19.1", "21.13", "21.17", "21.18", "21.19", "21.20"}
    | {"22.2", "22.4", "22.5", "22.6"}
)
ADVISORY = frozenset(
    {
        "1.2",
        "2.3",
        "2.4",
        "2.5",
        "2.6",
        "2.7",
        "4.2",
        "5.9",
        "8.7",
        "8.9",
        "8.11",
        "8.13",
        "10.5",
        "11.4",
        "11.5",
    }
    | {"12.1", "12.3", "12.4", "13.3", "13.4", "15.1", "15.4", "15.5", "17.5", "17.8", "18.4", "18.5", "19.2"}
    | {"20.1", "20.5", "20.10", "21.12"}
)

Places = Counter[tuple[str, str]]
"""Number of places by rule and file: the most that any one tree has."""


@dataclass(frozen=True)
class Deviation:
    """A rule that is not kept in files that match `where`, and why that is right."""

    rule: str
    where: tuple[str, ...]
    why: str
    risk: str

    def covers(self, rule: str, path: str) -> bool:
        return rule == self.rule and any(fnmatchcase(path, pattern) for pattern in self.where)


def rule_key(rule: str) -> tuple[int, ...]:
    """Return the order of rules: 2.10 comes after 2.9."""
    return tuple(int(part) for part in rule.split("."))


def category(rule: str) -> str:
    return "mandatory" if rule in MANDATORY else "advisory" if rule in ADVISORY else "required"


def find_addon() -> Path | None:
    """Return the addon's file besides the installed cppcheck."""
    program = shutil.which("cppcheck")
    if program is None:
        return None
    prefix = Path(program).resolve().parent.parent
    folders = ("lib/*/cppcheck", "share/cppcheck", "share/Cppcheck", "lib/cppcheck")
    found = (path for folder in folders for path in sorted(prefix.glob(f"{folder}/addons/misra.py")))
    return next(found, None)


def tool_version() -> str:
    """Return `Cppcheck 2.10`."""
    return run(["cppcheck", "--version"], ROOT).stdout.strip()


def checked_rules(addon: Path) -> tuple[list[str], list[str]]:
    """Return the rules that the addon checks, and those that cppcheck's own checks cover."""
    table = run([sys.executable, str(addon), "-generate-table"], ROOT).stdout
    rows = re.findall(r"^([0-9]+\.[0-9]+) +X \((Addon|Cppcheck)\)", table, re.MULTILINE)
    return [r for r, by in rows if by == "Addon"], [r for r, by in rows if by == "Cppcheck"]


def _check(group: Sequence[Unit], addon: Path, known: Mapping[str, Sequence[str]]) -> list[str]:
    """Return the findings in each file, a line each, and what the addon wants to know of the whole program.

    `known`: by the key of a file, headers whose findings others have.
    """
    for unit in group:
        command = ["cppcheck", "-q", *OPTIONS, *configuration_flags(unit), "--dump", unit.source]
        dumped = run(command, unit.tree.out)
        assert dumped.returncode == 0, dumped.stderr
    places = json.dumps([(str(unit.tree.out), f"{unit.source}.dump", known.get(unit.key)) for unit in group])
    python = ["env", f"PYTHONPATH={addon.parent}", sys.executable]
    reported = run([*python, "-m", misra_addon.__name__], ROOT, places)
    assert reported.returncode == 0, reported.stderr
    found = zip(group, json.loads(reported.stdout), strict=True)
    return [findings + SEPARATOR + _summary(unit) for unit, findings in found]


def _summary(unit: Unit) -> str:
    path = unit.tree.out / f"{unit.source}.ctu-info"
    return path.read_text(encoding="utf-8") if path.is_file() else ""


Finding = tuple[str, str, int, int]
"""Rule, file, line, column."""


def _findings(text: str) -> set[Finding]:
    lines = (json.loads(line) for line in text.splitlines() if line.startswith("{"))
    return {(f["errorId"].removeprefix("c2012-"), f["file"], f["linenr"], f["column"]) for f in lines}


def _same_place(summaries: Sequence[str]) -> Iterator[str]:
    """Yield the summaries with one line for all of a header.

    A header's lines differ from tree to tree where it is rendered, and from answer to answer where a comment grew.
    """
    for line in "".join(summaries).splitlines():
        summary = json.loads(line)
        for item in summary["data"]:
            if isinstance(item, dict) and str(item.get("file")).startswith("include/"):
                item["line"] = 1
        yield json.dumps(summary) + "\n"


def _whole_program(tree: Tree, summaries: Sequence[str], addon: Path) -> str:
    path = tree.out / "all.ctu-info"
    path.write_text("".join(_same_place(summaries)), encoding="utf-8")
    reported = run([sys.executable, str(addon), "--cli", str(path)], tree.out)
    assert reported.returncode in (0, 1), reported.stderr
    return reported.stdout


def _key(unit: Unit, known: Sequence[str]) -> str:
    return hashlib.sha256("\0".join([unit.key, *known]).encode()).hexdigest()


def _addon() -> Path:
    addon = find_addon()
    assert addon is not None, "cppcheck is not installed, or without its addons"
    return addon


def _answers(every: Sequence[Unit], known: Mapping[str, Sequence[str]]) -> dict[str, str]:
    addon, tool = _addon(), f"misra {tool_version()} {OPTIONS}"
    return analyze_together(tool, every, lambda group: _check(group, addon, known), TOGETHER)


def findings_of(every: Sequence[Unit]) -> set[Finding]:
    """Return the findings in each file and in its headers, without the rules about all files of a program."""
    return set[Finding]().union(
        *(_findings(text.split(SEPARATOR)[0]) for text in _answers(every, {}).values())
    )


def check(trees: Sequence[Tree], every: Sequence[Unit], is_whole: bool = True) -> Places:
    """Return what the addon finds in `trees`, whose files are `every`.

    `is_whole`: with the rules about all files of a program together. Without them where `every` has only some files
    of a tree: they are no program, and a header that several of them include is read for one.
    """
    addon = _addon()
    known: dict[str, list[str]] = {}
    if not is_whole:
        headers = known_headers(every)
        every = [replace(unit, key=_key(unit, names)) for unit, names in zip(every, headers, strict=True)]
        known = {unit.key: names for unit, names in zip(every, headers, strict=True)}
    answers = _answers(every, known)
    places: Places = Counter()
    for tree in trees:
        parts = [answers[unit.key].split(SEPARATOR) for unit in every if unit.tree == tree]
        found = set().union(*(_findings(reported) for reported, _ in parts))
        if is_whole:
            found |= _findings(_whole_program(tree, [whole for _, whole in parts], addon))
        places |= Counter((rule, path) for rule, path, _, _ in found)
    return places


def load_deviations() -> list[Deviation]:
    """Return the deviations in the order of their rules."""
    entries = yaml.safe_load(DEVIATIONS.read_text(encoding="utf-8"))
    found = [
        Deviation(str(e["rule"]), tuple(e["where"]), e["why"].strip(), e["risk"].strip()) for e in entries
    ]
    return sorted(found, key=lambda d: rule_key(d.rule))


def undocumented(places: Mapping[tuple[str, str], int], deviations: Sequence[Deviation]) -> list[str]:
    """Return what no deviation covers: `rule file: number`."""
    return [
        f"{rule} {path}: {count}"
        for (rule, path), count in sorted(places.items())
        if not any(d.covers(rule, path) for d in deviations)
    ]


def unused(places: Mapping[tuple[str, str], int], deviations: Sequence[Deviation]) -> list[str]:
    """Return the patterns of deviations that no finding matches: `rule pattern`."""
    return [
        f"{d.rule} {pattern}"
        for d in deviations
        for pattern in d.where
        if not any(rule == d.rule and fnmatchcase(path, pattern) for rule, path in places)
    ]


def by_rule_and_file(places: Mapping[tuple[str, str], int]) -> str:
    """Return a table of every rule and file, for reading."""
    rows = sorted(places.items(), key=lambda item: (rule_key(item[0][0]), item[0][1]))
    return "".join(f"{rule:>6} {count:5}  {path}\n" for (rule, path), count in rows)


def table(deviations: Sequence[Deviation]) -> str:
    """Return the part of docs/verification/quality.md between the two marks.

    It holds where nothing is `undocumented` or `unused`. No numbers of places: they change with every line of C.
    """
    addon = find_addon()
    assert addon is not None
    by_addon, by_cppcheck = checked_rules(addon)
    fired = {d.rule for d in deviations}
    clean = [rule for rule in by_addon if rule not in fired]
    lines = [
        f"Checked with {tool_version()}: {len(by_addon)} rules by the addon. {len(clean)} have no finding, "
        f"{len(fired)} have the deviations below.\n\n",
        f"**No finding:** {', '.join(clean)}.\n\n",
        "**Left to cppcheck's own checks** (their suppressions: `tests/quality/cppcheck-suppressions.txt`): "
        f"{', '.join(by_cppcheck)}.\n\n",
        "**Not checked by the tool:** 1.1, 1.2, 12.5, and every directive.\n\n",
        "| rule | category | in | why | risk, and mitigation |\n|---|---|---|---|---|\n",
    ]
    for d in deviations:
        where = ", ".join(f"`{pattern}`" for pattern in d.where)
        cells = (d.rule, category(d.rule), where, d.why, d.risk)
        lines.append("| " + " | ".join(" ".join(cell.split()) for cell in cells) + " |\n")
    return "".join(lines)


def page_table() -> str:
    """Return what docs/verification/quality.md holds now."""
    text = PAGE.read_text(encoding="utf-8")
    return text[text.index(BEGIN) + len(BEGIN) : text.index(END)]


def write_page(new: str) -> None:
    """Put the table into docs/verification/quality.md."""
    text = PAGE.read_text(encoding="utf-8")
    before, after = text[: text.index(BEGIN) + len(BEGIN)], text[text.index(END) :]
    PAGE.write_text(before + new + after, encoding="utf-8")
