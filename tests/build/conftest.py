# SPDX-License-Identifier: Apache-2.0
"""Generates each application once in a process."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import pytest
from installed import Installed, install_wheel
from matrix import VARIANTS, Tree, make_tree


@pytest.fixture(scope="session")
def tree_of(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Tree]:
    base = tmp_path_factory.mktemp("trees")

    @cache
    def get(name: str) -> Tree:
        return make_tree(name, VARIANTS[name], base / name)

    return get


@pytest.fixture(scope="session")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Installed:
    """The wheel of this repository in an environment of its own, made once in a process."""
    return install_wheel(tmp_path_factory.mktemp("package"))
