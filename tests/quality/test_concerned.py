# SPDX-License-Identifier: Apache-2.0
"""`make quick` runs the unit tests that a change concerns, and all where it cannot tell."""

from __future__ import annotations

import pytest

from tests.support.paths import PACKAGE, TESTS
from tests.tools.concerned import READERS, concerned, imports, users
from tests.tools.run_suite import UNITS

IMPORTED = imports()


@pytest.mark.parametrize(
    ("path", "runs", "leaves"),
    [
        (
            "microros_gen/selection/resolve.py",
            {"selection", "client", "compiler", "cli"},
            {"interfaces", "agent"},
        ),
        ("microros_gen/agent/core.py", {"agent", "cli"}, {"selection", "interfaces", "client"}),
        ("microros_gen/diagnostics/source.py", {"agent", "interfaces", "cli", "ros"}, {"docs"}),
        ("microros_gen/components/ping/src/ping.c", {"client", "compiler"}, {"agent", "cli", "interfaces"}),
        ("microros_gen/templates/types/a.c.j2", {"typesupport", "compiler"}, {"agent", "cli"}),
        ("docs/howto/agent.md", {"docs"}, {"agent", "cli"}),
        ("tests/agent/test_core.py", {"agent"}, {"cli"}),
        ("tests/support/agent/fakes.py", {"agent"}, {"cli"}),
        ("profiles/pure_sender.yaml", {"selection"}, {"agent"}),
    ],
)
def test_what_a_file_concerns(path: str, runs: set[str], leaves: set[str]) -> None:
    found = set(concerned([path], IMPORTED, UNITS))
    assert runs | {"quality"} <= found
    assert not leaves & found


@pytest.mark.parametrize(
    "path", ["pyproject.toml", "tests/conftest.py", "tests/support/trees.py", "microros_gen/records.py"]
)
def test_what_concerns_everything(path: str) -> None:
    assert concerned(["docs/index.md", path], IMPORTED, UNITS) == UNITS


def test_a_change_of_two_files_concerns_what_each_of_them_does() -> None:
    assert concerned(["docs/index.md", "tests/ros/test_codec.py"], IMPORTED, UNITS) == (
        "ros",
        "quality",
        "docs",
    )


def test_every_package_is_known() -> None:
    """A folder without Python that is not in READERS would concern its own tests alone, which it does not have."""
    folders = {path.name for path in PACKAGE.iterdir() if path.is_dir() and path.name != "__pycache__"}
    assert not {name for name in folders - set(READERS) if not (TESTS / name).is_dir()}
    assert users("documents", IMPORTED) >= {"documents", "application", "selection", "cli"}
