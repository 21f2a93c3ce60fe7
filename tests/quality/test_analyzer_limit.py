# SPDX-License-Identifier: Apache-2.0
"""The limit of clang's analyzer costs no finding: half of it is enough to reach the same blocks."""

from __future__ import annotations

import shutil

import pytest

from tests.support.quality import analyzer
from tests.support.quality.corpus import Tree

pytestmark = [
    pytest.mark.lint,
    pytest.mark.builds,
    pytest.mark.skipif(not shutil.which("clang"), reason="no clang"),
]


FIRST = "src/quality_msgs/tree__type_support.c"
SLOWEST = (FIRST, "src/memory/rcutils_string_map.c", "src/read/xrce_read.c")
"""Files with functions of which the analyzer does not see all paths."""


def largest(trees: list[Tree], source: str) -> Tree:
    """Return the tree with the largest `source`."""
    return max(
        (tree for tree in trees if source in tree.sources),
        key=lambda tree: (tree.out / source).stat().st_size,
    )


@pytest.mark.parametrize("source", SLOWEST)
def test_half_of_the_nodes_reach_each_block(trees: list[Tree], source: str) -> None:
    tree = largest(trees, source)
    blocks = analyzer.reached(tree, source, analyzer.NODES)
    assert len(blocks) > 40
    assert blocks == analyzer.reached(tree, source, analyzer.NODES // 2)


def test_few_nodes_do_not(trees: list[Tree]) -> None:
    """The comparison itself: it tells when the analyzer gives up."""
    tree = largest(trees, FIRST)
    assert analyzer.reached(tree, FIRST, 2_000) < analyzer.reached(tree, FIRST, analyzer.NODES // 2)


def test_each_block_is_marked() -> None:
    code = "int f(int a)\n{\n  if (a > 1) {\n    return 1;\n  }\n  switch (a) {\n    case 0:\n      return 2;\n  }\n}\n"
    assert analyzer.marked(code).count("clang_analyzer_warnIfReached();") == 2
