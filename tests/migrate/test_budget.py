# SPDX-License-Identifier: Apache-2.0
"""A folder that `init` wrote checks the budgets of its application file when it is built."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.environments import clean_environ
from tests.support.migrate.proposals import Init
from tests.support.paths import ROOT

pytestmark = pytest.mark.builds


@pytest.mark.system
def test_a_budget_is_checked_when_the_image_is_linked(init: Init, tmp_path: Path) -> None:
    assert init("app", "--profile", "pure_sender")[0] == 0
    config = tmp_path / "app/microros.yaml"
    before = config.read_text()
    environment = clean_environ(
        XDG_CACHE_HOME=str(tmp_path / "cache"), microros_gen_DIR=str(ROOT / "cmake"), PYTHONPATH=str(ROOT)
    )

    def run(*command: str) -> tuple[int, str]:
        done = subprocess.run(
            command, cwd=tmp_path / "app", env=environment, capture_output=True, text=True, check=False
        )
        return done.returncode, done.stdout + done.stderr

    config.write_text(f"{before}memory: {{ram_budget: 1 KiB}}\n")
    place = f"microros.yaml:{before.count(chr(10)) + 1}:22: error: static RAM in the image: "
    status, output = run(
        "cmake", "-S", ".", "-B", "build", "-G", "Ninja", f"-DMICROROS_GEN_PYTHON={sys.executable}"
    )
    assert status == 0, output
    status, output = run("cmake", "--build", "build", "-j2")
    assert status != 0
    assert place in output
    assert "memory.ram_budget is 1024" in output
    config.write_text(f"{before}memory: {{ram_budget: 64 KiB}}\n")
    status, output = run("cmake", "--build", "build", "-j2")
    assert status == 0, output
    status, output = run(sys.executable, "-m", "microros_gen", "size", "build", "--budgets")
    assert (status, output) == (0, "")
