# SPDX-License-Identifier: Apache-2.0
"""The JSON Schemas: valid, described throughout, and of one mind with the parser."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from microros_gen.application.parser import SCHEMA as APPLICATION_SCHEMA
from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.schema import load_schema
from microros_gen.documents.yaml_tree import parse_yaml, to_data
from microros_gen.selection.component import Profile
from microros_gen.selection.profile_file import AXES, parse_profile
from microros_gen.selection.profile_file import SCHEMA as PROFILE_SCHEMA
from tests.support.application.key_cases import CASES, RESERVED
from tests.support.ids import without_id

APPLICATION = load_schema(APPLICATION_SCHEMA)
PROFILE = load_schema(PROFILE_SCHEMA)


def faults_of(text: str) -> list[str]:
    found = Diagnostics()
    parse_application(Source("f", text), found)
    return [without_id(d.headline()) for d in found]


def resolved(schema: dict[str, Any]) -> dict[str, Any]:
    reference = schema.get("$ref")
    return APPLICATION["$defs"][reference.removeprefix("#/$defs/")] if reference else schema


def key_paths(schema: dict[str, Any], path: str = "") -> Iterator[str]:
    """Yield the path of every key, with [] for the items of a list.

    Limits have their own syntax; the items of `declare` are those of the list that is short for it.
    """
    for key, value in schema.get("properties", {}).items():
        here = f"{path}.{key}".lstrip(".")
        yield here
        if key not in ("limits", "declare"):
            value = resolved(value)
            yield from key_paths(value, here)
            yield from key_paths(resolved(value.get("items", {})), f"{here}[]")


def test_every_key_of_the_schema_has_its_cases() -> None:
    assert sorted(key_paths(APPLICATION)) == sorted([*CASES, *RESERVED])


@pytest.mark.parametrize("path", CASES)
def test_a_good_value_is_taken_and_read(path: str) -> None:
    case = CASES[path]
    found = Diagnostics()
    application = parse_application(Source("f", case.good), found)
    assert [without_id(d.headline()) for d in found] == []
    assert application is not None
    assert case.read(application) == case.value


@pytest.mark.parametrize("path", CASES)
def test_a_bad_value_is_refused_at_its_place(path: str) -> None:
    case = CASES[path]
    assert any(line.startswith(f"f:{case.place}: error: {case.reported}") for line in faults_of(case.bad)), (
        faults_of(case.bad)
    )


@pytest.mark.parametrize("key", RESERVED)
def test_a_reserved_key_says_so(key: str) -> None:
    text, place, reported = RESERVED[key]
    assert faults_of(text)[0].startswith(f"f:{place}: error: {reported}")
    assert not any(key in line for line in faults_of("zzz: 1\n")), "a reserved key is no suggestion"


@pytest.mark.parametrize("path", CASES)
def test_the_schema_alone_agrees(path: str) -> None:
    """What the parser takes, an editor takes; what the schema refuses, the parser refuses."""
    validator = Draft202012Validator(APPLICATION)
    for text, good in ((CASES[path].good, True), (CASES[path].bad, False)):
        tree = parse_yaml(Source("f", text), Diagnostics())
        assert tree is not None
        errors = list(validator.iter_errors(to_data(tree)))
        assert (not errors) is good
        assert not (errors and not faults_of(text))


@pytest.mark.parametrize("schema", [APPLICATION, PROFILE], ids=["application", "profile"])
def test_the_schema_is_valid_and_described(schema: dict[str, Any]) -> None:
    Draft202012Validator.check_schema(schema)
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert schema["additionalProperties"] is False

    def walk(part: Any, path: str) -> None:
        if isinstance(part, dict):
            for key, value in part.get("properties", {}).items():
                assert value.get("description") or "$ref" in value, f"{path}.{key} has no description"
            if part.get("type") == "object":
                assert part.get("additionalProperties") is False, f"{path} takes unknown keys"
            for key, value in part.items():
                walk(value, f"{path}.{key}")
        elif isinstance(part, list):
            for value in part:
                walk(value, path)

    walk(schema, "")


def test_both_schemas_have_the_axes_of_the_parser() -> None:
    for schema in (APPLICATION, PROFILE):
        for axis, values in AXES.items():
            part = schema["properties"][axis]
            part = part["properties"]["type"] if axis == "transport" and "properties" in part else part
            if "items" in part:
                assert set(part["items"]["properties"]["to"]["enum"]) == set(values)
                continue
            assert "x-reserved" in part or tuple(part["enum"]) == values


def test_the_schema_files_are_tidy() -> None:
    for path in (APPLICATION_SCHEMA, PROFILE_SCHEMA):
        text = json.dumps(load_schema(path))
        assert "SPDX-License-Identifier: Apache-2.0" in text


PROFILE_CASES: dict[str, tuple[str, Any, str, str]] = {
    "order": (
        "order: 3",
        3,
        "order: 0",
        "2:8: error: 'order' must be a whole number between 1 and 1000; it is 0",
    ),
    "profile": (
        "",
        "p",
        "profile: Quiet",
        "1:10: error: 'profile' must be a name of lower-case letters, digits",
    ),
    "summary": ("summary: A text", "A text", "summary: 3", "2:10: error: 'summary' must be a text; it is 3"),
    "extends": (
        "extends: [a]",
        ["a"],
        "extends: a",
        "2:10: error: 'extends' must be a list; it is the text 'a'",
    ),
    "components": (
        "components: [+a, -b, c]",
        [("a", True), ("b", False), ("c", True)],
        "components: [3]",
        "2:14: ",
    ),
    "entities": (
        "entities: xml",
        "xml",
        "entities: [xml]",
        "2:11: error: 'entities' must be preconfigured, refer",
    ),
    "transport": (
        "transport: tcp",
        "tcp",
        "transport: {type: tcp}",
        "2:12: error: 'transport' must be udp, tcp,",
    ),
    "liveliness": (
        "liveliness: none",
        "none",
        "liveliness: off",
        "2:13: error: 'liveliness' must be ping, ack",
    ),
    "logging": (
        "logging: rosout",
        "rosout",
        "logging: true",
        "2:10: error: 'logging' must be console, callback",
    ),
    "clock": (
        "clock: ros",
        "ros",
        "clock: rso",
        "2:8: error: 'clock' must be steady or ros; it is the text 'rso'.",
    ),
    "nodes": (
        "nodes: [{name: arm, services: [{name: grip, type: std_srvs/srv/Trigger}], timers: [{name: t, period: 1 s}]}]",
        [("arm", ["grip"], ["t"])],
        "nodes: [{name: arm, publishers: [{topic: grip}]}]",
        "2:34: error: missing key 'type' in 'nodes[0].publishers[0]'",
    ),
}


def profile_value(profile: Profile, key: str) -> Any:
    if key in AXES:
        return profile.axes[key].name
    value = getattr(profile, "name" if key == "profile" else key)
    if key == "extends":
        return [named.name for named in value]
    if key == "components":
        return [(change.name, change.add) for change in value]
    if key == "nodes":
        return [(n.name, [e.topic for e in n.endpoints], [t.name for t in n.timers]) for n in value]
    return value


def test_every_key_of_the_profile_schema_has_its_cases() -> None:
    assert sorted(PROFILE["properties"]) == sorted(PROFILE_CASES)


@pytest.mark.parametrize("key", PROFILE_CASES)
def test_keys_of_a_profile(key: str) -> None:
    good, value, bad, reported = PROFILE_CASES[key]
    found = Diagnostics()
    profile = parse_profile(Source("f", f"profile: p\n{good}\n"), found)
    assert [without_id(d.headline()) for d in found] == []
    assert profile is not None
    assert profile_value(profile, key) == value
    text = bad if bad.startswith("profile") else f"profile: p\n{bad}"
    assert parse_profile(Source("f", text), found) is None
    assert next(without_id(d.headline()) for d in found).startswith(f"f:{reported}")
