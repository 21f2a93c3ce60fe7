# SPDX-License-Identifier: Apache-2.0
"""Model files of a given size: a system of subsystems of nodes, each with modes and rules."""

from __future__ import annotations

from collections.abc import Iterator


def large_model(subsystems: int, parts: int, is_diagnosed: bool = False) -> str:
    """Return a robot of `subsystems` systems of `parts` nodes each.

    Every subsystem goes from FULL to LOW when one of its nodes cannot run, and stops when that is not enough; the
    robot then goes the same way. `is_diagnosed`: a warning of a node leads to LOW, too.
    """
    lines = [*_system("robot", [f"s{i}" for i in range(subsystems)])]
    for i in range(subsystems):
        names = [f"s{i}n{j}" for j in range(parts)]
        lines += _system(f"s{i}", names)
        lines += _diagnosed(names) if is_diagnosed else ()
        for j, name in enumerate(names):
            lines += _node(name, 10 * i + j)
    return "\n".join(lines) + "\n"


def _system(name: str, parts: list[str]) -> Iterator[str]:
    yield from (f"{name}:", "  ros__parameters:", "    type: system", "    parts:")
    yield from (f"      {part}" for part in parts)
    yield "    modes:"
    for mode, target in (("__DEFAULT__", "inactive"), ("LOW", "active.LOW"), ("FULL", "active.FULL")):
        yield f"      {mode}:"
        yield from (f"        {part}: {target}" for part in parts)
    yield "    rules:"
    for part in parts:
        for state in ("inactive", "unconfigured", "errorprocessing", "activating"):
            yield f"      low_{part}_{state}:"
            yield "        if_target: active.FULL"
            yield f"        if_part: [{part}, {state}]"
            yield "        new_target: active.LOW"
        yield f"      stop_{part}:"
        yield "        if_target: active.LOW"
        yield f"        if_part: [{part}, errorprocessing]"
        yield "        new_target: inactive"


def _diagnosed(parts: list[str]) -> Iterator[str]:
    for part in parts:
        yield f"      warned_{part}:"
        yield "        if_target: active.FULL"
        yield f"        if_part: [{part}, active.FULL]"
        yield "        diagnostics: {level: warn, names: [motor*, heat]}"
        yield "        new_target: active.LOW"


def _node(name: str, number: int) -> Iterator[str]:
    yield from (f"{name}:", "  ros__parameters:", "    type: node", "    modes:")
    for i, mode in enumerate(("__DEFAULT__", "LOW", "FULL")):
        yield from (f"      {mode}:", "        ros__parameters:", f"          rate: {number}.{i}")
