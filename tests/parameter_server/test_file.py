# SPDX-License-Identifier: Apache-2.0
"""The file: it is read as it was written, whatever becomes of it."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.parameter_server.declared import Declared
from microros_gen.parameter_server.file import ParameterFile
from microros_gen.parameter_server.node import Held, HeldNode
from microros_gen.parameter_server.values import TYPE_NAMES, ParameterValue

VALUES = (None, True, -(2**63), 2.5, "ä", b"\0\xff", [True], [1, 2], [0.5, float("inf")], ["a", ""])


def node(name: str) -> HeldNode:
    return HeldNode(name, lambda: 5.0, lambda line: None)


def full() -> HeldNode:
    created = node("/ns/arm")
    for kind, value in enumerate(VALUES[1:], 1):
        declared = Declared(f"p{kind}", kind, "what", "how", kind == 1, kind == 2)
        created.parameters[declared.name] = Held(declared, ParameterValue(kind, value), 1.5 * kind, kind == 3)
    created.parameters["gain"] = Held(
        Declared("gain", 3, range=(0.0, 1.0, 0.5), size_max=0), ParameterValue(3, 0.5), 7.0
    )
    created.parameters["mode"] = Held(Declared("mode", 2, one_of=(1, 2)), ParameterValue(2, 1), 7.0)
    created.aside["old"] = [ParameterValue(2, 1), ParameterValue(4, "x")]
    return created


@pytest.fixture
def file(tmp_path: Path) -> ParameterFile:
    return ParameterFile(tmp_path / "deep/p.json")


def test_what_was_written_is_read(file: ParameterFile) -> None:
    assert file.load(node) == ((), "")
    file.save([full(), node("/empty")])
    nodes, damage = file.load(node)
    assert damage == ""
    read, empty = nodes
    assert (read.name, read.parameters, read.aside) == ("/ns/arm", full().parameters, full().aside)
    assert (empty.name, empty.parameters) == ("/empty", {})
    assert len(TYPE_NAMES) == len(VALUES)


def test_every_damage_is_reported_and_kept(file: ParameterFile) -> None:
    file.save([full()])
    data = file.path.read_bytes()
    for number, size in enumerate((0, 1, len(data) // 2, len(data) - 3), 1):
        file.path.write_bytes(data[:size])
        nodes, damage = file.load(node)
        assert nodes == ()
        assert "is damaged (" in damage
        assert f"it is kept as 'p.json.damaged-{number}'" in damage
        assert file.path.with_name(f"p.json.damaged-{number}").read_bytes() == data[:size]
        assert not file.path.exists()


CHANGES: dict[str, Callable[[dict[str, object]], object]] = {
    "type": lambda p: p.update(type="float"),
    "value": lambda p: p.update(value="text"),
    "none": lambda p: p.pop("value"),
    "time": lambda p: p.update(written="now"),
    "pending": lambda p: p.update(pending=1),
    "range": lambda p: p.update(range=[1, 2]),
    "text": lambda p: p.update(description=5),
    "half a character": lambda p: p.update(description="\ud800"),
    "half a character of a value": lambda p: p.update(type="string", value="\ud800"),
    "above a double": lambda p: p.update(type="double", value=10**400),
    "endless integers": lambda p: p.update(declared="integer", range=[float("-inf"), 1, 0]),
    "values of another type": lambda p: p.update(one_of=["text"]),
    "a time above a double": lambda p: p.update(written=10**400),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_wrong_member_is_damage(file: ParameterFile, change: str) -> None:
    file.save([full()])
    tree = json.loads(file.path.read_bytes())
    CHANGES[change](tree["nodes"]["/ns/arm"]["parameters"]["gain"])
    file.path.write_text(json.dumps(tree), encoding="utf-8")
    nodes, damage = file.load(node)
    assert nodes == ()
    assert "is damaged" in damage


@pytest.mark.parametrize("name", ["arm", "/", "/a b", "/a//b", "/1", "/a/"])
def test_a_wrong_name_of_a_node_is_damage(file: ParameterFile, name: str) -> None:
    """The other nodes would have no server: it cannot offer services with that name."""
    file.save([full(), node(name)])
    assert "is no node" in file.load(node)[1]


def test_lists_without_an_end_are_damage(file: ParameterFile) -> None:
    file.path.write_text("[" * 100_000, encoding="utf-8")
    assert "is damaged" in file.load(node)[1]


def test_a_damaged_file_that_cannot_be_renamed(file: ParameterFile, monkeypatch: pytest.MonkeyPatch) -> None:
    file.path.write_text("{", encoding="utf-8")

    def fail(path: Path, target: Path) -> None:
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr(Path, "replace", fail)
    with pytest.raises(UserError, match="is damaged and cannot be renamed: Read-only file system"):
        file.load(node)
    assert file.path.read_text(encoding="utf-8") == "{"


def test_a_later_version_is_left_alone(file: ParameterFile) -> None:
    file.save([full()])
    text = file.path.read_text(encoding="utf-8").replace('"version": 1', '"version": 2')
    file.path.write_text(text, encoding="utf-8")
    with pytest.raises(UserError) as caught:
        file.load(node)
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.message == f"'{file.path}' is of version 2; this program knows 1"
    assert diagnostic.hint == "Use a later microros-gen, or name another file"
    assert file.path.read_text(encoding="utf-8") == text


def test_one_server_has_a_file(file: ParameterFile) -> None:
    with pytest.raises(UserError, match="another parameter server uses"):
        ParameterFile(file.path)
    file.close()
    ParameterFile(file.path).close()


def test_a_write_that_fails_leaves_the_file(file: ParameterFile, monkeypatch: pytest.MonkeyPatch) -> None:
    file.save([full()])
    before = file.path.read_bytes()

    def fail(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fail)
    with pytest.raises(OSError, match="No space"):
        file.save([node("/other")])
    assert file.path.read_bytes() == before


def test_a_folder_that_is_a_file(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("", encoding="utf-8")
    with pytest.raises(UserError, match="cannot be written"):
        ParameterFile(tmp_path / "a/b.json")
    (tmp_path / "c.json").mkdir()
    with pytest.raises(UserError, match="cannot be read: Is a directory"):
        ParameterFile(tmp_path / "c.json").load(node)
