# SPDX-License-Identifier: Apache-2.0
"""Plans of every message of the ROS wheels, generated once, and a shared library of them."""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path

import pytest

from microros_gen.interfaces.find import InterfaceFinder
from tests.support.typesupport.build import (
    TEST_RULES,
    Generated,
    compile_shared,
    differing_rules,
    generate,
    interfaces,
)


@pytest.fixture(scope="session")
def packages() -> list[str]:
    """Every package of the environment that has interfaces."""
    finder = InterfaceFinder(pip=(Path(sys.prefix),))
    found = [place.name for place in finder.packages() if finder.types(place.name)]
    if "test_msgs" not in found:
        pytest.skip("the ROS wheels are not installed")
    return found


@pytest.fixture(scope="session")
def everything(packages: list[str], tmp_path_factory: pytest.TempPathFactory) -> Generated:
    """All messages, derived ones too, under one small limit: every capacity is a constant."""
    return generate(packages, TEST_RULES, tmp_path_factory.mktemp("same"))


@pytest.fixture(scope="session")
def differing(packages: list[str], tmp_path_factory: pytest.TempPathFactory) -> Generated:
    """All messages, with other limits for each use of a nested type: tables of limits."""
    rules = differing_rules(interfaces(packages))
    return generate(packages, rules, tmp_path_factory.mktemp("differing"))


@pytest.fixture(scope="session", params=["same", pytest.param("differing", marks=pytest.mark.variant)])
def limits_case(request: pytest.FixtureRequest) -> Generated:
    """Both ways to have limits."""
    name = "everything" if request.param == "same" else "differing"
    generated: Generated = request.getfixturevalue(name)
    return generated


@pytest.fixture(scope="session")
def libraries() -> dict[Path, ctypes.CDLL]:
    """Shared libraries that are compiled already, by folder."""
    return {}


@pytest.fixture
def functions_library(everything: Generated, libraries: dict[Path, ctypes.CDLL]) -> ctypes.CDLL:
    """The library of `everything`: message functions do not depend on limits."""
    if everything.folder not in libraries:
        libraries[everything.folder] = compile_shared(everything)
    return libraries[everything.folder]


@pytest.fixture
def library(limits_case: Generated, libraries: dict[Path, ctypes.CDLL]) -> ctypes.CDLL:
    """All generated C as one shared library, with ROS 2's own string functions and allocator."""
    if limits_case.folder not in libraries:
        libraries[limits_case.folder] = compile_shared(limits_case)
    return libraries[limits_case.folder]
