# SPDX-License-Identifier: Apache-2.0
"""What does not change is made once: the files of components are read once in a process, others once in a run."""

from __future__ import annotations

import fcntl
import os
import pickle
from collections.abc import Callable, Hashable
from pathlib import Path
from types import ModuleType
from typing import ParamSpec, Protocol, TypeVar

import pytest

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.selection import find_components
from microros_gen.selection.component import Component
from microros_gen.selection.component_file import parse_component

Value = TypeVar("Value")
P = ParamSpec("P")
Parse = Callable[[Source, Diagnostics], Component | None]


def once(parse: Parse) -> Parse:
    """Return `parse` with the components kept by name and content of their files, unless it had something to report."""
    kept: dict[Source, Component] = {}

    def parse_once(source: Source, diagnostics: Diagnostics, /) -> Component | None:
        if source in kept and not diagnostics.has_errors():
            return kept[source]
        before = len(list(diagnostics))
        component = parse(source, diagnostics)
        if component is not None and len(list(diagnostics)) == before:
            kept[source] = component
        return component

    return parse_once


class ShareResult(Protocol):
    """Replaces the function `name` of a module during a test: calls with the same `key` share one result."""

    def __call__(
        self,
        module: ModuleType,
        name: str,
        key: Callable[P, Hashable],
        make: Callable[P, object] | None = None,
    ) -> None:
        """`make`: what is called instead of the function. `key` and `make` take the function's arguments."""


@pytest.fixture
def share_result(monkeypatch: pytest.MonkeyPatch) -> ShareResult:
    """Let calls of a slow function in this process share its result."""

    def share(
        module: ModuleType, name: str, key: Callable[P, Hashable], make: Callable[P, object] | None = None
    ) -> None:
        kept: dict[Hashable, object] = {}
        called: Callable[P, object] = make or getattr(module, name)

        def shared(*arguments: P.args, **named: P.kwargs) -> object:
            at = key(*arguments, **named)
            if at not in kept:
                kept[at] = called(*arguments, **named)
            return kept[at]

        monkeypatch.setattr(module, name, shared)

    return share


def share_components() -> None:
    """Let each command that a test runs in this process find the components that another one has read.

    The catalogue takes half of the time of a small `generate`, and the suite runs some thousand of them.
    """
    vars(find_components)[parse_component.__name__] = once(parse_component)


def shared_by_processes(factory: pytest.TempPathFactory, name: str, make: Callable[[Path], Value]) -> Value:
    """Return what `make` returns for a folder `name`: the first process of a run makes it, and the others wait."""
    base = factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / f"shared-{name}"
    kept = folder.with_suffix(".pickle")
    with folder.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if kept.is_file():
            value: Value = pickle.loads(kept.read_bytes())
            return value
        folder.mkdir()
        value = make(folder)
        kept.write_bytes(pickle.dumps(value))
    return value
