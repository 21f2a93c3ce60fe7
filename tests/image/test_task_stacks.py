# SPDX-License-Identifier: Apache-2.0
"""The stack that a task needs follows from the call graph below its entry."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.image.callgraph import CallGraph, Node
from microros_gen.image.task_stacks import TaskStack, task_stacks


def node(address: int, name: str, frame: int, *calls: int) -> Node:
    return Node(name, address, frame, "compiler", None, set(calls))


def manifest(size: int, context: int = 100) -> Mapping[str, object]:
    task = {"name": "control", "entry": "run", "stack": size, "stack_auto": True}
    return {"features": {"tasks": {"values": {"tasks": [task], "stack_context": context}}}}


def stack_of(graph: Mapping[int, Node], size: int = 1000) -> TaskStack:
    (found,) = task_stacks(manifest(size), CallGraph(graph, "EM_ARM", True))
    return found


GRAPH = {
    1: node(1, "run", 8, 2, 3),
    2: node(2, "small", 16),
    3: node(3, "large", 200, 2),
    4: node(4, "other", 900),
}


def test_the_heaviest_chain_the_margin_and_the_context_are_the_size() -> None:
    stack = stack_of(GRAPH)
    assert stack.bound is not None
    assert [link.name for link in stack.bound.chain] == ["run", "large", "small"]
    assert stack.needs == 352  # 224, a tenth of it rounded up to 23, and 100: a multiple of 8
    assert (stack.fits, stack_of(GRAPH, 324).fits, stack_of(GRAPH, 323).fits) == (True, True, False)


def test_what_is_not_known_leaves_no_size() -> None:
    loop = {**GRAPH, 2: node(2, "small", 16, 1)}
    assert (stack_of(loop).needs, stack_of(loop).fits) == (None, False)
    assert stack_of(loop).open == ("run: recursion",)
    missing = {2: GRAPH[2]}
    assert (stack_of(missing).needs, stack_of(missing).open) == (None, ("its entry is not in the image",))


def test_without_tasks_there_are_none() -> None:
    assert task_stacks({}, CallGraph(GRAPH, "EM_ARM", True)) == ()
