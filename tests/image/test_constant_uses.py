# SPDX-License-Identifier: Apache-2.0
"""What components say that their constants are for, in flash and in RAM."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

from microros_gen.image.attribution import Chunk, Owner
from microros_gen.image.entities import constant_uses
from microros_gen.image.folder import Folder

FOLDER = cast(
    Folder, SimpleNamespace(manifest={"features": {"node_modes": {"size": {"mode_of_*": "mode {}"}}}})
)


def chunk(kind: str, section: str, symbol: str, size: int, **more: Any) -> Chunk:
    return Chunk(kind, section, section, 0, size, Owner("component", "node_modes"), symbol=symbol, **more)


def test_constants_in_flash_take_no_ram() -> None:
    chunks = (
        chunk("text", ".rodata.mode_of_n_SLOW", "mode_of_n_SLOW", 24),
        chunk("text", ".rodata.mode_of_n_SLOW__given", "mode_of_n_SLOW__given", 3),
        chunk("text", ".rodata.mode_of_n_FAST", "mode_of_n_FAST", 32),
        chunk("text", ".text.mode_of_n", "mode_of_n_function", 50, function=True),
        chunk("bss", ".bss.mode_of_n_state", "mode_of_n_state", 4),
    )
    assert constant_uses(FOLDER, chunks) == {
        ("node_modes", "mode n_SLOW"): (27, 0),
        ("node_modes", "mode n_FAST"): (32, 0),
    }


def test_constants_that_the_linker_places_in_ram_take_both() -> None:
    """As for an AVR, whose output section .data has the constants; an initialized variable is none."""
    chunks = (
        chunk("data", ".rodata.mode_of_n_SLOW", "mode_of_n_SLOW", 24),
        chunk("data", ".data.mode_of_n_now", "mode_of_n_now", 2),
    )
    assert constant_uses(FOLDER, chunks) == {("node_modes", "mode n_SLOW"): (24, 24)}
