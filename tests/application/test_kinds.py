# SPDX-License-Identifier: Apache-2.0
"""The kinds of entities are one table; few other modules name all of them."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import microros_gen
from microros_gen.application.kinds import KIND, KINDS, NAMES, RECEIVING, SERVICE_KINDS, TOPIC_KINDS
from microros_gen.selection.find_components import load_catalogue

PACKAGE = Path(microros_gen.__file__).parent
PARTICULAR = {
    "agent/operations.py": "operations of the wire: requester and replier have separate objects",
    "agent/ros/node.py": "calls of rclpy, which differ from kind to kind",
    "application/kinds.py": "the table",
    "client/plan/agent_files.py": "XML and JSON of the agent, which differ from kind to kind",
    "client/plan/entities.py": "the slice of the plan: a typed field for each kind",
    "client/plan/plan_id.py": "the record of the plan id: its keys are fixed and refer to nothing in Python",
    "client/plan/project.py": "puts the slices together",
    "client/views/example.py": "C code of the example, which differs from kind to kind",
    "image/entities.py": "names of tables in C, as debugging information has them",
}
"""Modules that name all four kinds, and why. The list must not grow: what goes through all kinds uses the table."""


def words(tree: ast.AST) -> Iterator[str]:
    """Yield the words of a module that are code: identifiers, and texts that are one word."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
        elif isinstance(node, ast.Attribute):
            yield node.attr
        elif isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, (ast.arg, ast.keyword)):
            yield node.arg or ""


def names_all(text: str) -> bool:
    """Return whether a module names every kind, in the singular or as a list."""
    if not all(kind.name in text for kind in KINDS):
        return False  # parsing takes most of the time
    found = set(words(ast.parse(text)))
    return all({kind.name, kind.key} & found for kind in KINDS)


def test_few_modules_name_all_kinds() -> None:
    naming = {
        path.relative_to(PACKAGE).as_posix()
        for path in PACKAGE.rglob("*.py")
        if names_all(path.read_text(encoding="utf-8"))
    }
    assert naming <= set(PARTICULAR), "go through microros_gen.application.kinds instead"
    assert set(PARTICULAR) <= naming, "remove from the list what no longer names them"
    assert len(PARTICULAR) <= 9


def test_the_count_finds_an_enumeration() -> None:
    assert names_all("""x = {"publisher": 1, "subscription": 2}\ny = plan.services\nz = clients""")
    assert not names_all("""x = "publisher, subscription, service, client" """)


def test_components_of_the_table_exist_and_create_objects() -> None:
    catalogue = load_catalogue()
    for kind in KINDS:
        assert catalogue[kind.component].objects, kind.name


def test_the_columns_agree() -> None:
    assert tuple(KIND) == NAMES == ("publisher", "subscription", "service", "client")
    assert set(SERVICE_KINDS) | set(TOPIC_KINDS) == set(NAMES)
    for kind in KINDS:
        assert kind.waited == bool(kind.receives)
        assert kind.key == f"{kind.name}s"
        assert len(kind.parts) == (2 if kind.service_type else 1)
    assert [kind.name for kind in RECEIVING] == ["subscription", "service", "client"]


@pytest.mark.parametrize(("kind", "sent"), [("service", "Response"), ("client", "Request")])
def test_a_client_sends_what_a_service_receives(kind: str, sent: str) -> None:
    assert KIND[kind].sends == (sent,)
    assert [suffix for suffix, sends in KIND[kind].parts if sends] == [sent]
    assert [suffix for suffix, _ in KIND[kind].parts] == ["Request", "Response"]
