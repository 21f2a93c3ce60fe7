# SPDX-License-Identifier: Apache-2.0
"""What a build compiles after a change: only what depends on it, according to the compiler's dependency files."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.support.workspace.projects import IDLE, Project, replace

LINKED = frozenset({"robot-microros-build/librobot.a", "app"})
OF_MESSAGE = {
    "src/robot_msgs/wheel_speeds__functions.c",
    "src/robot_msgs/wheel_speeds__type_support.c",
    "app.c",
}


def rebuilt_after(project: Project, path: Path, old: str, new: str) -> frozenset[str]:
    """Change a file and build; check what that made against the compiler's notes, and that nothing is left to do."""
    before = project.contents()
    replace(path, old, new)
    rebuilt = project.rebuilt()
    after = project.contents()
    changed = frozenset(path for path, content in after.items() if before.get(path) != content)
    assert rebuilt - LINKED == project.users_of(changed)
    assert rebuilt.isdisjoint(LINKED) or rebuilt >= LINKED
    again = project.build()
    assert IDLE[project.generator] in again.stdout
    assert "Building" not in again.stdout
    return rebuilt


def test_an_unchanged_project_has_nothing_to_do(project: Project) -> None:
    assert project.rebuilt() == frozenset()
    done = project.build()
    assert IDLE[project.generator] in done.stdout
    assert "Re-running CMake" not in done.stdout


@pytest.mark.system
def test_a_message_compiles_what_uses_it(project: Project) -> None:
    message = project.source / "interfaces/robot_msgs/msg/WheelSpeeds.msg"
    rebuilt = rebuilt_after(project, message, "float32 left", "uint8 WHEELS=2\nfloat32 left")
    assert rebuilt == LINKED | OF_MESSAGE | {"src/memory/message_pools.c"}  # blocks for what is sent of it


@pytest.mark.long
def test_an_application_file_compiles_what_its_plan_is_in(project: Project) -> None:
    rebuilt = rebuilt_after(project, project.source / "microros.yaml", "100 ms", "200 ms")
    assert {"src/support/microros_plan.c", "app.c"} < rebuilt
    assert not [name for name in rebuilt if name.startswith(("src/cdr/", "src/std_msgs/"))]


@pytest.mark.system
def test_a_profile_of_the_users_compiles_what_it_adds(project: Project) -> None:
    added = "src/session_state/rmw_session_state.c"
    rebuilt = rebuilt_after(project, project.source / "mine.yaml", "[+timers]", "[+timers, +session_state]")
    assert added in rebuilt
    assert "src/rosidl_runtime/string.c" not in rebuilt


def test_the_tool_itself_compiles_what_it_writes_otherwise(project: Project) -> None:
    template = project.tool / "microros_gen/components/publish/src/rclc_publisher.c"
    rebuilt = rebuilt_after(project, template, "#include", "/* another version of the tool */\n#include")
    assert rebuilt == LINKED | {"src/publish/rclc_publisher.c"}


def test_what_the_output_does_not_depend_on_compiles_nothing(project: Project) -> None:
    """A comment in the application file makes the tool run again; its manifest alone is written."""
    manifest = (project.out / "manifest.json").stat().st_mtime_ns
    assert (
        rebuilt_after(project, project.source / "microros.yaml", "version: 1", "version: 1 # mine")
        == frozenset()
    )
    assert (project.out / "manifest.json").stat().st_mtime_ns != manifest


@pytest.mark.long
def test_a_deleted_output_folder_is_written_again(project: Project) -> None:
    shutil.rmtree(project.out)
    rebuilt = project.rebuilt()
    assert {"app", "app.c"} < rebuilt
