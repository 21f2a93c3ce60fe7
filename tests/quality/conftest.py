# SPDX-License-Identifier: Apache-2.0
"""The corpus, generated once."""

from __future__ import annotations

import pytest

from tests.support.quality.corpus import Tree, Unit, make_examples, make_trees, units


@pytest.fixture(scope="session")
def trees(tmp_path_factory: pytest.TempPathFactory) -> list[Tree]:
    """The output folder of each application of the corpus."""
    return make_trees(tmp_path_factory.mktemp("corpus"))


@pytest.fixture(
    scope="session",
    params=[pytest.param(False, id="texts"), pytest.param(True, id="headers", marks=pytest.mark.long)],
)
def is_header_a_difference(request: pytest.FixtureRequest) -> bool:
    """Whether a file is analyzed with each set of headers that it includes, or once for each text that it has."""
    return bool(request.param)


@pytest.fixture(scope="session")
def all_units(
    trees: list[Tree], is_header_a_difference: bool, tmp_path_factory: pytest.TempPathFactory
) -> list[Unit]:
    """Every C file of every tree, and the applications of examples/."""
    every = [*trees, *make_examples(tmp_path_factory.mktemp("examples"))]
    return units(every, is_header_a_difference)
