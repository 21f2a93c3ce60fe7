# SPDX-License-Identifier: Apache-2.0
"""The prose of a file of this repository, and the phrases of wording.yaml in it."""

from __future__ import annotations

import io
import os
import re
import tokenize
from functools import cache
from pathlib import Path

import yaml

from tests.support.paths import ROOT

PHRASES = ROOT / "tests/quality/wording.yaml"
SUFFIXES = {".md", ".py", ".c", ".h", ".j2", ".S", ".yaml", ".json", ".cmake", ".yml", ".toml"}
ENDINGS = tuple(SUFFIXES)
FOLDERS = ("microros_gen", "tests", "docs", "examples", "cmake", "profiles")
# Golden copies follow from the sources, dialogues and corpora are recordings, the list and its test contain the
# phrases.
EXCLUDED = (
    "tests/golden/",
    "tests/exchanges/golden",
    "tests/agent/dialogues/",
    "tests/runtime/corpus/",
    "microros_gen/idl/",
    "tests/quality/wording.yaml",
    "tests/quality/test_wording.py",
    "tests/quality/names.yaml",
    "tests/quality/test_names.py",
)
_PAGE_CODE = re.compile(
    r"^( *)```.*?^\1```|`[^`\n]+`|\]\([^)]*\)|<!-- misra: begin.*?misra: end -->", re.M | re.S
)
TYPE_SUPPORT = "microros_gen/templates/types/"
"""Templates whose output stays byte for byte: only comments of the templates themselves are prose here."""
_TEMPLATE_COMMENT = re.compile(r"\{#.*?#\}", re.S)
_C_PROSE = re.compile(r'/\*.*?\*/|\{#.*?#\}|"(?:[^"\\\n]|\\.)*"|//[^\n]*', re.S)


@cache
def phrases() -> list[tuple[re.Pattern[str], str]]:
    """Return each phrase to avoid, as a pattern whose spaces match any white space, with its replacement."""
    entries = yaml.safe_load(PHRASES.read_text(encoding="utf-8"))
    return [
        (re.compile(entry["phrase"].replace(" ", r"\s+"), re.IGNORECASE), entry["write"]) for entry in entries
    ]


@cache
def files() -> dict[str, Path]:
    """Return the files with prose, by their path in the repository."""
    names = ["README.md"]
    for folder in FOLDERS:  # `Path.rglob` takes two seconds, in each process of the suite
        for place, _, inside in os.walk(ROOT / folder):
            below = place[len(str(ROOT)) + 1 :]
            names += sorted(f"{below}/{name}" for name in inside if name.endswith(ENDINGS))
    return {name: ROOT / name for name in sorted(names) if not name.startswith(EXCLUDED)}


def blanked(text: str) -> str:
    """Return `text` as spaces, with its line breaks."""
    return re.sub(r"[^\n]", " ", text)


def prose_of_python(text: str) -> str:
    """Return comments and strings of a Python file; lines kept, the quotes and `#` of adjacent ones blanked."""
    lines = [blanked(line) for line in text.splitlines()]
    kinds = {tokenize.COMMENT, tokenize.STRING, getattr(tokenize, "FSTRING_MIDDLE", -1)}
    source = text.splitlines()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type not in kinds:
            continue
        (first, start), (last, end) = token.start, token.end
        for number in range(first, last + 1):
            left, right = (
                (start if number == first else 0),
                (end if number == last else len(source[number - 1])),
            )
            chunk = re.sub(
                r"""^[rbfRBF]*(?:\"{1,3}|')|(?:\"{1,3}|')$|^#+""",
                lambda m: " " * len(m[0]),
                source[number - 1][left:right],
            )
            lines[number - 1] = lines[number - 1][:left] + chunk + lines[number - 1][right:]
    return "\n".join(lines)


def prose_of_c(text: str) -> str:
    """Return comments and strings of a C file or a template of one, lines kept."""
    kept = [" "] * len(text)
    for found in _C_PROSE.finditer(text):
        kept[found.start() : found.end()] = re.sub(r"(?m)^\s*\*|/\*|\*/", lambda m: " " * len(m[0]), found[0])
    return "".join(kept[at] if char != "\n" else "\n" for at, char in enumerate(text))


def prose(path: Path, text: str) -> str:
    """Return what people read in a file: a page without its code, comments and strings of code, all of a data file."""
    if TYPE_SUPPORT in path.as_posix():
        return "".join(_TEMPLATE_COMMENT.findall(text))
    if path.suffix == ".md":
        return _PAGE_CODE.sub(lambda found: blanked(found[0]), text)
    if path.suffix == ".py":
        return prose_of_python(text)
    if path.suffix in (".c", ".h", ".S") or path.name.endswith((".c.j2", ".h.j2")):
        return prose_of_c(text)
    return re.sub(r"(?m)^(\s*)#+", r"\1 ", text)


def refused(text: str) -> list[str]:
    """Return each phrase that `text` should not have, with its line and what to write instead."""
    found = []
    for pattern, instead in phrases():
        for match in pattern.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            found.append(f"{line}: {' '.join(match[0].split())!r}: write {instead}")
    return found


def needed_word(pattern: str) -> str:
    """Return a word that every match of a phrase has in lower case, "" where its alternatives share none."""
    if "|" in re.sub(r"\([^()]*\)", "", pattern):
        return ""
    text = re.sub(r"\(\?![^()]*\)|\([^()]*\)\??|\[[^]]*\]\+?|\\.\+?|\w\?", " ", pattern)
    return max(re.findall(r"[a-z]+", text), key=len, default="")


@cache
def quick_patterns() -> list[tuple[str, re.Pattern[str]]]:
    """Return for each phrase its word, and a pattern of text in lower case that finds it more quickly, or more."""
    found = []
    for pattern, _ in phrases():
        loose = "|".join(part.removeprefix(r"\b") for part in re.split(r"\|(?![^(]*\))", pattern.pattern))
        found.append((needed_word(pattern.pattern), re.compile(loose)))
    return found


def refused_in(path: Path) -> list[str]:
    """Return each phrase in the prose of a file that it should not have."""
    text = path.read_text(encoding="utf-8")
    # Splitting code into tokens takes long, and so do the patterns; nearly no file has one of the phrases.
    low = re.sub(r"(?m)^\s*(?:#|\*|//)", " ", text).lower()
    if not any(word in low and pattern.search(low) for word, pattern in quick_patterns()):
        return []
    return refused(prose(path, text))
