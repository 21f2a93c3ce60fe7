# SPDX-License-Identifier: Apache-2.0
"""Finds the JSON Schemas of all kinds of documents, and makes one complete for programs that know no other file."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from microros_gen.documents.schema_check import Schema

_PACKAGE = Path(__file__).parents[1]
_SUFFIX = ".schema.json"
_REFERENCE = re.compile(r'"\$ref": "(urn:[^"#]*)#')


def schema_files(package: Path = _PACKAGE) -> Mapping[str, Path]:
    """Return the schema files below `package`, sorted by the kind of document: their names without `.schema.json`."""
    found = {path.name.removesuffix(_SUFFIX): path for path in package.rglob(f"*{_SUFFIX}")}
    return dict(sorted(found.items()))


def schema_title(path: Path) -> str:
    """Return the title of a schema."""
    return str(json.loads(path.read_text(encoding="utf-8"))["title"])


def complete_schema(path: Path, package: Path = _PACKAGE) -> Schema:
    """Return the schema in `path` with everything that it refers to in other schemas of `package` among its `$defs`."""
    from microros_gen.documents.schema import load_schema

    by_id = {json.loads(p.read_text(encoding="utf-8"))["$id"]: p for p in schema_files(package).values()}
    others: dict[Path, None] = {path: None}
    waiting = [path]
    while waiting:
        for name in _REFERENCE.findall(waiting.pop().read_text(encoding="utf-8")):
            if by_id[name] not in others:
                others[by_id[name]] = None
                waiting.append(by_id[name])
    return load_schema(path, *[other for other in others if other != path])


def schema_text(schema: Schema) -> str:
    """Return a schema as the tool's files have it: an indent of one, in the order of its keys."""
    return json.dumps(schema, indent=1, ensure_ascii=False) + "\n"


def modeline(schema: str) -> str:
    """Return the comment that tells editors the schema of a YAML file; `schema` is a path relative to that file.

    The form is that of yaml-language-server (its README, "Using inlined schema").
    """
    return f"# yaml-language-server: $schema={schema}"
