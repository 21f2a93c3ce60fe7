# SPDX-License-Identifier: Apache-2.0
"""Compares data with a JSON Schema (draft 2020-12): the keywords that the schemas of this project use.

Each of the tool's schemas is checked with all of a specification's keywords in the tests, by `jsonschema`; loading
that library would take longer than all else that happens to an application file.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

from microros_gen.records import dataclass

Schema = dict[str, Any]
Path = tuple[str | int, ...]


@dataclass(frozen=True)
class Difference:
    """What is not as the schema says: where in the data, and which keyword of which schema says so."""

    path: Path
    keyword: str
    schema: Schema


def differences(data: Any, schema: Schema) -> Iterator[Difference]:
    """Yield each difference between `data` and `schema`, in the order of the schema's keywords."""
    return _Checker(schema).check(data, schema, ())


def deprecated_parts(data: Any, schema: Schema) -> Iterator[Difference]:
    """Yield each part of `data` whose schema says `deprecated: true`; alternatives (`anyOf`) are not searched."""
    return _Checker(schema).deprecated(data, schema, ())


class _Checker:
    """Checks data against the parts of one schema."""

    def __init__(self, root: Schema) -> None:
        self._root = root

    def check(self, data: Any, schema: Schema, path: Path) -> Iterator[Difference]:
        """Yield the differences of `data`, which stands at `path`."""
        for keyword, wanted in schema.items():
            if keyword in _FAULTS:
                if _FAULTS[keyword](data, wanted):
                    yield Difference(path, keyword, schema)
            elif keyword == "required":
                if isinstance(data, dict) and any(key not in data for key in wanted):
                    yield Difference(path, keyword, schema)
            elif keyword == "anyOf":
                if all(self._differs(data, choice) for choice in wanted):
                    yield Difference(path, keyword, schema)
            elif keyword == "not":
                if not self._differs(data, wanted):
                    yield Difference(path, keyword, schema)
            elif keyword == "additionalProperties" and wanted is False:
                if any(True for _ in _others(data, schema)):
                    yield Difference(path, keyword, schema)
            else:
                for step, part in self._parts(keyword, wanted, data, schema):
                    yield from self.check(part[0], part[1], (*path, *step))

    def deprecated(self, data: Any, schema: Schema, path: Path) -> Iterator[Difference]:
        """Yield what of `data`, which stands at `path`, is deprecated."""
        for keyword, wanted in schema.items():
            if keyword == "deprecated" and wanted is True:
                yield Difference(path, keyword, schema)
            parts = () if isinstance(wanted, bool) else self._parts(keyword, wanted, data, schema)
            for step, part in parts:
                yield from self.deprecated(part[0], part[1], (*path, *step))

    def _differs(self, data: Any, schema: Schema) -> bool:
        return any(True for _ in self.check(data, schema, ()))

    def _parts(
        self, keyword: str, wanted: Any, data: Any, schema: Schema
    ) -> Iterator[tuple[Path, tuple[Any, Schema]]]:
        """Yield what a keyword compares with the schemas in it: where it is, the data and the schema."""
        if keyword == "$ref":
            yield (), (data, self._root["$defs"][wanted.removeprefix("#/$defs/")])
        elif isinstance(data, list) and keyword == "items":
            yield from (((index,), (item, wanted)) for index, item in enumerate(data))
        elif isinstance(data, dict) and keyword == "properties":
            yield from (((key,), (data[key], wanted[key])) for key in wanted if key in data)
        elif isinstance(data, dict) and keyword == "patternProperties":
            for pattern, schema_of_pattern in wanted.items():
                yield from (((k,), (v, schema_of_pattern)) for k, v in data.items() if re.search(pattern, k))
        elif keyword == "additionalProperties":
            yield from (((key,), (data[key], wanted)) for key in _others(data, schema))


def _others(data: Any, schema: Schema) -> Iterator[str]:
    """Yield the keys that neither `properties` nor `patternProperties` name."""
    patterns = schema.get("patternProperties", {})
    for key in data if isinstance(data, dict) else ():
        if key not in schema.get("properties", {}) and not any(re.search(p, key) for p in patterns):
            yield key


def _is_number(data: Any) -> bool:
    return isinstance(data, (int, float)) and not isinstance(data, bool)


_TYPES: Mapping[str, Callable[[Any], bool]] = MappingProxyType(
    {
        "string": lambda data: isinstance(data, str),
        "integer": lambda data: _is_number(data) and (isinstance(data, int) or data.is_integer()),
        "number": _is_number,
        "boolean": lambda data: isinstance(data, bool),
        "array": lambda data: isinstance(data, list),
        "object": lambda data: isinstance(data, dict),
        "null": lambda data: data is None,
    }
)


def _has_type(data: Any, wanted: str | list[str]) -> bool:
    return any(_TYPES[kind](data) for kind in ([wanted] if isinstance(wanted, str) else wanted))


def _equal(first: Any, second: Any) -> bool:
    """Return whether two values are the same to JSON, which takes no number for true or false."""
    if isinstance(first, list) and isinstance(second, list):
        return len(first) == len(second) and all(map(_equal, first, second))
    if isinstance(first, dict) and isinstance(second, dict):
        return first.keys() == second.keys() and all(_equal(first[key], second[key]) for key in first)
    return isinstance(first, bool) == isinstance(second, bool) and bool(first == second)


def _has_twins(data: list[Any]) -> bool:
    return any(_equal(item, other) for index, item in enumerate(data) for other in data[:index])


# Keyword → whether a value violates the keyword; each applies only to values of one type.
_FAULTS: Mapping[str, Callable[[Any, Any], bool]] = MappingProxyType(
    {
        "type": lambda data, wanted: not _has_type(data, wanted),
        "enum": lambda data, wanted: not any(_equal(data, value) for value in wanted),
        "const": lambda data, wanted: not _equal(data, wanted),
        "minimum": lambda data, wanted: _is_number(data) and not data >= wanted,  # .nan is in no range
        "maximum": lambda data, wanted: _is_number(data) and data > wanted,
        "multipleOf": lambda data, wanted: _is_number(data) and data % wanted != 0,
        "minLength": lambda data, wanted: isinstance(data, str) and len(data) < wanted,
        "maxLength": lambda data, wanted: isinstance(data, str) and len(data) > wanted,
        "pattern": lambda data, wanted: isinstance(data, str) and re.search(wanted, data) is None,
        "minItems": lambda data, wanted: isinstance(data, list) and len(data) < wanted,
        "uniqueItems": lambda data, wanted: isinstance(data, list) and wanted and _has_twins(data),
        "minProperties": lambda data, wanted: isinstance(data, dict) and len(data) < wanted,
        "maxProperties": lambda data, wanted: isinstance(data, dict) and len(data) > wanted,
    }
)
ASSERTIONS = frozenset(
    {*_FAULTS, "$ref", "items", "properties", "patternProperties", "additionalProperties"}
    | {"required", "anyOf", "not"}
)
"""The keywords that are checked. Another one in a schema must be an annotation."""
