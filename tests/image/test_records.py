# SPDX-License-Identifier: Apache-2.0
"""What a build folder's records represent, without a build: image, library, and messages if they are not found."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.image.records import RECORDS, locate
from microros_gen.toolchain.archive import read_archive


class BuildFolder:
    """A CMake build folder, with empty files for what CMake would make."""

    def __init__(self, path: Path) -> None:
        self.path = path
        (path / RECORDS).mkdir(parents=True)

    def file(self, name: str) -> Path:
        path = self.path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(b"")
        return path

    def record(self, name: str, config: str = "", **members: str) -> None:
        data = {"version": 1, "config": config, "name": name, "objects": "", **members}
        (self.path / RECORDS / f"{name}-{config}.json").write_text(json.dumps(data))

    def library(self, name: str, config: str = "") -> None:
        out = self.path / f"{name}-microros"
        out.mkdir(exist_ok=True)
        (out / "manifest.json").write_text("{}")
        archive = str(self.path / config / f"lib{name}.a")
        self.record(
            name,
            config,
            kind="library",
            output=str(out),
            archive=archive,
            archiver="ar",
            arguments="--config;a b.yaml",
        )

    def image(self, name: str, library: str, config: str = "") -> None:
        place = self.path / config / name
        self.record(
            name,
            config,
            kind="image",
            library=library,
            image=str(place),
            map=f"{place}.map",
            folders=str(self.path),
        )


@pytest.fixture
def folder(tmp_path: Path) -> BuildFolder:
    folder = BuildFolder(tmp_path / "build")
    folder.library("robot")
    return folder


def refused(*arguments: Path) -> str:
    with pytest.raises(UserError) as error:
        locate(*arguments)
    return str(error.value)


def test_an_image_brings_its_library(folder: BuildFolder) -> None:
    folder.image("app", "robot")
    assert f"{folder.path / 'app'} has not been built yet" in refused(folder.path)
    folder.file("app")
    for path in (folder.path, folder.path / "robot-microros"):
        found = locate(path)
        assert found.library is not None
        assert found.image is not None
        assert found.library.arguments == ("--config", "a b.yaml")
        assert (found.image.image, found.output) == (folder.path / "app", folder.path / "robot-microros")


def test_of_several_images_one_is_named(folder: BuildFolder) -> None:
    for name in ("app", "other"):
        folder.image(name, "robot")
        folder.file(name)
    assert f"Choose one: --image {folder.path / 'app'}, --image {folder.path / 'other'}" in refused(
        folder.path
    )
    found = locate(folder.path, folder.path / "other")
    assert found.image is not None
    assert found.image.map == folder.path / "other.map"


def test_each_configuration_has_a_separate_library(folder: BuildFolder) -> None:
    """Ninja Multi-Config: the image of Release was linked with the library of Release."""
    for config in ("Debug", "Release"):
        folder.library("multi", config)
        folder.image("app", "multi", config)
    (folder.path / RECORDS / "robot-.json").unlink()
    folder.file("Release/app")
    found = locate(folder.path)
    assert found.library is not None
    assert found.library.archive == folder.path / "Release/libmulti.a"


def test_a_library_without_an_image(folder: BuildFolder, tmp_path: Path) -> None:
    assert "librobot.a has not been built yet" in refused(folder.path)
    archive = folder.file("librobot.a")
    assert locate(folder.path).image is None
    assert locate(folder.path, archive).image is None
    elsewhere = tmp_path / "firmware.elf"
    elsewhere.write_bytes(b"")
    found = locate(folder.path, elsewhere)
    assert found.image is not None
    assert (found.output, found.image.map) == (folder.path / "robot-microros", elsewhere.with_suffix(".map"))
    folder.library("second")
    assert "which has several libraries" in refused(folder.path, elsewhere)
    assert "has several libraries and no image" in refused(folder.path)


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", '{"version": 2, "kind": "image"}', "[" * 100_000, '{"version": 1}']
)
def test_a_record_of_another_version(folder: BuildFolder, text: str) -> None:
    (folder.path / RECORDS / "robot-.json").write_text(text)
    assert f"Configure again: cmake {folder.path}" in refused(folder.path)


def test_a_folder_of_build_folders_names_them(folder: BuildFolder) -> None:
    """As colcon's `build` is one."""
    assert f"Give one of {folder.path}" in refused(folder.path.parent)


def member(name: bytes, content: bytes) -> bytes:
    return (
        name.ljust(48) + str(len(content)).encode().ljust(10) + b"`\n" + content + b"\n" * (len(content) % 2)
    )


def test_members_of_an_archive(tmp_path: Path) -> None:
    """Names of GNU, long ones too, and of BSD; `ar` itself is asked in tests/workspace."""
    long_name = b"a_long_name_of_an_object.o"
    parts = [
        member(b"/", b"index"),
        member(b"//", long_name + b"/\n"),
        member(b"short.o/", b"one"),
        member(b"/0", b"two!"),
        member(b"#1/8", b"bsd.o\0\0\0three"),
    ]
    path = tmp_path / "lib.a"
    path.write_bytes(b"!<arch>\n" + b"".join(parts))
    assert [(m.name, m.content) for m in read_archive(path)] == [
        ("short.o", b"one"),
        (long_name.decode(), b"two!"),
        ("bsd.o", b"three"),
    ]
    for end in range(len(path.read_bytes())):
        cut = tmp_path / "cut.a"
        cut.write_bytes(path.read_bytes()[:end])
        assert len(list(read_archive(cut))) <= 3
