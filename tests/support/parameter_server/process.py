# SPDX-License-Identifier: Apache-2.0
"""`microros-gen parameter-server` in a process."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from tests.support.e2e.server_process import server_process

READY = "parameter server ready: /microros_parameters\n"


@contextmanager
def parameter_server(
    domain: int, file: Path, command: Sequence[str] = ("-m", "microros_gen", "parameter-server")
) -> Iterator[subprocess.Popen[str]]:
    """Start one in a ROS domain and wait until it serves; kill it afterwards. Its stderr is FILE.log."""
    with (
        file.with_suffix(".log").open("a", encoding="utf-8") as log,
        server_process(domain, READY, (*command, "--file", str(file)), log) as process,
    ):
        yield process
