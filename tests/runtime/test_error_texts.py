# SPDX-License-Identifier: Apache-2.0
"""What error texts of the C library advise: the application file takes it."""

from __future__ import annotations

import json
import re

import pytest

from microros_gen.application.model import MOST_HISTORY
from microros_gen.application.parser import parse_application
from microros_gen.client.plan.declared import LARGEST_POOL
from microros_gen.client.plan.runtime import RuntimePlan
from microros_gen.client.plan.transport_sizes import LARGEST_MTU
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.templates import make_environment
from microros_gen.selection.find_components import components_folder, load_catalogue
from tests.support.ids import without_id
from tests.support.plans import POOL, changed

TEXT = re.compile(
    r'^const MICROROS_FLASH char (microros_error_\w+)\[\] =\n? *((?:"[^"\n]*"(?: XRCE_\w+ )?\s*)+);',
    re.MULTILINE,
)
VALUES = {"%m": "9", "%n": "8", "%s": "x", "%d": "true", "%D": "std_msgs/msg/Int32"}
POOL_KEYS = (
    "timers",
    "executors",
    "handles",
    "guard_conditions",
    "wait_sets",
    "ros_clocks",
    "jump_callbacks",
)
"""The values of %s in `pools: {%s: %m}`."""


def texts() -> dict[str, str]:
    """Return every error text of the library: of component.yaml, and those in plain files."""
    errors = [error for component in load_catalogue().values() for error in component.contributes.errors]
    found = {f"microros_error_{error.name}": error.text for error in errors if error.text}
    for path in sorted(components_folder().rglob("*.c")):
        for name, literals in TEXT.findall(path.read_text(encoding="utf-8")):
            found[name] = "".join(re.findall(r'"([^"]*)"', literals))
    return found


def advised(text: str) -> list[str]:
    """Return the lines of an application file that a text advises."""
    return re.findall(r"\b(?:pools|memory|transport): \{[^}]*\}|on_full: block \d+ ms", text)


def refused(line: str) -> list[str]:
    diagnostics = Diagnostics()
    custom = line.replace("{", "{type: custom, ") if line.startswith("transport") else line
    parse_application(Source("f", f"version: 1\nprofiles: [pure_sender]\n{custom}\n"), diagnostics)
    return [without_id(d.headline()) for d in diagnostics]


def filled(text: str) -> str:
    for placeholder, value in VALUES.items():
        text = text.replace(placeholder, value)
    return text


def test_every_key_that_a_text_names_is_taken() -> None:
    lines = {line for text in texts().values() for line in advised(text)}
    assert len(lines) > 5, "the pattern finds the texts"
    each = {
        filled(line.replace("{%s:", f"{{{key}:"))
        for line in lines
        for key in (POOL_KEYS if "{%s:" in line else ("",))
    }
    assert {line: hit for line in sorted(each) if (hit := refused(line))} == {}


def full_text(plan: RuntimePlan) -> str:
    template = make_environment().get_template("publish/src/error_text_full.c.j2")
    found = TEXT.search(template.render(plan=plan, selection=None, headers=[]))
    assert found
    return found[2]


@pytest.mark.parametrize(
    ("slots", "on_full", "advice"),
    [
        (4, "error", ["pools: {history: 5}"]),
        (15, "block", ["pools: {history: 16}"]),
        (MOST_HISTORY, "error", ["on_full: block 100 ms"]),
        (MOST_HISTORY, "block", []),
    ],
)
def test_a_full_stream_advises_what_helps(slots: int, on_full: str, advice: list[str]) -> None:
    text = full_text(
        changed(POOL, streams__reliable_slots=slots, streams__on_full=on_full, streams__on_full_block_ms=20)
    )
    assert advised(text) == advice
    assert [hit for line in advice for hit in refused(line)] == []
    assert advice[:1] == [f"pools: {{history: {slots + 1}}}"] or "publish less often" in text


def test_the_schema_has_the_numbers_that_advice_stops_at() -> None:
    schema = json.loads(
        (components_folder().parent / "application/application.schema.json").read_text(encoding="utf-8")
    )
    assert schema["properties"]["pools"]["properties"]["history"]["maximum"] == MOST_HISTORY
    template = (components_folder() / "base/variants/error_code.h.j2").read_text(encoding="utf-8")
    most = re.search(r"MICROROS_POOL_MOST (\d+)u", template)
    assert most
    assert int(most[1]) == LARGEST_POOL
    assert schema["properties"]["pools"]["properties"]["nodes"]["maximum"] == LARGEST_POOL
    assert schema["properties"]["transport"]["properties"]["mtu"]["maximum"] == LARGEST_MTU
