# SPDX-License-Identifier: Apache-2.0
"""The corpus, generated once."""

from __future__ import annotations

import pytest
from house.corpus import Tree, Unit, make_trees, units


@pytest.fixture(scope="session")
def trees(tmp_path_factory: pytest.TempPathFactory) -> list[Tree]:
    """The output folder of each application of the corpus."""
    return make_trees(tmp_path_factory.mktemp("corpus"))


@pytest.fixture(scope="session")
def all_units(trees: list[Tree]) -> list[Unit]:
    """Every C file of every tree."""
    return units(trees)
