# SPDX-License-Identifier: Apache-2.0
"""An environment with the lark of ROS 2."""

from __future__ import annotations

import subprocess
import sys
import venv

import pytest


@pytest.fixture(scope="session")
def old_lark_python(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Return a Python with lark-parser 0.12, which ROS 2 installs into the same folder as lark."""
    folder = tmp_path_factory.mktemp("old_lark") / "venv"
    venv.create(folder)  # without pip, which takes most of the time: ours installs into it
    python = str(folder / "bin" / "python")
    install = [sys.executable, "-m", "pip", "--python", python, "install", "-q", "lark-parser==0.12.0"]
    if subprocess.run(install, capture_output=True, check=False).returncode:
        pytest.skip("lark-parser cannot be installed here")
    return python
