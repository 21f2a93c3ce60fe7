# SPDX-License-Identifier: Apache-2.0
"""Generates each application of the matrix once in a process."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import pytest

from tests.support.matrix import VARIANTS, Tree, make_tree


@pytest.fixture(scope="session")
def tree_of(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Tree]:
    base = tmp_path_factory.mktemp("trees")

    @cache
    def get(name: str) -> Tree:
        return make_tree(name, VARIANTS[name], base / name)

    return get
