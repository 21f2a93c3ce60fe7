# SPDX-License-Identifier: Apache-2.0
"""`interfaces --format idl` and json: against rosidl_parser, the .json of ROS 2 and the compiler of Cyclone DDS."""

from __future__ import annotations

import contextlib
import io
import json
import sys
from pathlib import Path

import click
import pytest
from click.testing import CliRunner, Result

from microros_gen.cli.interfaces import command
from microros_gen.diagnostics import UserError
from tests.support.examples import some
from tests.support.interfaces.idl_compiler import IdlCompiler, idl_compiler
from tests.support.interfaces.rosidl_idl_pipeline import RosIdl, ros_idl

pytestmark = pytest.mark.builds

SHARE = Path(sys.prefix) / "share"
KINDS = ("msg", "srv", "action")
FIRST_FORMS = sorted(p for kind in KINDS for p in SHARE.glob(f"*/{kind}/*.{kind}"))


def run(*arguments: str) -> Result:
    return CliRunner().invoke(command, list(arguments), catch_exceptions=True)


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the .idl files of everything that ROS 2 installs, as ROS 2 writes them."""
    folder = tmp_path_factory.mktemp("idl")
    assert run("--format", "idl", "-o", str(folder)).exit_code == 0
    return folder


def installed_idl(path: Path, folder: Path) -> str:
    """Return the .idl text that ROS 2 installs with an interface file, or generates from it if it installs none."""
    idl = path.with_suffix(".idl")
    if idl.exists():
        return idl.read_text(encoding="utf-8")
    from rosidl_adapter import convert_to_idl

    package, relative = path.parent.parent, path.relative_to(path.parent.parent)
    with contextlib.redirect_stdout(io.StringIO()):
        convert_to_idl(package, package.name, relative, folder)
    return (folder / path.parent.name / f"{path.stem}.idl").read_text(encoding="utf-8")


def to_rosidl(text: str, name: Path, folder: Path) -> RosIdl:
    seen = ros_idl(text, folder, name.parent.name, name.stem)
    assert seen is not None, name
    return seen


def check_equal(paths: list[Path], tree: Path, tmp_path: Path) -> None:
    for path in paths:
        name = path.relative_to(SHARE)
        ours = (tree / name.with_suffix(".idl")).read_text(encoding="utf-8")
        theirs = installed_idl(path, tmp_path)
        assert to_rosidl(ours, name, tmp_path) == to_rosidl(theirs, name, tmp_path), name


@pytest.mark.ros
@pytest.mark.examples
def test_rosidl_reads_in_a_slice_what_it_reads_in_its_own(tree: Path, tmp_path: Path) -> None:
    check_equal(list(some(FIRST_FORMS[::40], 2)), tree, tmp_path)


@pytest.mark.ros
@pytest.mark.long
def test_rosidl_reads_in_every_file_what_it_reads_in_its_own(tree: Path, tmp_path: Path) -> None:
    assert len(FIRST_FORMS) == 215
    check_equal(FIRST_FORMS, tree, tmp_path)


@pytest.mark.ros
def test_the_files_are_interfaces_with_the_hashes_of_ros(tree: Path) -> None:
    """The tool reads the tree as packages, with nothing else in sight of them, and hashes as ROS 2 does."""
    compared = 0
    for package in sorted(
        {path.parent.parent.name for path in FIRST_FORMS if path.with_suffix(".json").exists()}
    ):
        listed = run(package, "--format", "json", "--interface-path", str(tree))
        data = json.loads(listed.stdout)
        assert data["origin"] == "path"
        for entry in data["types"]:
            expected = json.loads((SHARE / f"{entry['type']}.json").read_text(encoding="utf-8"))
            assert entry["hash"] == expected["type_hashes"][0]["hash_string"], entry["type"]
            compared += 1
    assert compared == 199


@pytest.mark.ros
def test_descriptions_are_the_files_of_ros(tmp_path: Path) -> None:
    assert run("--format", "json", "-o", str(tmp_path)).exit_code == 0
    installed = [path for kind in KINDS for path in SHARE.glob(f"*/{kind}/*.json")]
    assert len(installed) == 199
    for path in installed:
        assert (tmp_path / path.relative_to(SHARE)).read_bytes() == path.read_bytes(), path


@pytest.fixture(scope="module")
def compiler(tmp_path_factory: pytest.TempPathFactory) -> IdlCompiler:
    if sys.version_info >= (3, 14):
        pytest.skip("Cyclone DDS has no wheel for this Python")
    return idl_compiler(tmp_path_factory.mktemp("idlc"))


@pytest.fixture(scope="module")
def portable(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("portable")
    assert run("--format", "idl", "--portable", "-o", str(folder)).exit_code == 0
    return folder


NAMES = [path.relative_to(SHARE).with_suffix(".idl") for path in FIRST_FORMS]


@pytest.mark.ros
def test_a_vendors_compiler_takes_the_whole_tree(compiler: IdlCompiler, portable: Path) -> None:
    """All files in one, so that no two of them disturb each other."""
    assert len(NAMES) == 215
    everything = portable / "everything.idl"
    everything.write_text("".join(f'#include "{name.as_posix()}"\n' for name in NAMES), encoding="utf-8")
    assert compiler.refusal(everything, portable) == ""


@pytest.mark.ros
@pytest.mark.long
def test_a_vendors_compiler_takes_each_file_by_itself(compiler: IdlCompiler, portable: Path) -> None:
    refused = {name: reason for name in NAMES if (reason := compiler.refusal(portable / name, portable))}
    assert refused == {}


@pytest.mark.ros
def test_the_compiler_refuses_what_is_wrong(compiler: IdlCompiler, portable: Path, tmp_path: Path) -> None:
    text = (portable / "sensor_msgs/msg/Imu.idl").read_text(encoding="utf-8")
    wrong = tmp_path / "Imu.idl"
    wrong.write_text(text.replace("std_msgs::msg::Header", "std_msgs::msg::Footer"), encoding="utf-8")
    assert "std_msgs::msg::Footer" in compiler.refusal(wrong, portable)
    wrong.write_text(text, encoding="utf-8")
    assert "std_msgs/msg/Header.idl" in compiler.refusal(wrong, tmp_path)


@pytest.mark.ros
def test_the_warning_names_what_the_compiler_refuses(compiler: IdlCompiler, tree: Path) -> None:
    name = "test_msgs/action/Fibonacci"
    assert "syntax error" in compiler.refusal(tree / f"{name}.idl", tree)
    done = run(name, "--format", "idl")
    assert done.stderr.startswith(f"microros-gen: warning: {name}: sequence is a keyword of IDL; ")
    assert "  sequence<int32> sequence;" in done.stdout
    done = run(name, "--format", "idl", "--portable")
    assert done.stderr == ""
    assert "  sequence<int32> _sequence;" in done.stdout
    assert done.stdout.startswith("#ifndef TEST_MSGS__ACTION__FIBONACCI_IDL\n")


def test_a_tree_has_what_it_includes_and_no_more(tmp_path: Path) -> None:
    arguments = ("sensor_msgs/Imu", "--format", "idl", "-o", str(tmp_path))
    assert run(*arguments).stdout == f"{tmp_path}: 5 files written, 0 unchanged\n"
    files = sorted(path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*.idl"))
    assert files == [
        "builtin_interfaces/msg/Time.idl",
        "geometry_msgs/msg/Quaternion.idl",
        "geometry_msgs/msg/Vector3.idl",
        "sensor_msgs/msg/Imu.idl",
        "std_msgs/msg/Header.idl",
    ]
    assert run(*arguments).stdout == f"{tmp_path}: 0 files written, 5 unchanged\n"


def test_a_derived_type_is_in_the_file_of_its_service() -> None:
    assert (
        run("std_srvs/srv/SetBool_Event", "--format", "idl").stdout
        == run("std_srvs/SetBool", "--format", "idl").stdout
    )


def test_several_interfaces_need_a_folder() -> None:
    done = run("std_srvs", "--format", "idl")
    assert isinstance(done.exception, UserError)
    assert "found 3 interfaces, but an .idl file holds one. Name one of them, or" in str(done.exception)


@pytest.mark.parametrize("arguments", [["-o", "x"], ["std_msgs/Int32", "--portable"]])
def test_options_that_do_not_fit_are_refused(arguments: list[str]) -> None:
    done = run(*arguments)
    assert done.exit_code == click.UsageError.exit_code
    assert "add --format idl" in done.output
