# SPDX-License-Identifier: Apache-2.0
"""Interfaces that are not installed, and those of the wheels."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from microros_gen.interfaces.closure import InterfaceSet
from microros_gen.interfaces.find import InterfaceFinder
from tests.support.interfaces.resolving import package, resolve
from tests.support.typesupport.build import interfaces


@pytest.fixture(scope="session")
def own_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A package that no ROS installation has, with what a codec must know."""
    folder = tmp_path_factory.mktemp("own")
    (folder / "own_msgs").mkdir()
    (folder / "own_msgs" / "package.xml").write_text("<package><name>own_msgs</name></package>")
    point = "float64 x\nint16 y -7\n"
    report = """Point here
Point[] trace
Point[2] corners
bool[3] flags
uint8[4] key [1, 2, 3, 4]
byte[] raw
string<=5 name "abc"
wstring wide
string[<=2] notes
uint16 count 9
int64[] large
Nothing nothing
"""
    package(folder, "own_msgs", Point=point, Nothing="", Report=report)
    package(folder, "own_msgs", "srv", Add="int64 a\nint64 b\n---\nint64 sum\nstring[] notes\n")
    return folder


@pytest.fixture(scope="session")
def own(own_folder: Path) -> InterfaceSet:
    found, faults = resolve(InterfaceFinder.from_environment((own_folder,)), "own_msgs")
    assert not faults
    return found


@pytest.fixture(scope="session")
def installed() -> InterfaceSet:
    """Every interface of the wheels."""
    finder = InterfaceFinder(pip=(Path(sys.prefix),))
    found = [place.name for place in finder.packages() if finder.types(place.name)]
    if "test_msgs" not in found:
        pytest.skip("the ROS wheels are not installed")
    return interfaces(found)
