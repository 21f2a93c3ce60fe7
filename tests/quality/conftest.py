# SPDX-License-Identifier: Apache-2.0
"""The corpus, generated once."""

from __future__ import annotations

import pytest

from tests.support.quality.corpus import Tree, Unit, covering_units, make_examples, make_trees, units


@pytest.fixture(scope="session")
def trees(tmp_path_factory: pytest.TempPathFactory) -> list[Tree]:
    """The output folder of each application of the corpus."""
    return make_trees(tmp_path_factory.mktemp("corpus"))


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
    every = [*trees, *make_examples(tmp_path_factory.mktemp("examples"))]
    return units(every) if is_every_unit else covering_units(every)
