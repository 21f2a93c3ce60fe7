# SPDX-License-Identifier: Apache-2.0
"""float64 where a double is a binary32: every number becomes the nearest one, by numpy."""

from __future__ import annotations

import math
import struct
import subprocess
from pathlib import Path

import numpy as np
import pytest

from microros_gen.typesupport.plan.narrow import as_binary32
from tests.support.firmware.board import C_FILES
from tests.support.typesupport.build import COMPONENT_HEADERS, COMPONENTS, run
from tests.support.typesupport.float64 import QUIET, edge_patterns, expected, is_quiet, random_patterns

PATTERNS = [*edge_patterns(), *random_patterns(200_000, seed=64)]


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[int, int]]:
    """What the C code makes of PATTERNS, compiled for this computer."""
    folder: Path = tmp_path_factory.mktemp("float64")
    (folder / "microros").mkdir()
    header = COMPONENTS / "cdr" / "variants" / "cdr_double.h"
    (folder / "microros" / header.name).write_bytes(header.read_bytes())
    includes = [f"-I{folder}", *(f"-I{COMPONENTS / c / 'include'}" for c in COMPONENT_HEADERS)]
    sources = [C_FILES / "float64.c", COMPONENTS / "cdr" / "src" / "cdr_double.c"]
    run(["cc", "-std=c99", "-O1", "-fsanitize=undefined", *includes, *sources, "-o", folder / "float64"])
    sent = struct.pack(f"<{len(PATTERNS)}Q", *PATTERNS)
    done = subprocess.run([folder / "float64"], input=sent, capture_output=True, check=True)
    assert done.stderr == b""
    return list(struct.iter_unpack("<IQ", done.stdout))


def test_each_becomes_the_nearest(answers: list[tuple[int, int]]) -> None:
    wrong = [
        (hex(pattern), hex(narrow), hex(wide))
        for pattern, (narrow, wide) in zip(PATTERNS, answers, strict=True)
        if (narrow, wide) != expected(pattern)
    ]
    assert wrong == []


def test_a_nan_stays_of_its_kind(answers: list[tuple[int, int]]) -> None:
    kinds = {
        (bool(pattern >> 51 & 1), is_quiet(narrow))
        for pattern, (narrow, _) in zip(PATTERNS, answers, strict=True)
        if narrow & 0x7FFFFFFF > 0x7F800000
    }
    assert kinds == {(True, True), (False, False)}
    assert QUIET << 29 == 1 << 51


def test_values_of_files_are_rounded_the_same() -> None:
    """Constants and default values, which Python rounds."""
    for pattern in PATTERNS[:20_000]:
        [value] = struct.unpack("<d", struct.pack("<Q", pattern))
        if not math.isnan(value):
            with np.errstate(all="ignore"):
                assert np.float32(as_binary32(value)).view(np.uint32) == expected(pattern)[0]
