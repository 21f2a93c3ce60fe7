# SPDX-License-Identifier: Apache-2.0
"""Several threads of one process, each with a separate peer, as an agent has them that holds parameters."""

from __future__ import annotations

import subprocess
import sys

import pytest

from tests.support.agent.process import environment, own_domain
from tests.support.patience import seconds

pytestmark = pytest.mark.ros


def test_threads_do_not_wait_for_each_other_and_read_their_own_responses() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "tests.support.ros.two_threads", "2"],
        env=environment(own_domain()),
        capture_output=True,
        text=True,
        timeout=seconds(120),
        check=False,
    )
    assert done.returncode == 0, done.stderr
    created, *others = map(int, done.stdout.split())
    calls, wrong = others[:2], others[2:]
    assert created > 0
    assert min(calls) > 0
    assert wrong == [0, 0]
