# SPDX-License-Identifier: Apache-2.0
"""Compiled templates: from a file of earlier runs, or from a second process."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Mapping
from pathlib import Path

import pytest

from microros_gen.documents.ahead import compute_ahead

GENERATE = ("-m", "microros_gen", "generate", "--profile", "pure_sender", "-o", "out")


def generated(folder: Path, **environ: str) -> dict[str, bytes]:
    """Generate in `folder` with a new cache folder; return the files."""
    folder.mkdir(exist_ok=True)
    environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache"), **environ}
    subprocess.run([sys.executable, *GENERATE], cwd=folder, env=environment, check=True, capture_output=True)
    out = folder / "out"
    return {path.relative_to(out).as_posix(): path.read_bytes() for path in out.rglob("*") if path.is_file()}


def test_a_run_without_a_cache_leaves_what_the_next_one_takes(tmp_path: Path) -> None:
    """Both processes together compile every template; the third way, from the file, gives the same output."""
    first = generated(tmp_path)
    (kept,) = (tmp_path / "cache" / "microros-gen" / "templates").iterdir()
    compiled = kept.read_bytes()
    (tmp_path / "out" / "README.md").unlink()
    assert generated(tmp_path) == first
    assert kept.read_bytes() == compiled


def test_a_process_computes(capfd: pytest.CaptureFixture[str]) -> None:
    ahead = compute_ahead(lambda: {"process": str(os.getpid()).encode(), "long": bytes(1 << 20)})
    if ahead is None:
        pytest.skip("one processor, or no fork")
    found = ahead.take()
    assert found["process"] == str(ahead.process).encode()
    assert found["long"] == bytes(1 << 20)
    assert capfd.readouterr() == ("", "")


def killed() -> Mapping[str, bytes]:
    os.kill(os.getpid(), 9)
    return {}


def broken() -> Mapping[str, bytes]:
    raise RuntimeError


@pytest.mark.parametrize("compute", [killed, broken])
def test_a_process_that_fails_has_no_result(compute: object, capfd: pytest.CaptureFixture[str]) -> None:
    ahead = compute_ahead(compute)  # type: ignore[arg-type]
    if ahead is None:
        pytest.skip("one processor, or no fork")
    assert ahead.take() == {}
    assert capfd.readouterr() == ("", "")
    with pytest.raises(ChildProcessError):
        os.waitpid(ahead.process, 0)  # nothing is left of it


def test_no_process_with_threads() -> None:
    end = threading.Event()
    thread = threading.Thread(target=end.wait)
    thread.start()
    try:
        assert compute_ahead(dict) is None
    finally:
        end.set()
        thread.join()
