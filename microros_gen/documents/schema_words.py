# SPDX-License-Identifier: Apache-2.0
"""What a schema says, in plain words."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from typing import Any

from microros_gen.diagnostics import nearest
from microros_gen.documents.schema_check import differences
from microros_gen.documents.schema_values import value_hint
from microros_gen.documents.yaml_tree import MappingNode, ScalarNode, SequenceNode, YamlNode, to_data

_TYPES = {
    "string": "a text",
    "integer": "a whole number",
    "number": "a number",
    "boolean": "true or false",
    "array": "a list",
    "object": "a mapping of keys and values",
}
_OLD_BOOLEANS = {"yes": "true", "on": "true", "y": "true", "no": "false", "off": "false", "n": "false"}
# `pkg/Type`, and what C++, Python and IDL write
_LOOSE_TYPE = re.compile(
    r"([a-z][a-z0-9_]*)(?:/|::|\.)(?:(msg|srv|action)(?:/|::|\.))?([A-Za-z][A-Za-z0-9_]*)"
)
_QOS_PROFILES = {
    "sensor_data": "{reliability: best_effort, depth: 5}",
    "best_effort": "{reliability: best_effort}",
    "reliable": "{reliability: reliable}",
    "default": "{depth: 10}",
    "transient_local": "{durability: transient_local}",
    "parameters": "{depth: 1000}",
    "services_default": "{depth: 10}",
    "system_default": "{depth: 10}",
}
"""What people write for `qos:` (names of rmw_qos_profile_…, policies) → the same as a mapping."""
_MISSPELLED = 0.8
"""Likeness of two words from which on one is taken for the other, though it is a key of another place."""
_KINDS_OF_TYPE = ("msg", "srv", "action")
_ANY_KIND = "interface"
"""`x-format` of a package or a type of any kind."""
_WORDS = re.compile(r"\^\(([a-z_|]+)\)\$")
"""A pattern of words, one of which may stand in place of a list."""
_DEFAULT = re.compile(r"\bDefault: ([0-9][0-9.]*(?: [A-Za-zµ]+)?)(?![A-Za-z0-9])")
"""What the description of a number says of its default."""
_DEFAULT_WORD = re.compile(r"\bDefault: (\w+)(?![\w ])")
_OLD_NUMBER = re.compile(r"[-+]?([0-9][0-9_]*(:[0-5]?[0-9])+|[0-9]+(_[0-9]+)+|0b[01]+)")


def describe_mismatch(
    node: YamlNode, label: str, schema: dict[str, Any], root: dict[str, Any]
) -> tuple[str, str | None]:
    """Return message and hint for a value that is not what `schema`, a part of `root`, asks for."""
    what = f"'{label}'" if label else "the file"
    if isinstance(node, ScalarNode) and node.value == "" and schema.get("minLength"):
        return f"{what} must not be empty", "Write a text, or remove the key"
    hint = _hint(node, schema, root) if label else "Write `key: value` lines"
    if isinstance(node, MappingNode) and 0 < len(node.entries) < schema.get("minProperties", 0):
        return f"{what} must be {expectation(schema)}; it has {len(node.entries)}", hint
    return f"{what} must be {expectation(schema)}; it is {found(node)}", hint


def describe_unknown_key(
    key: str, label: str, schema: dict[str, Any], root: dict[str, Any]
) -> tuple[str, str | None]:
    """Return message and hint for a key that `schema`, a part of `root`, does not have."""
    where = f"'{label}'" if label else "the file"
    known_key = key_without_space(key, schema)
    if known_key is not None:
        return (
            f"unknown key '{key}' in {where}",
            f"Write `{known_key}: {key[len(known_key) + 1 :]}`, with a space after the colon",
        )
    if "x-keys" in schema:
        corrected = _full_type(key, schema.get("x-format"))
        hint = f"Write {corrected}" if corrected else nearest(key, schema.get("properties", {}))
        return f"the keys of {where} must be {schema['x-keys']}; '{key}' is not", hint
    known = [k for k, value in schema.get("properties", {}).items() if "x-reserved" not in value]
    for pattern, words in schema.get("x-meant-keys", {}).items():
        if match := re.fullmatch(pattern, key):
            return f"unknown key '{key}' in {where}", match.expand(words)
    if get_close_matches(key, known, cutoff=_MISSPELLED):
        return f"unknown key '{key}' in {where}", nearest(key, known)
    if "x-other-keys" in schema:
        return f"unknown key '{key}' in {where}", schema["x-other-keys"].replace("KEY", key)
    place = re.sub(r"\[[0-9]+\]", "[]", label)
    owners = {
        owner: (up := _levels_up(place, owner), -len(keys & {*known}) if up else 0, len(owner), owner)
        for owner, keys in _owners(key, root, root, "", frozenset())
        if owner not in ("", place)
    }
    if owners:
        closest = sorted(owners, key=lambda owner: owners[owner])[:2]
        return (
            f"unknown key '{key}' in {where}",
            f"It is a key of {' and '.join(f'`{owner}`' for owner in closest)}",
        )
    return f"unknown key '{key}' in {where}", nearest(key, known) or f"Known: {', '.join(known)}"


def _levels_up(place: str, owner: str) -> int:
    """Return how far up from a place everything begins that an owner of a key is in; 0: it is below the place."""
    steps, others = (re.findall(r"\w+|\[.*?\]", label) for label in (place, owner))
    common = 0
    while common < min(len(steps), len(others)) and steps[common] == others[common]:
        common += 1
    return len(steps) - common


def _owners(
    key: str, schema: dict[str, Any], root: dict[str, Any], label: str, seen: frozenset[str]
) -> Iterator[tuple[str, frozenset[str]]]:
    """Yield labels and keys of all mappings of `schema` that have a key; a definition in itself is not searched."""
    reference = schema.get("$ref", "")
    if reference in seen:
        return
    if reference:
        schema, seen = root["$defs"][reference.removeprefix("#/$defs/")], seen | {reference}
    properties = schema.get("properties", {})
    if key in properties and "x-reserved" not in properties[key]:
        yield label, frozenset(properties)
    for name, part in properties.items():
        yield from _owners(key, part, root, f"{label}.{name}".lstrip("."), seen)
    if isinstance(schema.get("items"), dict):
        yield from _owners(key, schema["items"], root, f"{label}[]", seen)


def key_without_space(key: str, schema: dict[str, Any]) -> str | None:
    """Return the key that somebody meant who wrote `topic:x`, which is one word to YAML; else None."""
    beginning, separator, _ = key.partition(":")
    return beginning if separator and beginning in schema.get("properties", {}) else None


def expectation(schema: dict[str, Any]) -> str:
    """Return what a value must be: `x-expects`, or what type, enum, const and range say."""
    if "x-expects" in schema:
        return str(schema["x-expects"])
    if "enum" in schema:
        *first, last = [str(value) for value in schema["enum"]]
        return f"{', '.join(first)} or {last}" if first else last
    kinds = schema.get("type", [])
    words = " or ".join(_TYPES[kind] for kind in ([kinds] if isinstance(kinds, str) else kinds))
    if words == "a list" and schema.get("minItems") == 1:
        return "a list with at least one item"
    low, high = schema.get("minimum"), schema.get("maximum")
    if low is not None and high is not None:
        return f"{words} between {low} and {high}"
    return f"{words} of at least {low}" if low is not None else words


def found(node: YamlNode) -> str:
    """Return what stands there instead."""
    if isinstance(node, SequenceNode):
        return "a list" if node.items else "an empty list"
    if isinstance(node, MappingNode):
        return "a mapping" if node.entries else "an empty mapping"
    if node.value is None:
        return "empty"
    if isinstance(node.value, str):
        return f"the text '{node.text}'"
    return str(node.text)


def _hint(node: YamlNode, schema: dict[str, Any], root: dict[str, Any]) -> str | None:
    kinds = schema.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    if isinstance(node, ScalarNode):
        return _scalar_hint(node, kinds, schema, root)
    if isinstance(node, SequenceNode) and not node.items and "array" in kinds:
        return "Add an item, or remove the key"
    if isinstance(node, MappingNode) and "array" in kinds and "object" not in kinds:
        return _list_hint(node, schema, root)
    if isinstance(node, SequenceNode) and "x-meant-list" in schema:
        return _mapping_hint(node, schema, root)
    return None


def _mapping_hint(node: SequenceNode, schema: dict[str, Any], root: dict[str, Any]) -> str | None:
    """Return the mapping that somebody meant who wrote its values alone."""
    data = dict(zip(schema["x-meant-list"], map(to_data, node.items), strict=False))
    if len(data) < len(node.items) or any(
        True for _ in differences(data, {**schema, "$defs": root.get("$defs", {})})
    ):
        return None
    return f"Write {_flow(data)}"


def _flow(data: Mapping[str, object]) -> str:
    return f"{{{', '.join(f'{key}: {value}' for key, value in data.items())}}}"


def _list_hint(node: MappingNode, schema: dict[str, Any], root: dict[str, Any]) -> str:
    """Return how a list is written of which there is one item without its bracket."""
    span = node.span
    text = span.source.line(span.line)[span.column - 1 : (span.end_column or span.column) - 1]
    item = {**schema.get("items", {}), "$defs": root.get("$defs", {})}
    if (
        text.startswith("{")
        and text.endswith("}")
        and not any(True for _ in differences(to_data(node), item))
    ):
        return f"Write [{text}]"
    if meant := _meant_item(node, item):
        return f"Write [{meant}]"
    return "Begin each item with '- ', or write [ … ]"


def _meant_item(node: MappingNode, item: dict[str, Any]) -> str | None:
    """Return the item that somebody meant whose words are those of another program, or who wrote one `key: value`."""
    written = to_data(node)
    assert isinstance(written, dict)
    data: dict[str, Any] = dict(written)
    keys = item.get("x-meant-item", ())
    if len(data) == 1 and keys and not data.keys() & item["properties"].keys():
        data = dict(zip(keys, next(iter(data.items())), strict=True))
    for difference in tuple(differences(data, item)):
        key = str(difference.path[0]) if len(difference.path) == 1 else ""
        word = _meant_word(str(data[key]), difference.schema) if key in data else None
        if word is None:
            return None
        data[key] = word
    plain = all(isinstance(value, int) or re.fullmatch(r"\w[\w. ]*", str(value)) for value in data.values())
    return _flow(data) if plain and not any(True for _ in differences(data, item)) else None


def _meant_word(text: str, schema: dict[str, Any]) -> str | None:
    """Return the word of a list of words that is closest to a text, or the default."""
    words: dict[str, str] = schema.get("x-meant", {})
    if found := next((value for pattern, value in words.items() if re.fullmatch(pattern, text)), None):
        return found
    known = [str(value) for value in schema.get("enum", ())]
    return next(iter(get_close_matches(text, known, n=1, cutoff=0.55)), None) or _default_word(schema)


def _default_word(schema: dict[str, Any]) -> str | None:
    """Return the word that the description of a choice gives as its default."""
    default = _DEFAULT_WORD.search(schema.get("description", ""))
    return default[1] if default and default[1] in schema.get("enum", ()) else None


def _example_hint(schema: dict[str, Any]) -> str | None:
    """Return what can be written in any case: an example of the schema, or the default that it describes."""
    if "examples" in schema:
        return f"Write {schema['examples'][0]}"
    default = _DEFAULT.search(schema.get("description", ""))
    return f"Write {default[1]}, the default" if default else None


def _meant(text: str, schema: dict[str, Any]) -> str | None:
    """Return the value that somebody meant who wrote a word of another program (`x-meant`)."""
    words: dict[str, str] = schema.get("x-meant", {})
    found = next((value for pattern, value in words.items() if re.fullmatch(pattern, text)), None)
    if found is not None and ": " in found:
        return f"Write `{found}` instead of this line"
    return None if found is None else f"Write {found}" if re.fullmatch(r"\w+", found) else f"Write '{found}'"


def _empty_hint(kinds: list[str]) -> str:
    """Return what to do about a key without a value."""
    if "array" in kinds:
        return "Add an item, or remove the key"
    return (
        "Add a `key: value`, or remove the key" if kinds == ["object"] else "Write a value, or remove the key"
    )


def _scalar_hint(
    node: ScalarNode, kinds: list[str], schema: dict[str, Any], root: dict[str, Any]
) -> str | None:
    text = node.text
    if schema.get("x-format") == "version":
        if node.text == str(schema["const"]):
            return "Remove the quotes"
        later = isinstance(node.value, int) and node.value > schema["const"]
        return "A later microros-gen wrote the file: update microros-gen" if later else None
    if meant := _meant(text, schema):
        return meant
    if "enum" in schema:
        word = _default_word(schema)
        known = [str(value) for value in schema["enum"]]
        return nearest(text, known) or (f"Write {word}, the default" if word else None)
    if words := _WORDS.fullmatch(schema.get("pattern", "")):
        found = nearest(text, words[1].split("|"))
        if found or "array" in kinds:
            return found or _example_hint(schema)
    if "array" in kinds and node.value is not None:
        return f"Write it as a list: [{text}]"
    if "boolean" in kinds and text.lower() in _OLD_BOOLEANS:
        return f"'{text}' is a text in YAML 1.2; write {_OLD_BOOLEANS[text.lower()]}"
    if node.value is None:
        return _empty_hint(kinds)
    numeric = "integer" in kinds or "number" in kinds
    if numeric and _OLD_NUMBER.fullmatch(text):
        return f"'{text}' is a text in YAML 1.2; write the number in decimal, or in hex with 0x"
    if kinds == ["string"] and not isinstance(node.value, str) and "pattern" not in schema:
        return f'Put it into quotes: "{text}"'
    if kinds == ["object"] and key_without_space(text, schema) is not None:
        beginning, _, value = text.partition(":")
        return f"Write `{beginning}: {value}`, with a space after the colon"
    profile = _QOS_PROFILES.get(text.lower().removeprefix("rmw_qos_profile_"))
    if profile is not None and "reliability" in schema.get("properties", {}):
        return f"Write `qos: {profile}`"
    if kinds == ["object"]:
        return _item_hint(node, schema, root)
    corrected = _full_type(text, schema.get("x-format"))
    hint = f"Write {corrected}" if corrected else value_hint(node, schema)
    return hint or (_example_hint(schema) if isinstance(node.value, (str, bool)) else None)


def _item_hint(node: ScalarNode, schema: dict[str, Any], root: dict[str, Any]) -> str | None:
    """Return how a mapping is written of which there is only a text, a valid value of its first key."""
    first, *others = schema.get("required", [])[:2] or [None]
    if first is None or not re.fullmatch(r"[\w/~-]+", node.text):
        return None
    wanted = {**schema.get("properties", {}).get(first, {}), "$defs": root.get("$defs", {})}
    if any(True for _ in differences(node.value, wanted)):
        return None
    return f"Write {{{first}: {node.text}{', …' if others else ''}}}"


def _full_type(text: str, kind: str | None) -> str | None:
    if kind not in (*_KINDS_OF_TYPE, _ANY_KIND):
        return None
    match = _LOOSE_TYPE.fullmatch(text)
    if match is None:
        return None
    package, written, name = match.groups()
    if kind == _ANY_KIND:
        kind = written or "msg"
        if written is None and name in _KINDS_OF_TYPE:
            return f"{package}/{name}"
    words = name if name[:1].isupper() else "".join(word[:1].upper() + word[1:] for word in name.split("_"))
    return f"{package}/{kind}/{words}"
