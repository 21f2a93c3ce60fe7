# SPDX-License-Identifier: Apache-2.0
"""The corpus, generated once for all processes of a run."""

from __future__ import annotations

import pytest

from tests.support.quality.corpus import Tree, Unit, make_examples, make_trees, units
from tests.support.quality.covering import covering_units
from tests.support.sharing import shared_by_processes


@pytest.fixture(scope="session")
def trees(tmp_path_factory: pytest.TempPathFactory) -> list[Tree]:
    """The output folder of each application of the corpus."""
    return shared_by_processes(tmp_path_factory, "corpus", make_trees)


@pytest.fixture(
    scope="session",
    params=[pytest.param(False, id="lines"), pytest.param(True, id="all", marks=pytest.mark.long)],
)
def is_every_unit(request: pytest.FixtureRequest) -> bool:
    """Whether a file is analyzed with each set of headers that it includes, or each different line once."""
    return bool(request.param)


@pytest.fixture(scope="session")
def all_units(trees: list[Tree], is_every_unit: bool, tmp_path_factory: pytest.TempPathFactory) -> list[Unit]:
    """C files of the trees, and the applications of examples/."""
    every = [*trees, *shared_by_processes(tmp_path_factory, "examples", make_examples)]
    if is_every_unit:
        return units(every)
    return shared_by_processes(tmp_path_factory, "lines", lambda _: covering_units(every))


@pytest.fixture(scope="session")
def tree_units(trees: list[Tree], all_units: list[Unit]) -> list[Unit]:
    """C files of the trees alone."""
    names = {tree.name for tree in trees}
    return [unit for unit in all_units if unit.tree.name in names]
