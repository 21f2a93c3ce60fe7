# SPDX-License-Identifier: Apache-2.0
"""The generated pages have everything: options as `--help` prints them, keys of the schemas, the C API."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import click
import pytest
import yaml
from click.testing import CliRunner
from generators import c_api, command_line, python_api
from generators.c_headers import read_header
from hooks import OUTSIDE, SCHEMA_FILES, generated

from microros_gen import compiler
from microros_gen.cli.main import cli
from microros_gen.documents.schema import load_schema
from tests.support.paths import ROOT

SURFACE = yaml.safe_load((ROOT / "tests/runtime/surface.yaml").read_text(encoding="utf-8"))
SCHEMAS = ("application", "profile", "target", "agent")


of_all_pages = cache(generated)
of_the_command_line = cache(command_line.page)
"""The texts take a second to generate."""


def calls(group: click.Group, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Yield every command with its groups, `agent` and `agent udp4`."""
    for name in group.list_commands(click.Context(group)):
        command = group.get_command(click.Context(group), name)
        yield (*path, name)
        if isinstance(command, click.Group):
            yield from calls(command, (*path, name))


@pytest.mark.parametrize("call", list(calls(cli)), ids=" ".join)
def test_every_option_of_the_help_is_there(call: tuple[str, ...]) -> None:
    reported = CliRunner().invoke(cli, [*call, "--help"], prog_name="microros-gen").output
    (section,) = re.findall(rf"(?ms)^##+ {' '.join(call)}$(.*?)(?=^#|\Z)", of_the_command_line())
    options = set(re.findall(r"^  (?:-\w, )?(--[\w-]+|-v+)\b", reported, re.MULTILINE)) - {"--help"}
    cells = re.findall(r"(?m)^\| `([^`]+)` \|", section)
    assert options <= set(re.findall(r"(?:^|, )(-[\w-]+)", "\n".join(cells), re.MULTILINE))
    usage = " ".join(reported.split("\n\n")[0].removeprefix("Usage: ").split())
    assert usage in section


def described(part: Any, path: str = "") -> Iterator[tuple[str, str]]:
    """Yield each key of a schema and its description."""
    if isinstance(part, dict):
        for key, value in part.get("properties", {}).items():
            yield f"{path}.{key}", value.get("description", value.get("$ref", ""))
        for key, value in part.items():
            yield from described(value, f"{path}.{key}")
    elif isinstance(part, list):
        for value in part:
            yield from described(value, path)


def test_each_page_is_in_the_navigation_once() -> None:
    written = {path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs").rglob("*.md")}
    listed = re.findall(r"(?m)^ +- .*?([\w/]+\.md)$", (ROOT / "mkdocs.yml").read_text(encoding="utf-8"))
    assert sorted(listed) == sorted(written | set(of_all_pages()) | set(OUTSIDE.values()))


@pytest.mark.parametrize("name", SCHEMAS)
def test_every_key_is_there_with_its_meaning(name: str) -> None:
    page = of_all_pages()[f"reference/{name}_file.md"]
    keys = dict(described(load_schema(SCHEMA_FILES[name])))
    assert not [key for key, meaning in keys.items() if not meaning]
    rows = re.findall(r"(?m)^\| \[?`([^`]+)`.*?\| (.*?) \| (.*) \|$", page)
    assert {key.rpartition(".")[2] for key in keys} == {row[0] for row in rows}
    assert all(value and meaning.strip() for _, value, meaning in rows)


def test_what_the_suite_knows_of_the_api_is_there() -> None:
    """tests/runtime/surface.yaml has the functions as facts of ROS 2 and micro-ROS, not of these headers."""
    documented = {
        (header.name, name)
        for header in c_api.headers()
        for section in header.sections
        for item in section.items
        for name in item.names
    }
    wanted = {
        (header, re.findall(r"(\w+)\(", prototype)[0])
        for part in ("ros", "micro_ros")
        for header, prototypes in SURFACE[part].items()
        for prototype in prototypes
    }
    assert len(wanted) > 200
    generated_by_macro = {pair for pair in wanted if "__Sequence__" in pair[1]}
    assert sorted(wanted - documented - generated_by_macro) == []
    for header, types in SURFACE["members"].items():
        assert all((header, name) in documented for name in types if "__Sequence" not in name), header
    constants = {re.findall(r"\w+", line)[0] for line in SURFACE["constants"]}
    text = "\n".join(c_api.pages().values())
    assert not [name for name in constants if not re.search(rf"\b{name}\b", text)]


def test_each_anchor_is_there_once() -> None:
    for name, text in of_all_pages().items():
        anchors = [first or other for first, other in re.findall(r'\{: #(\S+) \}|<a id="(\w+)">', text)]
        assert len(anchors) == len(set(anchors)), name
        assert "{{" not in text
        assert "{% " not in text


def test_a_header_is_read_in_the_style_of_this_project() -> None:
    text = """/* SPDX-License-Identifier: Apache-2.0 */
/* Of the file. */
#ifndef MICROROS_X_H
#define MICROROS_X_H

#include "rcl/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- time --- */

/*
 * Two lines
 * of words.
 */
int32_t first(
  int a, void (*callback)(int));
bool second(void);

typedef struct a_s {
  int x; /* inside */

  int y;
} a_t;

#define LONG(x) \\
  do { \\
  } while (0)

/* A remark that stands alone. */

typedef void (*call_t)(void * data);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_X_H */
"""
    whole, time = read_header(text)
    assert (whole.title, whole.remark, whole.items) == ("", "Of the file.", ())
    assert (time.title, time.remark) == ("time", "A remark that stands alone.")
    assert [item.names for item in time.items] == [("first", "second"), ("a_t",), ("LONG",), ("call_t",)]
    assert time.items[0].doc == "Two lines\nof words."
    assert "inside" in time.items[1].text


def test_every_error_number_has_its_text() -> None:
    rows = re.findall(r"(?m)^\| E(\d+) \| `(.+)` \|$", of_all_pages()["reference/error_texts.md"])
    assert [int(number) for number, _ in rows] == list(range(2, len(rows) + 2))
    assert all(text.strip() and '"' not in text for _, text in rows)


def test_the_error_texts_of_troubleshooting_exist() -> None:
    page = (ROOT / "docs/troubleshooting.md").read_text(encoding="utf-8")
    (table,) = re.findall(r"(?m)^\| text contains \|.*\n\|[-|]+\n((?:\|.*\n)+)", page)
    named = re.findall(r"(?m)^\| `([^`]+)` \|", table)
    texts = of_all_pages()["reference/error_texts.md"]
    assert len(named) > 4
    assert [text for text in named if text not in texts] == []


def test_the_counters_of_troubleshooting_exist() -> None:
    page = (ROOT / "docs/troubleshooting.md").read_text(encoding="utf-8")
    named = re.findall(r"(?m)^\| `(\w+)` \| `(rmw_uros_get_statistics)` \|", page)
    text = "\n".join(c_api.pages().values())
    (members,) = re.findall(r"(?s)typedef struct rmw_uros_statistics_t \{(.*?)\}", text)
    assert len(named) == 5
    assert [member for member, _ in named if not re.search(rf"\b{member};", members)] == []


@pytest.mark.system
def test_two_runs_write_the_same() -> None:
    """In a process with other hashes too."""
    script = "import json; from hooks import OUTSIDE, SCHEMA_FILES, generated; print(json.dumps(generated()))"
    environment = {"PYTHONPATH": f"{ROOT}:{ROOT / 'docs'}", "PYTHONHASHSEED": "4711", "PATH": ""}
    done = subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True
    )
    assert json.loads(done.stdout) == of_all_pages()


@pytest.mark.system
def test_the_example_of_the_python_api_runs(tmp_path: Path) -> None:
    program = [sys.executable, "-c", python_api.EXAMPLE]
    done = subprocess.run(program, cwd=tmp_path, text=True, capture_output=True, check=True)
    assert (tmp_path / done.stdout.strip()).is_file()
    assert python_api.EXAMPLE in of_all_pages()["reference/python_api.md"]


def test_everything_that_the_python_api_exports_is_documented() -> None:
    page = of_all_pages()["reference/python_api.md"]
    assert [name for name in compiler.__all__ if f"### {name}\n" not in page] == []
