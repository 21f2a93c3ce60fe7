# SPDX-License-Identifier: Apache-2.0
"""The limits of an agent: those of its configuration file, and `--limit` on the command line."""

from __future__ import annotations

import re
from dataclasses import fields
from typing import Any

from microros_gen.agent.configuration.model import AgentFile
from microros_gen.agent.configuration.parser import parse_agent_file
from microros_gen.agent.limits import Limits, limits_with
from microros_gen.diagnostics import Diagnostics, Source, nearest

_VALUE = re.compile(r"[\w.+-]+")


def limits_of(file: AgentFile, options: dict[str, Any]) -> Limits:
    """Return the limits: defaults, then the file's, then those of the command line."""
    chosen: dict[str, Any] = dict(file.limits)
    diagnostics = Diagnostics()
    for text in options["limits"]:
        name, _, value = text.partition("=")
        number = _limit(name, value, diagnostics)
        if number is not None:
            chosen[name] = number
    diagnostics.check()
    if options["client_timeout"] is not None:
        chosen["client_timeout_s"] = options["client_timeout"]
    if options["max_clients"] is not None:
        chosen["clients"] = options["max_clients"]
    return limits_with(chosen)


def _limit(name: str, value: str, diagnostics: Diagnostics) -> float | None:
    """Return the value of `--limit NAME=VALUE`, checked as in a file; an error for an unknown name."""
    names = [field.name for field in fields(Limits)]
    if name not in names:
        hint = nearest(name, names) or f"Known: {', '.join(names)}"
        diagnostics.error(f"unknown limit '{name}'", hint=hint, id="MG-9705")
        return None
    if not _VALUE.fullmatch(value):
        diagnostics.error(
            f"'limits.{name}' must be a number", hint=f"Write --limit {name}=NUMBER", id="MG-9706"
        )
        return None
    found = Diagnostics()
    source = Source("--limit", f"version: 1\nlimits: {{{name}: {value}}}")
    limits = dict(parse_agent_file(source, found).limits)
    for diagnostic in found:
        diagnostics.error(diagnostic.message, hint=diagnostic.hint, id="MG-9707")
    return limits.get(name)
