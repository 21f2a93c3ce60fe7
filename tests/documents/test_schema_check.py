# SPDX-License-Identifier: Apache-2.0
"""The tool's own check of data against its schemas finds what `jsonschema` finds."""

from __future__ import annotations

import copy
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

import microros_gen
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.schema import load_schema
from microros_gen.documents.schema_check import ASSERTIONS, differences
from microros_gen.documents.yaml_tree import parse_yaml, to_data
from tests.support.application.key_cases import CASES

PACKAGE = Path(microros_gen.__file__).parent
FILES = {
    name: PACKAGE / folder / f"{name}.schema.json"
    for name, folder in (
        ("application", "application"),
        ("profile", "selection"),
        ("target", "platform"),
        ("agent", "agent/configuration"),
        ("package", "package"),
    )
}
SCHEMAS = {
    name: load_schema(path, *([FILES["application"]] if name == "profile" else []))
    for name, path in FILES.items()
}
ANNOTATIONS = {"description", "title", "default", "examples", "deprecated"}
PROFILES = sorted(PACKAGE.parent.glob("profiles/*.yaml"))
TARGETS = sorted(PACKAGE.glob("targets/*.yaml"))
PACKAGES = sorted(PACKAGE.glob("platform/package/*/package.yaml"))
REPLACEMENTS: tuple[Any, ...] = (
    *(None, True, False, 0, 1, -1, 1.0, 2.5, 3, 10**12, "", "word", "two words", "1 KiB", "pkg/msg/Type"),
    *([], [1, 1], [True, 1], ["a", "a"], {}, {"other": 1}),
)


def keywords(schema: Any) -> Iterator[str]:
    if not isinstance(schema, dict):
        return
    for key, value in schema.items():
        yield key
        if key in ("properties", "patternProperties", "$defs"):
            for element in value.values():
                yield from keywords(element)
        elif key in ("items", "additionalProperties", "not"):
            yield from keywords(value)
        elif key == "anyOf":
            for element in value:
                yield from keywords(element)


def places(data: Any) -> Iterator[tuple[Any, Any]]:
    """Yield each container with each of its keys."""
    steps = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in steps:
        yield data, key
        yield from places(value)


def mutated(data: Any, choice: random.Random) -> Any:
    data = copy.deepcopy(data)
    found = list(places(data))
    if not found:
        return choice.choice(REPLACEMENTS)
    container, key = choice.choice(found)
    if isinstance(container, dict) and choice.random() < 0.2:
        container[choice.choice(["other", "domain_id", "name"])] = container.pop(key)
    else:
        container[key] = copy.deepcopy(choice.choice(REPLACEMENTS))
    return data


def by_jsonschema(data: Any, schema: dict[str, Any]) -> set[tuple[tuple[Any, ...], str]]:
    found = Draft202012Validator(schema).iter_errors(data)
    return {(tuple(error.absolute_path), error.validator) for error in found}


def documents(name: str) -> list[Any]:
    """Return documents of a schema: each key of an application with a good and a bad value, shipped files."""
    texts = {
        "application": [text for case in CASES.values() for text in (case.good, case.bad)],
        "profile": [p.read_text() for p in PROFILES],
        "target": [p.read_text() for p in TARGETS],
        "package": [p.read_text() for p in PACKAGES],
        "agent": ["version: 1\ntransports:\n- {type: udp, port: 8888}\nlimits: {sessions: 4}\n"],
    }[name]
    trees = [parse_yaml(Source("f", text), Diagnostics()) for text in texts]
    return [to_data(tree) for tree in trees if tree is not None]


@pytest.mark.parametrize("name", SCHEMAS)
def test_it_finds_what_jsonschema_finds(name: str) -> None:
    choice, schema = random.Random(13), SCHEMAS[name]
    whole = documents(name)
    assert whole
    found = 0
    for data in [*whole, *(mutated(choice.choice(whole), choice) for _ in range(400)), *REPLACEMENTS]:
        for _ in range(2):
            expected = by_jsonschema(data, schema)
            assert {(d.path, d.keyword) for d in differences(data, schema)} == expected, data
            found += len(expected)
            data = mutated(data, choice)
    assert found > 200


@pytest.mark.parametrize("name", SCHEMAS)
def test_every_keyword_of_a_schema_is_checked_or_an_annotation(name: str) -> None:
    used = set(keywords(SCHEMAS[name]))
    others = {k for k in used - ASSERTIONS - ANNOTATIONS if not k.startswith(("x-", "$"))}
    assert others == set()
    assert {k for k in used if k.startswith("$")} <= {"$schema", "$id", "$comment", "$defs", "$ref"}


def test_no_number_is_taken_for_a_truth_value() -> None:
    assert [d.keyword for d in differences(True, {"const": 1})] == ["const"]
    assert [d.keyword for d in differences([1, True], {"uniqueItems": True})] == []
    assert [d.keyword for d in differences(1.0, {"type": "integer"})] == []
