# SPDX-License-Identifier: Apache-2.0
"""The page of the Python API, from the docstrings of `microros_gen.compiler`."""

from __future__ import annotations

import dataclasses
import inspect

from generators.markdown import table
from microros_gen import compiler

EXAMPLE = """\
from pathlib import Path

from microros_gen import compiler

options = compiler.Options(profiles=("pure_sender",), interfaces=("std_msgs/msg/Int32",))
try:
    planned = compiler.plan(compiler.resolve(compiler.read(options)))
except compiler.UserError as error:
    raise SystemExit("\\n".join(diagnostic.render() for diagnostic in error.diagnostics))
for warning in planned.warnings:
    print(warning.render())

out = Path("build/sender")
compiler.write(compiler.render(planned), out)
built = compiler.compile(planned, out)
print(out / built.report.library)
"""
_INTRODUCTION = """\
`microros_gen.compiler` does what the command line does: read, resolve, plan, render, write, compile. Use it to generate
code from a build script or a test. Nothing is printed; results are frozen data classes."""


def page() -> str:
    """Return the page."""
    parts = ["# Python API", _INTRODUCTION, f"```python\n{EXAMPLE}```"]
    members = [(name, getattr(compiler, name)) for name in compiler.__all__]
    parts += ["## Functions"]
    parts += [_function(name, member) for name, member in members if inspect.isfunction(member)]
    parts += ["## Constants"]
    parts += [f"### {name}\n\n`{member}`" for name, member in members if isinstance(member, str)]
    parts += ["## Data"]
    parts += [_class(name, member) for name, member in members if inspect.isclass(member)]
    return "\n\n".join(parts) + "\n"


def _function(name: str, member: object) -> str:
    signature = str(inspect.signature(member)).replace("'", "")  # type: ignore[arg-type]
    return f"### {name}\n\n```python\n{name}{signature}\n```\n\n{inspect.getdoc(member)}"


def _class(name: str, member: type) -> str:
    text = inspect.getdoc(member) or ""
    if not dataclasses.is_dataclass(member):
        return f"### {name}\n\n{text}"
    rows = [
        (f"`{field.name}`", f"`{str(field.type).replace('|', chr(92) + '|')}`")
        for field in dataclasses.fields(member)
    ]
    return f"### {name}\n\n{text}\n\n{table(('field', 'type'), rows)}"
