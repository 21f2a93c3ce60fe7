# SPDX-License-Identifier: Apache-2.0
"""The reached figures, kept as ceilings in footprint.json: `make footprint` measures and updates them."""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Iterator
from functools import cache
from typing import Any

from tests.support.firmware.board import BOARDS, Builds, target
from tests.support.firmware.footprint import MODES, RELIABILITIES, Sender, bounded_stack, sections, work
from tests.support.paths import ROOT, TESTS

FILE = TESTS / "firmware" / "footprint.json"
README = ROOT / "README.md"
ROW = re.compile(r"(?m)^\| here \| [^|]* \| [^|]* \| (?P<peak>[^|]*) \| [^|]* \| [^|]* \|$")
CORTEX_M4 = "qemu-mps2-an386"
OTHER_COMPILER = 1.05
"""How much more another version of a compiler than the one of the ceilings may need."""


def cases() -> Iterator[tuple[str, Sender]]:
    """Yield what has ceilings: every way to create entities on the Cortex-M4, the reliable sender on every board."""
    for mode in MODES:
        for reliability in RELIABILITIES:
            yield CORTEX_M4, Sender(mode, reliability)
    yield CORTEX_M4, Sender(errors="text")
    for name in BOARDS:
        if name != CORTEX_M4:
            yield name, Sender()


def compiler_of(name: str) -> str:
    """Return the version of a board's compiler: `12.2.1`."""
    command = [target(name).compilers[0], "-dumpfullversion"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


@cache
def measure(builds: Builds, name: str, sender: Sender) -> dict[str, int]:
    """Return the figures of one sender on one board; they repeat exactly with one compiler."""
    built = builds.build(name, sender.application)
    size, instructions = sections(built), work(builds, name, sender)
    return {
        "text": size.text,
        "ram": size.ram,
        "stack": bounded_stack(built),
        "ready": instructions.ready,
        "publish": instructions.publish,
    }


def load() -> dict[str, Any]:
    """Return the ceilings by board: the compiler's version, and figures by the sender's label."""
    loaded: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    return loaded


def update(builds: Builds) -> None:
    """Measure everything and rewrite the file."""
    found: dict[str, Any] = {}
    for name, sender in cases():
        board = found.setdefault(name, {"compiler": compiler_of(name), "senders": {}})
        board["senders"][sender.label] = measure(builds, name, sender)
    FILE.write_text(json.dumps(found, indent=2, sort_keys=True) + "\n", encoding="utf-8")
    text = README.read_text(encoding="utf-8")
    README.write_text(ROW.sub(lambda row: readme_row(row, found), text), encoding="utf-8")


def readme_row(row: re.Match[str], figures: dict[str, Any]) -> str:
    """Return the row of README.md with these figures; the high-water mark, which is measured separately, is kept."""
    sender = figures[CORTEX_M4]["senders"][Sender().label]
    text, ram, ready, publish = (f"{sender[key]:,}" for key in ("text", "ram", "ready", "publish"))
    return f"| here | {text} | {ram} | {row['peak']} | {ready} | {publish} |"
