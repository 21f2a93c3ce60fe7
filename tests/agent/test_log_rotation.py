# SPDX-License-Identifier: Apache-2.0
"""The log rotation of docs/howto/agent.md, with Debian's logrotate: the agent goes on in the file that it emptied."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.support.agent.client import XrceClient
from tests.support.agent.command import DOMAIN
from tests.support.agent.process import running_agent
from tests.support.paths import ROOT
from tests.support.patience import deadline, seconds

pytestmark = [pytest.mark.builds, pytest.mark.ros]

PAGE = (ROOT / "docs/howto/agent.md").read_text(encoding="utf-8")
PLACE = "/var/log/microros-agent.log"


def wait_for(file: Path, text: str) -> str:
    end = deadline(15)
    while text not in (found := file.read_text()):
        assert time.monotonic() < end, found
        time.sleep(0.01)
    return found


@pytest.mark.parametrize("options", [(), ("--workers", "1")], ids=["one process", "workers"])
def test_the_agent_goes_on_in_the_file_that_logrotate_emptied(
    tmp_path: Path, options: tuple[str, ...]
) -> None:
    program = shutil.which("logrotate", path="/usr/sbin:/usr/bin")
    if program is None:
        pytest.skip("no logrotate: apt-get install logrotate")
    log = tmp_path / "agent.log"
    assert f"`2>> {PLACE}`" in PAGE
    (rules,) = re.findall(rf"(?m)^```text\n({re.escape(PLACE)} \{{\n(?:.*\n)*?\}}\n)```$", PAGE)
    rotation = tmp_path / "rotation"
    rotation.write_text(rules.replace(PLACE, str(log)))
    rotation.chmod(0o644)
    start = ["sh", "-c", f'exec "$@" 2>> {log}', "sh", sys.executable, "-m", "microros_gen", "agent"]
    with running_agent(DOMAIN, *options, program=start) as agent, XrceClient(agent.port) as client:
        client.connect()
        client.ping()
        wait_for(log, "client A1B2C3D4 connected")
        rotate = [program, "--force", "--state", str(tmp_path / "state"), str(rotation)]
        subprocess.run(rotate, check=True, capture_output=True, timeout=seconds(15))
        assert (tmp_path / "agent.log.1.gz").is_file()
        assert log.read_text() == ""
        client.leave()
        assert agent.stop() == 0
        assert wait_for(log, "agent stopped: ")[0] not in "\0\n"
