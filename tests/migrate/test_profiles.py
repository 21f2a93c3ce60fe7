# SPDX-License-Identifier: Apache-2.0
"""`init --profile`: every profile and target gives a folder whose code compiles and agrees with its golden copy."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from microros_gen.cli import main as cli
from microros_gen.diagnostics import Diagnostics
from microros_gen.migrate.proposal import InitOptions
from microros_gen.platform.find import builtin_targets, read_target
from microros_gen.toolchain.toolchain import WARNINGS
from tests.support.ids import without_id
from tests.support.migrate.profiles import READY
from tests.support.migrate.proposals import Init, application_in, entities_of

pytestmark = pytest.mark.builds

FILES = {
    "microros.schema.json",
    "microros.yaml",
    "main.c",
    "README.md",
    "CMakeLists.txt",
    ".gitignore",
}
WORKFLOW = ".github/workflows/microros.yml"


def compiles(folder: Path, target: str = "host") -> None:
    """Compile main.c of a new folder with the headers of its golden copy."""
    found = read_target(target, Path(), None, Diagnostics())
    assert found is not None
    command = [found.target.compilers[0], *found.target.c_flags, *WARNINGS, "-fsyntax-only"]
    done = subprocess.run(
        [*command, f"-I{folder / 'golden/include'}", str(folder / "main.c")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def own_files(folder: Path) -> set[str]:
    paths = (path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
    return {path for path in paths if not path.startswith("golden/")}


@pytest.mark.parametrize("profile", READY)
def test_a_profile_for_this_machine(profile: str, init: Init, tmp_path: Path) -> None:
    status, _, err = init("My-Robot 2", "--profile", profile, "--ci")
    assert (status, err) == (0, "")
    folder = tmp_path / "My-Robot 2"
    assert own_files(folder) == FILES | {WORKFLOW}
    application = application_in(folder / "microros.yaml")
    assert [p.name for p in application.profiles] == [profile]
    assert ("node", "my_robot_2", "/", "0") in entities_of(application)
    compiles(folder)
    with pytest.raises(SystemExit) as end:  # what the workflow runs
        cli.main(["check", "-c", str(folder / "microros.yaml"), "--golden", str(folder / "golden")])
    assert end.value.code == 0


# A processor without a board, and a board of each family; the long run has all.
SOME = ("cortex-m4", "qemu-microbit", "qemu-riscv32-virt")


@pytest.mark.parametrize(
    "target", [t if t in SOME else pytest.param(t, marks=pytest.mark.long) for t in builtin_targets()]
)
def test_a_folder_for_each_target(target: str, init: Init, tmp_path: Path) -> None:
    status, _, err = init(
        "firmware", "--profile", "pure_sender", "--profile", "pure_reader", "--target", target, "--ci"
    )
    assert status == 0
    warnings = [line for line in err.splitlines() if "microros.yaml" in line]
    assert all("unique id" in line or "provides no serial" in line for line in warnings), err
    folder = tmp_path / "firmware"
    assert own_files(folder) - {"toolchain.cmake"} == FILES | {WORKFLOW}
    assert (folder / "toolchain.cmake").exists() == (target != "host")
    kinds = {entity[0] for entity in entities_of(application_in(folder / "microros.yaml"))}
    assert kinds == {"node", "publisher", "subscription"}
    compiles(folder, target)


def test_profiles_and_targets_of_the_users_own_are_named_from_the_folder(init: Init, tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text("profile: mine\nsummary: My own\ncomponents: [node, publish]\n")
    (tmp_path / "board.yaml").write_text("target: board\nsummary: A board\nextends: cortex-m4\n")
    status, _, err = init("deep/app", "--profile", "mine.yaml", "--target", "board.yaml")
    assert status == 0
    assert "error" not in err
    application = application_in(tmp_path / "deep/app/microros.yaml")
    assert [p.name for p in application.profiles] == ["../../mine.yaml"]
    assert application.target.name == "../../board.yaml"


def test_nothing_is_overwritten(init: Init, tmp_path: Path) -> None:
    (tmp_path / "app").mkdir()
    (tmp_path / "app/README.md").write_text("mine")
    (tmp_path / "app/notes.txt").write_text("mine too")
    status, _, err = init("app")
    assert status == 2
    assert (
        "error: app already has files that would be written: README.md. Name a new folder, or move them away"
        in err
    )
    assert own_files(tmp_path / "app") == {"README.md", "notes.txt"}
    (tmp_path / "app/README.md").unlink()
    assert init("app")[0] == 0
    assert (tmp_path / "app/notes.txt").read_text() == "mine too"
    status, _, err = init("app")
    assert status == 2
    assert "app already has files that would be written: .gitignore, CMakeLists.txt," in err


def test_a_file_is_no_folder(init: Init, tmp_path: Path) -> None:
    (tmp_path / "app").write_text("")
    warnings = "microros-gen: error: cannot create the folder app: File exists. Name a new folder\n"
    assert without_id(init("app")[2]) == warnings


@pytest.mark.parametrize(("folder", "name"), [("a", "a"), ("42", "app_42"), ("Über", "ber"), ("x__y", "x_y")])
def test_the_name_of_the_folder_becomes_a_name(folder: str, name: str) -> None:
    assert InitOptions(Path("deep") / folder, (), None, None, (), ()).name == name
