# SPDX-License-Identifier: Apache-2.0
"""The reader of .msg files with lark-parser 0.12, which ROS 2 installs into the same folder as lark."""

from __future__ import annotations

import subprocess

import pytest

from tests.support.interfaces.msg_corpus import BAD, GOOD
from tests.support.paths import ROOT

pytestmark = pytest.mark.builds

SCRIPT = """
import sys
sys.path[:0] = sys.argv[1:]
import lark
assert lark.__version__ == "0.12.0", lark.__version__
from tests.support.interfaces.msg_corpus import BAD, GOOD
from tests.support.interfaces.msg_headlines import headlines
print(*headlines([*GOOD, *BAD]), sep="\\n")
"""


@pytest.mark.system
def test_the_reader_says_the_same_with_lark_parser(old_lark_python: str) -> None:
    from tests.support.interfaces.msg_headlines import headlines

    command = [old_lark_python, "-c", SCRIPT, str(ROOT)]
    environment = {"PYTHONIOENCODING": "utf-8", "PATH": ""}
    old = subprocess.run(command, capture_output=True, encoding="utf-8", check=False, env=environment)
    assert old.returncode == 0, old.stderr
    assert old.stdout.splitlines() == headlines([*GOOD, *BAD])
