# SPDX-License-Identifier: Apache-2.0
"""What every package has: the same bytes each time, an archive of it, its bill of materials, a check."""

from __future__ import annotations

import hashlib
import io
import json
import tarfile
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from microros_gen.package.archive import archive
from microros_gen.package.find import builtin_packages
from microros_gen.package.licenses import Licenses
from microros_gen.package.render import describe, plan_package, render_package
from microros_gen.package.sbom import sbom
from microros_gen.package.view import package_view
from microros_gen.typesupport.plan.file_names import device_in, equal_but_for_case
from tests.support.command_line import Runner
from tests.support.paths import ROOT
from tests.support.slices import first

if TYPE_CHECKING:
    from spdx_tools.spdx.model.document import Document

OWN = "version: 1\nprofiles: [pure_sender]\ntransport: {type: custom}\n"


def rendered(name: str) -> dict[str, bytes]:
    return render_package(plan_package(describe(name), None))


@pytest.mark.parametrize("name", builtin_packages())
def test_the_general_plan_is_the_same_each_time(name: str) -> None:
    first, second = rendered(name), rendered(name)
    assert first == second
    assert first["LICENSE"] == (ROOT / "LICENSE").read_bytes()
    assert not [path for path, content in first.items() if str(ROOT).encode() in content]
    assert list(equal_but_for_case(first)) == []
    assert [path for path in first if device_in(path)] == []
    assert [path for path, content in first.items() if b"\r" in content] == []
    assert all(content.decode("utf-8").endswith("\n") for content in first.values() if content)


def valid(written: Path) -> Document:
    """Return what an SPDX file holds, which is valid. The tools are imported here: they take long, in each process."""
    from spdx_tools.spdx.parser.parse_anything import parse_file
    from spdx_tools.spdx.validation.document_validator import validate_full_spdx_document

    document = parse_file(str(written))
    assert [message.validation_message for message in validate_full_spdx_document(document)] == []
    return document


@pytest.mark.parametrize("name", first(builtin_packages(), 3))
def test_the_bill_of_materials_is_valid(name: str, tmp_path: Path) -> None:
    files = rendered(name)
    written = tmp_path / "sbom.spdx.json"
    written.write_bytes(files["sbom.spdx.json"])
    document = valid(written)
    listed = {
        file.name.removeprefix("./"): {c.algorithm.name: c.value for c in file.checksums}
        for file in document.files
    }
    assert listed.keys() == files.keys() - {"sbom.spdx.json", "manifest.json"}
    for path, digests in listed.items():
        content = files[path]
        assert digests["SHA1"] == hashlib.sha1(content).hexdigest()
        assert digests["SHA256"] == hashlib.sha256(content).hexdigest()
    sums = "".join(sorted(hashlib.sha1(files[path]).hexdigest() for path in listed))
    (library,) = (p for p in document.packages if p.spdx_id == "SPDXRef-library")
    assert library.verification_code is not None
    assert library.verification_code.value == hashlib.sha1(sums.encode()).hexdigest()


OWN_MESSAGES = """\
version: 1
profiles: [pure_sender]
interface_paths: [own_msgs]
nodes: [{name: n, publishers: [{topic: a, type: own_msgs/msg/Own}, {topic: b, type: std_msgs/msg/Int32}]}]
"""


@pytest.mark.parametrize(
    ("element", "expected", "texts"),
    [
        ("<license>BSD-3-Clause</license>", "BSD-3-Clause", {}),
        ("<license file='L'>Apache License 2.0</license><license>MIT</license>", "Apache-2.0 AND MIT", {}),
        (
            "<license>Own &amp; secret</license>",
            "LicenseRef-own-msgs-1",
            {"LicenseRef-own-msgs-1": "Own & secret"},
        ),
        ("<!-- <license>MIT</license> --><license></license>", "NOASSERTION", {}),
        (None, "NOASSERTION", {}),
    ],
)
def test_files_of_messages_have_the_license_of_their_package(
    tmp_path: Path, element: str | None, expected: str, texts: dict[str, str]
) -> None:
    """Not that of the tool, which all other files have."""
    own = tmp_path / "own_msgs"
    (own / "msg").mkdir(parents=True)
    (own / "msg" / "Own.msg").write_text("int32 a\n")
    if element is not None:
        (own / "package.xml").write_text(f"<package format='3'><name>own_msgs</name>{element}</package>\n")
    config = tmp_path / "microros.yaml"
    config.write_text(OWN_MESSAGES)
    files = render_package(plan_package(describe("cmake"), config))
    written = tmp_path / "sbom.spdx.json"
    written.write_bytes(files["sbom.spdx.json"])
    valid(written)
    document = json.loads(files["sbom.spdx.json"])
    concluded = {file["fileName"]: file["licenseConcluded"] for file in document["files"]}
    of_messages = {name for name in concluded if "/own_msgs/" in name}
    assert len(of_messages) == 6
    assert {concluded[name] for name in of_messages} == {expected}
    assert {name for name, found in concluded.items() if found != "Apache-2.0"} == of_messages
    declared = {package["name"]: package["licenseDeclared"] for package in document["packages"]}
    both = (
        expected
        if expected == "NOASSERTION"
        else " AND ".join(sorted({"Apache-2.0", *expected.split(" AND ")}))
    )
    assert (declared["own_msgs"], declared["std_msgs"], declared["microros"]) == (
        expected,
        "Apache-2.0",
        both,
    )
    extracted = document.get("hasExtractedLicensingInfos", [])
    assert {each["licenseId"]: each["extractedText"] for each in extracted} == texts


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"int own(void);\n", "NOASSERTION"),
        (b"/* SPDX-License-Identifier: MIT */\nint own(void);\n", "MIT"),
        (b"/* Generated by microros-gen 0.1.0 */\n", "Apache-2.0"),
    ],
)
def test_a_source_of_somebody_else_has_no_license_of_the_tool(content: bytes, expected: str) -> None:
    plan = plan_package(describe("cmake"), None)
    view = package_view(plan.package, plan.planned, plan.general, {"src/own.c": content})
    document = json.loads(sbom(view, {"src/own.c": content}, Licenses({}, {})))
    assert [file["licenseConcluded"] for file in document["files"]] == [expected]


def test_archives_are_the_same_each_time() -> None:
    files = {"b/two": b"2" * 1000, "one": b"1"}
    again = dict(reversed(files.items()))
    for kind in ("zip", "tar.gz"):
        assert archive(files, "root", kind) == archive(again, "root", kind)
    with zipfile.ZipFile(io.BytesIO(archive(files, "root", "zip"))) as zipped:
        assert {entry.filename: zipped.read(entry) for entry in zipped.infolist()} == {
            f"root/{name}": content for name, content in files.items()
        }
        assert {(entry.date_time, entry.external_attr >> 16) for entry in zipped.infolist()} == {
            ((1980, 1, 1, 0, 0, 0), 0o100644)
        }
    with tarfile.open(fileobj=io.BytesIO(archive(files, "root", "tar.gz"))) as packed:
        members = packed.getmembers()
        assert [member.name for member in members] == ["root/b/two", "root/one"]
        assert {(member.mtime, member.mode, member.uid, member.uname) for member in members} == {
            (0, 0o644, 0, "")
        }


def test_check_reports_what_differs(run: Runner, folder: Path) -> None:
    (folder / "own.yaml").write_text(OWN)
    options = ("-c", "own.yaml")
    assert run("package", "cmake", *options, "-o", "out").status == 0
    check = ("check", "--package", "cmake", *options, "--golden", "out")
    assert (run(*check).status, run(*check).out) == (0, "")
    (folder / "out" / "added.c").write_text("int added;\n")
    changed = folder / "out" / "include" / "rcl" / "rcl.h"
    changed.write_text("/* changed */\n")
    result = run(*check)
    assert result.status == 1
    assert "--- golden/added.c\n+++ /dev/null" in result.out
    assert "-/* changed */" in result.out
    assert run(*check, "--profile", "pure_reader").status == 2


def test_the_ram_of_both_plans_is_printed(run: Runner, folder: Path) -> None:
    (folder / "own.yaml").write_text(OWN)
    general = run("package", "cmake", "-o", "general").out
    own = run("package", "cmake", "-c", "own.yaml", "-o", "own", "--archive").out

    def ram(text: str) -> str:
        return next(line for line in text.splitlines() if line.startswith("RAM"))

    size = ram(general).split()[1]
    assert int(ram(own).split()[1]) < int(size)
    assert ram(own).endswith(f"; the general plan: {size} bytes")
    with tarfile.open(folder / "own.tar.gz") as packed:
        manifest = packed.extractfile("microros/manifest.json")
        assert manifest is not None
        assert json.load(manifest)["package"] == {"name": "cmake", "plan": "application"}


def test_the_archive_of_the_current_folder_is_next_to_it(
    run: Runner, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "own.yaml").write_text(OWN)
    (folder / "robot").mkdir()
    monkeypatch.chdir(folder / "robot")
    done = run("package", "cmake", "-c", "../own.yaml", "-o", ".", "--archive")
    assert (done.status, done.err) == (0, "")
    assert (folder / "robot.tar.gz").is_file()


def test_an_archive_replaces_no_folder(run: Runner, folder: Path) -> None:
    (folder / "robot.tar.gz").mkdir()
    done = run("package", "cmake", "-o", "robot", "--archive")
    assert done.status == 2
    assert "the archive robot.tar.gz is a folder. Choose another output folder with -o" in done.err
    assert not (folder / "robot").exists()


def test_budgets_are_said_not_to_be_checked(run: Runner, folder: Path) -> None:
    """They are those of a compiled library or image, and a package has sources."""
    (folder / "microros.yaml").write_text(OWN + "memory: {flash_budget: 16 KiB}\n")
    result = run("package", "cmake", "-c", "microros.yaml", "-o", "out")
    assert result.status == 0
    assert "the package cmake does not check the budgets of `memory:`" in result.err
    assert "microros.yaml:4" in result.err
    assert "Check them in a build: microros-gen build -c microros.yaml [MG-9210]" in result.err
