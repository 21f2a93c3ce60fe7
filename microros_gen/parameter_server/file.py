# SPDX-License-Identifier: Apache-2.0
"""The file of a parameter server: JSON, written as a whole, so that the old or the new one is there at any time."""

from __future__ import annotations

import fcntl
import json
import os
import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.parameter_server.declared import Declared
from microros_gen.parameter_server.node import Held, HeldNode
from microros_gen.parameter_server.values import TYPE_NAMES, type_name, value_from_json

FORMAT, VERSION = "microros-gen parameters", 1
_NODE = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+")
_TYPES = {
    "description": str,
    "constraints": str,
    "read_only": bool,
    "dynamic_typing": bool,
    "size_max": int,
}


class FileInUseError(UserError):
    """Another server has the file."""


class ParameterFile:
    """The file of one server at a time; `close` releases it."""

    def __init__(self, path: Path) -> None:
        """Lock it. Raises UserError: the folder cannot be written; FileInUseError: another server has the file."""
        self.path = path
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._lock = os.open(path.with_name(f"{path.name}.lock"), os.O_CREAT | os.O_RDWR, 0o644)
        except OSError as error:
            message = f"'{path}' cannot be written: {error.strerror}"
            raise UserError([Diagnostic(message, hint="Name another file", id="MG-9730")]) from error
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            os.close(self._lock)
            message, hint = f"another parameter server uses '{path}'", "Stop it, or name another file"
            raise FileInUseError([Diagnostic(message, hint=hint, id="MG-9726")]) from error

    def close(self) -> None:
        """Let others have the file."""
        os.close(self._lock)

    def load(self, make: Callable[[str], HeldNode]) -> tuple[tuple[HeldNode, ...], str]:
        """Return the nodes of the file, and what is wrong with it; what cannot be read is kept under another name.

        Raises UserError for a file of a later version, and for a damaged one that cannot be renamed: nothing is read
        or written.
        """
        try:
            data = self.path.read_bytes()
        except FileNotFoundError:
            return (), ""
        except OSError as error:
            message = f"'{self.path}' cannot be read: {error.strerror}"
            raise UserError([Diagnostic(message, hint="Name another file", id="MG-9729")]) from error
        try:
            tree = json.loads(data)
            if tree["format"] == FORMAT and isinstance(tree["version"], int) and tree["version"] > VERSION:
                message = f"'{self.path}' is of version {tree['version']}; this program knows {VERSION}"
                hint = "Use a later microros-gen, or name another file"
                raise UserError([Diagnostic(message, hint=hint, id="MG-9727")])
            if (tree["format"], tree["version"]) != (FORMAT, VERSION):
                raise ValueError("another format")
            return tuple(_node(name, entry, make(name)) for name, entry in tree["nodes"].items()), ""
        except (ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError) as error:
            kept = self._keep_damaged()
            return (
                (),
                f"'{self.path}' is damaged ({error}): it is kept as '{kept.name}', and a new one begins",
            )

    def save(self, nodes: Iterable[HeldNode]) -> None:
        """Write the nodes. Raises OSError; the file of before is there then."""
        tree = {"format": FORMAT, "version": VERSION, "nodes": {node.name: _entry(node) for node in nodes}}
        temporary = self.path.with_name(f"{self.path.name}.new")
        with temporary.open("w", encoding="utf-8", newline="\n") as stream:
            json.dump(tree, stream, indent=1, ensure_ascii=False)
            stream.write("\n")
            stream.flush()
            os.fsync(stream.fileno())
        temporary.replace(self.path)

    def _keep_damaged(self) -> Path:
        number = 1
        while (kept := self.path.with_name(f"{self.path.name}.damaged-{number}")).exists():
            number += 1
        try:
            self.path.replace(kept)
        except OSError as error:
            message = f"'{self.path}' is damaged and cannot be renamed: {error.strerror}"
            raise UserError([Diagnostic(message, hint="Name another file", id="MG-9731")]) from error
        return kept


def _entry(node: HeldNode) -> Mapping[str, Any]:
    parameters = {name: _held_entry(held) for name, held in node.parameters.items()}
    aside = {
        name: [{"type": type_name(value.type), "value": value.to_json()} for value in values]
        for name, values in node.aside.items()
        if values
    }
    return {"parameters": parameters, **({"aside": aside} if aside else {})}


def _held_entry(held: Held) -> Mapping[str, Any]:
    declared = held.declared
    entry: dict[str, Any] = {
        "type": type_name(held.value.type),
        "value": held.value.to_json(),
        "written": held.written,
        "pending": held.pending,
        "declared": type_name(declared.type),
    }
    entry.update({key: getattr(declared, key) for key in _TYPES if getattr(declared, key)})
    if declared.range is not None:
        entry["range"] = list(declared.range)
    if declared.one_of:
        entry["one_of"] = list(declared.one_of)
    return entry


def _node(name: str, entry: Mapping[str, Any], node: HeldNode) -> HeldNode:
    if not _NODE.fullmatch(name):
        raise ValueError(f"'{name}' is no node")
    for parameter, values in entry["parameters"].items():
        node.parameters[_text(parameter)] = _held(parameter, values)
    for parameter, values in entry.get("aside", {}).items():
        node.aside[_text(parameter)] = [value_from_json(value["type"], value["value"]) for value in values]
    return node


def _held(name: str, entry: Mapping[str, Any]) -> Held:
    value = value_from_json(entry["type"], entry["value"])
    members = {key: entry[key] for key in _TYPES if key in entry}
    for key, member in members.items():
        if type(member) is not _TYPES[key]:
            raise ValueError(f"{key} of '{name}'")
        _text(str(member))
    kind = entry["declared"]
    bounds = entry.get("range")
    ends = None if bounds is None else [value_from_json(kind, bound).value for bound in bounds]
    if ends is not None and len(ends) != 3:
        raise ValueError(f"range of '{name}'")
    declared = Declared(
        name,
        TYPE_NAMES.index(kind),
        range=None if ends is None else (ends[0], ends[1], ends[2]),
        one_of=tuple(value_from_json(kind, value).value for value in entry.get("one_of", ())),
        **members,
    )
    if not isinstance(entry["pending"], bool) or not isinstance(entry["written"], (int, float)):
        raise ValueError(f"times of '{name}'")
    return Held(declared, value, float(entry["written"]), entry["pending"])


def _text(text: str) -> str:
    """Return a text that UTF-8 can encode, as messages and the file do. Raises UnicodeEncodeError, a ValueError."""
    text.encode()
    return text
