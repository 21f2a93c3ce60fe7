# SPDX-License-Identifier: Apache-2.0
"""package.yaml: those that ship hold to the schema, one of the user's is checked with places."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml
from jsonschema import Draft202012Validator

from microros_gen.package.description import SCHEMA
from microros_gen.package.find import builtin_packages
from microros_gen.package.render import describe
from tests.support.command_line import Runner
from tests.support.ids import without_id

OWN = """\
package: mine
summary: A test
library: mine
layout:
  - {from: include/, to: inc/}
  - {from: ""}
"""
PLAN = "version: 1\nprofiles: [pure_sender]\n"


def written(folder: Path, text: str = OWN, plan: str = PLAN) -> Path:
    package = folder / "mine"
    package.mkdir()
    (package / "package.yaml").write_text(text)
    (package / "microros.yaml").write_text(plan)
    return package


@pytest.mark.parametrize("name", builtin_packages())
def test_those_that_ship_hold_to_the_schema(name: str) -> None:
    package = describe(name)
    data = yaml.safe_load((package.folder / "package.yaml").read_text())
    assert not list(Draft202012Validator(json.loads(SCHEMA.read_text())).iter_errors(data))
    assert package.general_plan.is_file()
    assert (package.folder / "files").is_dir()


def test_an_unknown_one_is_refused(run: Runner) -> None:
    result = run("package", "cmakee", "-o", "out")
    assert result.status == 2
    assert without_id(result.err) == "microros-gen: error: unknown package 'cmakee'. Did you mean 'cmake'?\n"


def test_the_list_has_all_of_them(run: Runner) -> None:
    result = run("package", "--list")
    assert [line.split()[0] for line in result.out.splitlines()] == list(builtin_packages())


def test_one_of_them_is_listed(run: Runner, folder: Path) -> None:
    """By its name or folder; before, a name was ignored, and all were listed."""
    written(folder)
    for name in ("cmake", "./mine"):
        result = run("package", "--list", name)
        assert result.status == 0
        assert len(result.out.splitlines()) == 1
        assert run("package", name, "--list").out == result.out
    assert run("package", "--list", "cmake").out in run("package", "--list").out
    assert "unknown package 'cmakee'" in run("package", "--list", "cmakee").err


@pytest.mark.parametrize("words", [(), ("cmake",)])
def test_name_and_folder_are_needed_otherwise(run: Runner, words: tuple[str, ...]) -> None:
    result = run("package", *words)
    assert result.status == 2
    assert ("Missing option '-o' / '--output'." if words else "Missing argument 'NAME'.") in result.err


def test_a_folder_is_a_package(run: Runner, folder: Path) -> None:
    package = written(folder)
    (package / "files").mkdir()
    (package / "files" / "note.txt.j2").write_text("{{ view.library }} of {{ view.plan }}\n")
    assert run("package", "./mine", "-o", "out").status == 0
    out = folder / "out"
    assert (out / "note.txt").read_text() == "mine of pure_sender\n"
    assert {path.name for path in out.iterdir()} == {
        "LICENSE",
        "inc",
        "manifest.json",
        "note.txt",
        "sbom.spdx.json",
    }
    manifest = json.loads((out / "manifest.json").read_text())
    assert manifest["package"] == {"from": "folder mine", "name": "mine", "plan": "general"}
    assert "package mine/files/note.txt.j2" in manifest["inputs"]


def test_a_folder_without_a_description_is_refused(run: Runner, folder: Path) -> None:
    (folder / "mine").mkdir()
    result = run("package", "./mine", "-o", "out")
    assert result.status == 2
    assert "cannot read 'mine/package.yaml': No such file or directory" in result.err


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        (OWN + "more: 1\n", "7:1", "unknown key 'more'"),
        (OWN.replace("library: mine\n", ""), "1:1", "missing key 'library' in the file"),
        (
            OWN.replace("package: mine", "package: other"),
            "1:10",
            "the folder of the package 'other' has another name",
        ),
        (OWN + "archive: rar\n", "7:10", "'archive' must be zip or tar.gz; it is the text 'rar'"),
    ],
)
def test_faults_have_places(run: Runner, folder: Path, text: str, place: str, message: str) -> None:
    written(folder, text)
    result = run("package", "./mine", "-o", "out")
    assert result.status == 2
    assert f"mine/package.yaml:{place}: error: {message}" in result.err


def test_a_file_without_a_place_is_refused(run: Runner, folder: Path) -> None:
    written(folder, OWN.replace('  - {from: ""}\n', "  - {from: src/, to: src/}\n"))
    result = run("package", "./mine", "-o", "out")
    assert result.status == 2
    assert "the package mine has no place for 'examples/pure_sender/main.c'" in result.err
    assert "Add `- {from: examples/pure_sender/main.c, to: …}` to `layout`" in result.err


def test_two_files_in_one_place_are_refused(run: Runner, folder: Path) -> None:
    package = written(folder)
    (package / "files" / "inc" / "rcl").mkdir(parents=True)
    (package / "files" / "inc" / "rcl" / "rcl.h").write_text("")
    result = run("package", "./mine", "-o", "out")
    assert result.status == 2
    assert "two files of the package mine have the place 'inc/rcl/rcl.h'" in result.err


def test_a_transport_that_it_does_not_have_is_refused(run: Runner, folder: Path) -> None:
    written(folder, OWN + "transports: [custom]\n", PLAN + "transport: {type: custom}\n")
    (folder / "microros.yaml").write_text(PLAN + "transport: {type: tcp}\n")
    result = run("package", "./mine", "-c", "microros.yaml", "-o", "out")
    assert result.status == 2
    assert "microros.yaml:3:19: error: the package mine has no transport 'tcp', only custom" in result.err
    assert "Write `transport: {type: custom}`" in result.err


@pytest.mark.parametrize("package", ["arduino", "esp-idf"])
def test_a_serial_line_of_a_package_is_custom(run: Runner, folder: Path, package: str) -> None:
    """The fault alone is reported: functions of the refused transport are not asked for."""
    (folder / "microros.yaml").write_text(PLAN + "transport: {type: serial}\n")
    result = run("package", package, "-c", "microros.yaml", "-o", "out")
    assert result.status == 2
    assert f"has no transport 'serial', only {', '.join(describe(package).transports)}" in result.err
    assert "Write `transport: {type: custom}`" in result.err
    assert "port_serial" not in result.err


def test_hints_name_no_target_file_of_a_package(run: Runner, folder: Path) -> None:
    """Users do not change it."""
    (folder / "microros.yaml").write_text(PLAN + "components: [+multithread]\n")
    result = run("package", "arduino", "-c", "microros.yaml", "-o", "out")
    assert result.status == 0
    assert "no unique id. Give each board its own key: `session: {key: 0x" in result.err
    assert "Define the functions below in your application [MG-7015]\nvoid port_lock(void);" in result.err
    assert "target file" not in result.err


def test_a_target_without_effect_is_a_warning(run: Runner, folder: Path) -> None:
    package = written(folder)
    (package / "target.yaml").write_text("target: mine\nsummary: A test\nextends: host\ndata_model: any\n")
    (folder / "microros.yaml").write_text(PLAN + "target: {name: cortex-m3}\n")
    result = run("package", "./mine", "-c", "microros.yaml", "-o", "out")
    assert result.status == 0
    assert "the target of the application file has no effect: the package mine has its own" in result.err
    assert json.loads((folder / "out" / "manifest.json").read_text())["target"] == "mine"


def test_conditions_choose_files(run: Runner, folder: Path) -> None:
    text = OWN + (
        "files:\n"
        "  only/general: {when: {package.general: true}}\n"
        "  only/executor: {when: {component.executor: true}}\n"
        "  only/int32: {when: {type.std_msgs/msg/Int32: true}}\n"
    )
    package = written(folder, text)
    (package / "files" / "only").mkdir(parents=True)
    for name in ("general", "executor", "int32"):
        (package / "files" / "only" / f"{name}.txt").write_text(f"{name}\n")
    (folder / "own.yaml").write_text("version: 1\nprofiles: [pure_reader]\ninterfaces: [std_msgs/msg/Bool]\n")

    def found(*options: str) -> set[str]:
        assert run("package", "./mine", *options, "-o", "out").status == 0
        return {path.stem for path in (folder / "out" / "only").iterdir()}

    assert found() == {"general", "int32"}
    assert found("-c", "own.yaml") == {"executor"}


def test_files_of_another_package_are_taken_over(run: Runner, folder: Path) -> None:
    package = written(folder, OWN + "files_of: cmake\n")
    (package / "files").mkdir()
    (package / "files" / "README.md").write_text("mine\n")
    result = run("package", "./mine", "-o", "out")
    assert result.status == 0, result.err
    assert (folder / "out" / "README.md").read_text() == "mine\n"
    assert "add_library(microros STATIC" in (folder / "out" / "CMakeLists.txt").read_text()


def test_files_of_an_unknown_package_are_refused(run: Runner, folder: Path) -> None:
    written(folder, OWN + "files_of: cmakee\n")
    result = run("package", "./mine", "-o", "out")
    assert result.status == 2
    assert "mine/package.yaml:7:11: error: unknown package 'cmakee'. Did you mean 'cmake'?" in without_id(
        result.err
    )
