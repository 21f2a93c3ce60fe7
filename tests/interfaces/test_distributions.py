# SPDX-License-Identifier: Apache-2.0
"""The included interfaces are those of each distribution that an application can be for."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from microros_gen.application.model import DISTRIBUTIONS
from microros_gen.application.parser import SCHEMA
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.interfaces.interface_set import InterfaceSet
from microros_gen.interfaces.types import Constant, Field, Message, TypeName
from tests.support.command_line import Runner
from tests.tools.record_hashes import RECORDED, download, hashes

FINDER = InterfaceFinder(shipped=shipped_folder())


def closed(finder: InterfaceFinder, packages: set[str]) -> InterfaceSet:
    diagnostics = Diagnostics()
    found = resolve_interfaces(tuple(Named(name) for name in sorted(packages)), finder, diagnostics)
    diagnostics.check()
    return found


@pytest.fixture(scope="module")
def shipped() -> InterfaceSet:
    return closed(FINDER, {place.name for place in FINDER.packages()})


def test_the_schema_says_the_same() -> None:
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    assert schema["properties"]["distro"]["enum"] == list(DISTRIBUTIONS)


@pytest.mark.parametrize("distribution", [d for d in DISTRIBUTIONS if d != "jazzy"])
def test_recorded_hashes_of_a_distribution(shipped: InterfaceSet, distribution: str) -> None:
    """Recorded from its wheels on PyPI; test_shipped.py compares with the installed wheels of Jazzy."""
    recorded = json.loads((RECORDED / f"{distribution}.json").read_text(encoding="utf-8"))
    assert len(recorded) > 250
    for name, expected in recorded.items():
        assert shipped.type_hash(TypeName(*name.split("/"))) == expected, name


@pytest.mark.long
@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_wheels_on_pypi(shipped: InterfaceSet, distribution: str, tmp_path: Path) -> None:
    """All types, their constants and defaults, and the record; needs a network."""
    try:
        share = download(distribution, tmp_path)
    except OSError as error:
        pytest.skip(str(error))
    found = hashes(share)
    if distribution != "jazzy":
        assert found == json.loads((RECORDED / f"{distribution}.json").read_text(encoding="utf-8"))
    packages = {path.name for path in share.iterdir()}
    theirs = closed(InterfaceFinder(pip=(share.parent.joinpath("."),)), packages)
    assert {i.name for i in theirs} == {i.name for i in shipped if i.name.package in packages}
    for interface in theirs:
        own = shipped.interfaces[interface.name]
        for ours, other in zip(own.messages, interface.messages, strict=True):
            assert bare(ours) == bare(other), interface.name


def bare(message: Message) -> tuple[Constant | Field, ...]:
    """Return what a message declares, without comments and places."""
    entries: tuple[Constant | Field, ...] = (*message.constants, *message.fields)
    return tuple(replace(entry, comment=(), span=None) for entry in entries)


Sourced = Callable[..., None]


@pytest.fixture
def sourced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Sourced:
    """Make an underlay that has package `robot`, of a distribution."""

    def source(distribution: str, *packages: str) -> None:
        for name in packages:
            folder = tmp_path / "opt" / "share" / name / "msg"
            folder.mkdir(parents=True, exist_ok=True)
            (folder / "Wheel.msg").write_text("int32 x\n")
        monkeypatch.setenv("AMENT_PREFIX_PATH", os.fspath(tmp_path / "opt"))
        monkeypatch.setenv("ROS_DISTRO", distribution)

    return source


def application(folder: Path, distro: str = "") -> None:
    text = f"version: 1\n{distro}profiles: [pure_sender]\ninterfaces: [robot]\n"
    (folder / "microros.yaml").write_text(text)


def test_an_underlay_of_another_distribution(run: Runner, folder: Path, sourced: Sourced) -> None:
    sourced("kilted", "robot")
    application(folder)
    outcome = run("generate", "-o", "out")
    assert outcome.status == 0
    assert outcome.err == (
        "microros-gen: warning: robot come from ROS 2 kilted (ROS_DISTRO), the application is for jazzy."
        " Source ROS 2 jazzy, or write `distro: kilted` [MG-9243]\n"
    ).replace("robot come", "packages robot come")
    application(folder, "distro: kilted\n")
    assert run("generate", "-o", "out").err == ""
    sourced("humble")
    outcome = run("generate", "-o", "out")
    assert outcome.err.startswith(
        "microros.yaml:2:1: warning: packages robot come from ROS 2 humble (ROS_DISTRO), the application is for"
        " kilted. Source ROS 2 kilted [MG-9243]\n  distro: kilted\n"
    ), "also when nothing else changed since the last run"


def test_no_warning_where_nothing_is_read_from_it(
    run: Runner, folder: Path, sourced: Sourced, monkeypatch: pytest.MonkeyPatch
) -> None:
    sourced("humble", "other")
    assert run("generate", "--profile", "pure_sender", "-o", "out").err == ""
    sourced("jazzy", "robot")
    application(folder)
    assert run("generate", "-o", "out2").err == ""
    monkeypatch.delenv("ROS_DISTRO")
    assert run("generate", "-o", "out2").err == ""


def test_the_output_is_the_same_for_both(run: Runner, folder: Path) -> None:
    """No included interface differs between the distributions, so no byte of the code does."""
    outputs = []
    for distro in DISTRIBUTIONS:
        (folder / "microros.yaml").write_text(
            f"version: 1\ndistro: {distro}\nprofiles: [pure_sender]\ninterfaces: [sensor_msgs/msg/Imu]\n"
            "limits: {'*': {string: 8}}\n"
        )
        assert run("generate", "-o", distro).status == 0
        files = (p for p in sorted((folder / distro).rglob("*.[ch]")))
        outputs.append({p.relative_to(folder / distro).as_posix(): p.read_bytes() for p in files})
    assert outputs[0] == outputs[1]


def test_another_distribution_is_refused_by_name(run: Runner, folder: Path) -> None:
    application(folder, "distro: humble\n")
    outcome = run("resolve")
    assert outcome.status == 2
    assert (
        "microros.yaml:2:9: error: 'distro' must be jazzy or kilted; it is the text 'humble'" in outcome.err
    )
