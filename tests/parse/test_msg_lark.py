# SPDX-License-Identifier: Apache-2.0
"""The reader of .msg files with lark-parser 0.12, which ROS 2 installs into the same folder as lark."""

from __future__ import annotations

import subprocess
import venv
from pathlib import Path

import pytest
from msg_corpus import BAD, GOOD

SCRIPT = """
import sys
sys.path[:0] = sys.argv[1:]
import lark
assert lark.__version__ == "0.12.0", lark.__version__
from msg_corpus import BAD, GOOD
from msg_headlines import headlines
print(*headlines([*GOOD, *BAD]), sep="\\n")
"""


def test_the_reader_says_the_same_with_lark_parser(tmp_path: Path) -> None:
    from msg_headlines import headlines

    venv.create(tmp_path / "venv", with_pip=True)
    python = str(tmp_path / "venv" / "bin" / "python")
    install = [python, "-m", "pip", "install", "-q", "lark-parser==0.12.0"]
    if subprocess.run(install, capture_output=True, check=False).returncode:
        pytest.skip("lark-parser cannot be installed here")
    folders = [str(Path(__file__).parents[2]), str(Path(__file__).parent)]
    command = [python, "-c", SCRIPT, *folders]
    environment = {"PYTHONIOENCODING": "utf-8", "PATH": ""}
    old = subprocess.run(command, capture_output=True, encoding="utf-8", check=False, env=environment)
    assert old.returncode == 0, old.stderr
    assert old.stdout.splitlines() == headlines([*GOOD, *BAD])
