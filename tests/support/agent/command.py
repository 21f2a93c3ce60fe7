# SPDX-License-Identifier: Apache-2.0
"""Runs `microros-gen agent` to its end."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from tests.support.agent.process import environment, own_domain
from tests.support.patience import seconds

DOMAIN = own_domain()


def run(*arguments: str, code: str = "", path: Path | None = None) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", code] if code else [sys.executable, "-m", "microros_gen", "agent"]
    return subprocess.run(
        [*command, *arguments],
        env=environment(DOMAIN),
        text=True,
        capture_output=True,
        timeout=seconds(20),
        check=False,
        cwd=path,
    )
