# SPDX-License-Identifier: Apache-2.0
"""The page of all diagnostics, read from the calls that make them: id, message, hint, explanation."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

import microros_gen
from microros_gen.diagnostics.explanations import explanations
from microros_gen.records import dataclass

from . import markdown

PACKAGE = Path(microros_gen.__file__).parent
_SUBJECTS = {
    "diagnostics": "The tool itself",
    "documents": "YAML files",
    "interfaces": "Interfaces",
    "application": "The application file",
    "selection": "Profiles and components",
    "typesupport": "Limits and storage of messages",
    "platform": "Targets",
    "schedule": "Deadlines of tasks",
    "client": "Entities, streams and boards",
    "output": "The output folder",
    "toolchain": "Compilers and emulators",
    "image": "Images and budgets",
    "compiler": "The command as a whole",
    "package": "Packages",
    "migrate": "init",
    "ros": "ROS 2",
    "parameter_server": "The parameter server",
    "modes": "System modes",
    "ros_tools": "Commands on a ROS graph",
    "mode_manager": "The mode manager",
    "agent": "The agent",
    "components": "Components",
    "cli": "The command line",
}
_PLACE_FIRST = {"IdlError", "_DeclarationError", "self._error"}
"""Calls whose first argument is the place and whose second one is the message."""
_INTRODUCTION = """\
Each error and warning ends with an id in brackets, `[MG-3012]`, which stays the same when the words change. Parts in
braces are placeholders for names, numbers and paths. `microros-gen explain MG-3012` prints the explanation."""


@dataclass(frozen=True)
class Documented:
    """One diagnostic: `message` and `hint` with parts in braces; `is_error` false: a warning."""

    id: str
    message: str
    hint: str
    is_error: bool
    subject: str


@cache
def diagnostics() -> tuple[Documented, ...]:
    """Return every diagnostic of the package, sorted by id; one that several places give is there several times."""
    found = [reported for path in sorted(PACKAGE.rglob("*.py")) for reported in _of_module(path)]
    return tuple(sorted(found, key=lambda reported: (reported.id, reported.message)))


def page() -> str:
    """Return the page."""
    parts = ["# Diagnostics", _INTRODUCTION]
    everything = diagnostics()
    known = explanations()
    for subject, title in _SUBJECTS.items():
        rows = [reported for reported in everything if reported.subject == subject]
        if rows:
            parts += [f"## {title}", _table(rows, known)]
    return "\n\n".join(parts) + "\n"


def _table(rows: list[Documented], known: Mapping[str, str]) -> str:
    return markdown.table(
        ("id", "kind", "message and hint", "explanation"),
        (
            (
                f'<span id="{reported.id.lower()}">{reported.id}</span>',
                "error" if reported.is_error else "warning",
                f"{markdown.cell(reported.message)}<br>*{markdown.cell(reported.hint)}*".removesuffix(
                    "<br>**"
                ),
                markdown.cell(known.get(reported.id, "")),
            )
            for reported in rows
        ),
    )


def _of_module(path: Path) -> Iterator[Documented]:
    text = path.read_text(encoding="utf-8")
    nodes = list(ast.walk(ast.parse(text))) if '"MG-' in text else []
    functions = [n for n in nodes if isinstance(n, (ast.FunctionDef, ast.AsyncFunctionDef))]
    for node in nodes:
        function = _owner(functions, node) if isinstance(node, ast.Call) and _identity(node) else None
        if isinstance(node, ast.Call) and function is not None:
            yield _of_call(node, _texts(function, node), path.relative_to(PACKAGE).parts[0])


def _identity(node: ast.Call) -> str:
    """Return the id of the diagnostic that a call makes, "" for every other call."""
    for keyword in node.keywords:
        if keyword.arg == "id" and isinstance(keyword.value, ast.Constant):
            identity = str(keyword.value.value)
            return identity if identity.startswith("MG-") else ""
    return ""


def _texts(function: ast.AST, before: ast.Call) -> dict[str, ast.expr]:
    """Return the variables with one value at a call: those set once, or last in a block that holds the call."""
    found: dict[str, list[ast.expr]] = {}
    nearest: dict[str, ast.expr] = {}
    for block in _blocks(function):
        reaches = any(_holds(statement, before) for statement in block)
        for statement in block:
            if not isinstance(statement, ast.Assign):
                continue
            for target in statement.targets:
                if isinstance(target, ast.Name):
                    found.setdefault(target.id, []).append(statement.value)
                    if reaches and statement.lineno <= before.lineno:
                        nearest[target.id] = statement.value
    return {name: values[0] for name, values in found.items() if len(values) == 1} | nearest


def _blocks(function: ast.AST) -> Iterator[list[ast.stmt]]:
    """Yield each list of statements of a function, outer ones first."""
    for node in ast.walk(function):
        for name in ("body", "orelse", "finalbody"):
            block = getattr(node, name, None)
            if isinstance(block, list):
                yield block


def _holds(statement: ast.stmt, node: ast.Call) -> bool:
    return statement.lineno <= node.lineno and (statement.end_lineno or 0) >= (node.end_lineno or 0)


def _owner(
    functions: list[ast.FunctionDef | ast.AsyncFunctionDef], node: ast.Call
) -> ast.FunctionDef | ast.AsyncFunctionDef | None:
    """Return the innermost function that holds `node`."""
    holding = [
        f for f in functions if f.lineno <= node.lineno and (f.end_lineno or 0) >= (node.end_lineno or 0)
    ]
    return max(holding, key=lambda f: f.lineno, default=None)


def _of_call(node: ast.Call, texts: dict[str, ast.expr], subject: str) -> Documented:
    named = {keyword.arg: keyword.value for keyword in node.keywords}
    arguments = list(node.args)
    if ast.unparse(node.func) in _PLACE_FIRST:
        arguments[:2] = [arguments[1], arguments[0]]
    if ast.unparse(node.func) == "NameFault":  # a predicate of the name
        arguments[0] = ast.BinOp(ast.Constant("the name '{name}' "), ast.Add(), arguments[0])
    if ast.unparse(node.func) == "InvalidValueError":
        arguments.insert(1, ast.Constant(None))
    message = arguments[0] if arguments else named.get("message")
    hint = arguments[2] if len(arguments) > 2 else named.get("hint")
    warns = isinstance(node.func, ast.Attribute) and node.func.attr == "warning"
    warns |= "severity" in named or ast.unparse(node.func) == "Caveat"
    return Documented(_identity(node), _pattern(message, texts), _pattern(hint, texts), not warns, subject)


def _pattern(node: ast.expr | None, texts: dict[str, ast.expr]) -> str:
    """Return a text as it is written, with what is put in at run time in braces."""
    if node is None or (isinstance(node, ast.Constant) and node.value is None):
        return ""
    if isinstance(node, ast.Constant):
        return str(node.value)
    if isinstance(node, ast.JoinedStr):
        return "".join(_pattern(value, texts) for value in node.values)
    if isinstance(node, ast.FormattedValue):
        return f"{{{_name(node.value)}}}"
    if isinstance(node, ast.BinOp):
        return _pattern(node.left, texts) + _pattern(node.right, texts)
    if isinstance(node, ast.IfExp):
        return f"{_pattern(node.body, texts)} / {_pattern(node.orelse, texts)}".strip(" /")
    if isinstance(node, ast.BoolOp):
        return " / ".join(filter(None, (_pattern(value, texts) for value in node.values)))
    if isinstance(node, ast.Name) and node.id in texts:
        return _pattern(texts[node.id], {k: v for k, v in texts.items() if k != node.id})
    return f"{{{_name(node)}}}"


def _name(node: ast.expr) -> str:
    """Return a word for what is put in: the last name of the expression."""
    names = [
        n.attr if isinstance(n, ast.Attribute) else n.id
        for n in ast.walk(node)
        if isinstance(n, (ast.Attribute, ast.Name))
    ]
    return names[0].lstrip("_") if names else "…"
