# SPDX-License-Identifier: Apache-2.0
"""The example with a profile of the user's own, built once with each generator."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.e2e.relay import Relay
from tests.support.installed import Installed, install_wheel
from tests.support.workspace.projects import EXAMPLE, Project, copy_of_tool, follow_page, replace

PROGRAMS = ("cmake", "ninja", "make")
PROFILE = """\
profile: mine
summary: What the wheels need
extends: [pure_sender]
components: [+timers]
"""


@pytest.fixture(scope="session", autouse=True)
def programs() -> None:
    """Skip what needs a program that is not there; `make test` installs them."""
    missing = [name for name in PROGRAMS if shutil.which(name) is None]
    if missing:
        pytest.skip(f"no {', '.join(missing)}")


@pytest.fixture(scope="session")
def tool(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the tool, which a test may change."""
    return copy_of_tool(tmp_path_factory.mktemp("tool") / "a clone")


@pytest.fixture(scope="session")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Installed:
    """The wheel of this repository in a separate environment, made once in a process."""
    return install_wheel(tmp_path_factory.mktemp("package"))


@pytest.fixture(scope="session")
def relay() -> Iterator[Relay]:
    """Keeps the port that the example is built for."""
    with Relay() as running:
        yield running


@pytest.fixture(scope="session", params=["ninja", pytest.param("make", marks=pytest.mark.long)])
def project(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, tool: Path, relay: Relay
) -> Project:
    """The example as it is after a first build."""
    home = tmp_path_factory.mktemp("project") / "an application"
    shutil.copytree(EXAMPLE, home)
    (home / "mine.yaml").write_text(PROFILE)
    replace(home / "microros.yaml", "[pure_sender]\ncomponents: [+timers]\n", "[mine.yaml]\n")
    replace(
        home / "CMakeLists.txt", "CONFIG microros.yaml", f"CONFIG microros.yaml AGENT 127.0.0.1:{relay.port}"
    )
    project = Project(home, request.param, tool)
    configured = project.configure()
    assert configured.returncode == 0, configured.stderr
    assert {"robot-microros-build/librobot.a", "app", "app.c"} < project.rebuilt()
    return project


@pytest.fixture(scope="session")
def board(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The example for a Cortex-M4, by the commands of docs/howto/cmake.md."""
    if shutil.which("arm-none-eabi-gcc") is None:
        pytest.skip("no arm-none-eabi-gcc")
    return follow_page(tmp_path_factory.mktemp("board"), "build/app_m4")
