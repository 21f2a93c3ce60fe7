# SPDX-License-Identifier: Apache-2.0
"""Short ways to resolve profiles and applications."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from microros_gen.application.model import Application
from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.documents.named import Named
from microros_gen.selection.component import Catalogue, Middleware
from microros_gen.selection.find_components import load_catalogue
from microros_gen.selection.find_profiles import load_middleware, load_profiles
from microros_gen.selection.profiles import resolve_profiles
from microros_gen.selection.resolve import resolve_selection
from tests.support.ids import without_id
from tests.support.selection.small_catalogue import Outcome, small_catalogue


def parts_of(application: Application) -> tuple[str, ...]:
    """Return the parts of the small catalogue that the target stands on."""
    return ("port_posix",) if application.target.name == "host" else ()


@pytest.fixture(scope="session")
def catalogue() -> Catalogue:
    return small_catalogue()


@pytest.fixture(scope="session")
def middleware() -> Middleware:
    return load_middleware()


@pytest.fixture
def resolve(catalogue: Catalogue, middleware: Middleware) -> Callable[..., Outcome]:
    """Resolve profiles by name, or the text of an application file, in a folder."""

    def run(
        *profiles: str, text: str = "", folder: Path = Path(), parts: tuple[str, ...] | None = None
    ) -> Outcome:
        found_diagnostics = Diagnostics()
        application = Application()
        if text:
            parsed = parse_application(Source("microros.yaml", text), found_diagnostics)
            assert parsed is not None, [without_id(d.headline()) for d in found_diagnostics]
            application = parsed
        names = [Named(name) for name in profiles] or list(application.profiles)
        resolved = resolve_profiles(load_profiles(names, folder, found_diagnostics), found_diagnostics)
        below = parts_of(application) if parts is None else parts
        selection = resolve_selection(application, resolved, catalogue, middleware, found_diagnostics, below)
        return Outcome(selection, tuple(without_id(d.headline()) for d in found_diagnostics))

    return run


@pytest.fixture(scope="session")
def real_catalogue() -> Catalogue:
    return load_catalogue()


@pytest.fixture
def resolve_with(middleware: Middleware) -> Callable[..., Outcome]:
    """Resolve built-in profiles with a catalogue and the text of an application file."""

    def run(parts: Catalogue, *profiles: str, text: str) -> Outcome:
        found_diagnostics = Diagnostics()
        application = parse_application(Source("microros.yaml", text), found_diagnostics)
        assert application is not None
        resolved = resolve_profiles(
            load_profiles([Named(n) for n in profiles], Path(), found_diagnostics), found_diagnostics
        )
        selection = resolve_selection(
            application, resolved, parts, middleware, found_diagnostics, parts_of(application)
        )
        return Outcome(selection, tuple(without_id(d.headline()) for d in found_diagnostics))

    return run
