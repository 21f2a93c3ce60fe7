# SPDX-License-Identifier: Apache-2.0
"""Pages of the YAML files, from the JSON Schemas that the tool checks them with."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from generators.markdown import cell, table
from microros_gen.documents.schema import Schema, load_schema

_WORDS = {"integer": "whole number", "number": "number", "string": "text", "boolean": "true or false"}
_WORDS |= {"array": "list", "object": "mapping", "null": "nothing"}


def page(title: str, introduction: str, schema_file: Path) -> str:
    """Return the page of one file; `schema_file` is its schema."""
    schema = load_schema(schema_file)
    parts = [f"# {title}", introduction, *_keys(schema, schema, "")]
    for name in _shared(schema):
        part = schema["$defs"][name]
        if any(_named(part)):
            parts += [f"## {name}", cell(part["description"].rstrip(".")) + ".", *_keys(schema, part, name)]
    parts.append(
        f"Made from `{schema_file.parent.name}/{schema_file.name}` below `microros_gen/` (JSON Schema, draft 2020-12),"
        " which editors take as well."
    )
    return "\n\n".join(parts) + "\n"


def _shared(schema: Schema) -> list[str]:
    """Return the definitions that several places refer to: they have their own sections."""
    uses = re.findall(r'"\$ref": "#/\$defs/(\w+)"', json.dumps(schema))
    return sorted({name for name in uses if uses.count(name) > 1})


def _keys(schema: Schema, part: Schema, path: str) -> Iterator[str]:
    """Yield the table of an object's keys, then those of the objects below it."""
    rows, below = [], []
    for key, value in _named(part):
        found, name = _resolved(schema, value)
        here = f"{path}.{key}".lstrip(".")
        inner = [] if name in _shared(schema) else list(_objects(schema, found, here))
        below += inner
        target = (
            anchor(inner[0][0])
            if inner
            else _section(schema, name or _resolved(schema, found.get("items", {}))[1])
        )
        required = " Required." if key in part.get("required", ()) else ""
        rows.append((_key_cell(key, target), _value(schema, found), cell(_said(value, found)) + required))
    if rows:
        yield table(("key", "value", "meaning"), rows)
    for here, object_part in below:
        title = here.translate({ord("<"): "(", ord(">"): ")", ord("_"): "\\_"})
        yield f"## {title} {{: #{anchor(here)} }}"
        if object_part.get("description"):
            yield cell(object_part["description"].rstrip(".")) + "."
        yield from _keys(schema, object_part, here)


def _section(schema: Schema, name: str) -> str:
    """Return the anchor of a definition that has its own section; empty: it has none."""
    return name if name in _shared(schema) and any(_named(schema["$defs"][name])) else ""


def _named(part: Schema) -> Iterator[tuple[str, Schema]]:
    yield from part.get("properties", {}).items()
    for value in part.get("patternProperties", {}).values():
        yield f"<{part.get('x-keys', 'name')}>", value


def _resolved(schema: Schema, part: Schema) -> tuple[Schema, str]:
    """Return a part after its `$ref`, and the name of the definition."""
    reference = part.get("$ref", "")
    name = reference.removeprefix("#/$defs/") if reference.startswith("#") else ""
    return ({**schema["$defs"][name], **part} if name else part), name


def _objects(schema: Schema, part: Schema, path: str) -> Iterator[tuple[str, Schema]]:
    """Yield the objects with their own keys that a value may be: itself, the items of a list, alternatives."""
    if any(_named(part)):
        yield path, part
    items, name = _resolved(schema, part.get("items", {}))
    if name not in _shared(schema):
        yield from _objects(schema, items, f"{path}[]") if items else ()
    for other in (*part.get("anyOf", ()), *part.get("oneOf", ())):
        yield from _objects(schema, _resolved(schema, other)[0], path)


def anchor(path: str) -> str:
    """Return the anchor of the keys below `path`: `nodes[].qos` → `nodes-qos`."""
    return "".join(c if c.isalnum() or c == "_" else "-" for c in path.replace("[]", "")).strip("-")


def _key_cell(key: str, target: str) -> str:
    shown = f"*{cell(key[1:-1])}*" if key.startswith("<") else f"`{key}`"
    return f"[{shown}](#{target})" if target else shown


def _value(schema: Schema, part: Schema) -> str:
    if "x-reserved" in part:
        return "reserved"
    if not part.get("$ref", "#").startswith("#"):
        return "mapping"
    if "const" in part:
        return f"`{part['const']}`"
    if "enum" in part:
        return ", ".join(f"`{value}`" for value in part["enum"])
    kinds = part.get("type", [])
    words = [_WORDS[kind] for kind in ([kinds] if isinstance(kinds, str) else kinds)]
    words = [word + (_range(part) if "number" in word else "") for word in words]
    for other in (*part.get("anyOf", ()), *part.get("oneOf", ())):
        words.append(_value(schema, _resolved(schema, other)[0]))
    if "items" in part:
        item = _value(schema, _resolved(schema, part["items"])[0])
        words = [word.replace("list", f"list of: {item}") for word in words]
    return " or ".join(dict.fromkeys(words))


def _range(part: Schema) -> str:
    least, most = part.get("minimum"), part.get("maximum")
    if least is not None and most is not None:
        return f" {least} to {most}"
    if least is not None:
        return f" from {least} on"
    return "" if most is None else f" up to {most}"


def _said(value: Schema, found: Schema) -> str:
    words: list[Any] = [value.get("description") or found.get("description", "")]
    if "default" in found and "Default:" not in words[0]:
        default = found["default"]
        words.append(f"Default: {str(default).lower() if isinstance(default, bool) else default}")
    if value.get("deprecated") or found.get("deprecated"):
        words.append(f"Deprecated: {found.get('deprecationMessage', '')}")
    return ". ".join(str(word).rstrip(".") for word in words if word) + ("." if words[0] else "")
