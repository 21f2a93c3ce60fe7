# SPDX-License-Identifier: Apache-2.0
"""libFuzzer over the whole client, and over the frames of serial lines, from the corpora kept in corpus/.

The corpus is replayed and a little more is tried, of frames in `make test` and of the client in `make system`;
`-m long` goes on for MICROROS_FUZZ_SECONDS (600).
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.support.runtime.fuzzing import CORPUS, QUICK, SECONDS, TARGETS, Target, fuzz, fuzzer
from tests.support.slices import first

pytestmark = [
    pytest.mark.skipif(not shutil.which("clang"), reason="libFuzzer comes with clang"),
    pytest.mark.parametrize("target", first(TARGETS), ids=[target.name for target in TARGETS]),
]
LARGEST_CORPUS = 200_000


def test_corpus_and_a_little_more(target: Target, tmp_path: Path) -> None:
    """The same inputs and the same changes each time."""
    kept = sorted((CORPUS / target.name).iterdir())
    assert kept
    assert sum(path.stat().st_size for path in kept) < LARGEST_CORPUS / 2
    (tmp_path / "new").mkdir()
    runs = str(3 * len(kept) + 1000)
    fuzz(
        fuzzer(target, tmp_path, QUICK),
        target,
        tmp_path / "new",
        CORPUS / target.name,
        options=(f"-runs={runs}", "-seed=1"),
    )


@pytest.mark.long
def test_at_length(target: Target, tmp_path: Path) -> None:
    (tmp_path / "new").mkdir()
    program = fuzzer(target, tmp_path)
    fuzz(program, target, tmp_path / "new", CORPUS / target.name, options=(f"-max_total_time={SECONDS}",))
