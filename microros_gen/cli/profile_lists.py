# SPDX-License-Identifier: Apache-2.0
"""Lists of profiles, and what one of them selects."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

from microros_gen.application.model import Application
from microros_gen.cli.tables import format_table
from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.platform.capabilities import capabilities
from microros_gen.platform.find import read_target
from microros_gen.selection.component import Catalogue, Middleware, Profile, ProfileSet
from microros_gen.selection.extension import INSTALLED
from microros_gen.selection.find_profiles import load_builtin_profiles, load_middleware, load_profiles
from microros_gen.selection.model import Selection
from microros_gen.selection.outside import component_names, with_outside
from microros_gen.selection.profiles import resolve_profiles
from microros_gen.selection.resolve import resolve_selection


def listed_profiles() -> Mapping[str, Profile]:
    """Return the built-in profiles, and those of installed packages with all that they extend."""
    builtin, diagnostics = load_builtin_profiles(), Diagnostics()
    names = dict.fromkeys(name for e in INSTALLED.installed() for name in e.profile_names())
    loaded = load_profiles([Named(name) for name in names], Path(), diagnostics)
    diagnostics.check()
    by_name = {p.name: p for p in loaded.profiles.values() if not p.builtin}
    if not by_name:
        return builtin
    known = {**builtin, **{name: _by_name(by_name[name], loaded) for name in sorted(by_name)}}
    return MappingProxyType(known)


def _by_name(profile: Profile, loaded: ProfileSet) -> Profile:
    """Return a profile that refers to what it extends by name instead of by file."""
    bases = (Named(loaded.profiles[base.name].name, base.span) for base in profile.extends)
    return replace(profile, extends=tuple(bases))


def select_profile(name: str, near: Path, catalogue: Catalogue) -> Selection:
    """Return what profile `name` selects for the host; raises UserError where it is faulty or unknown."""
    diagnostics = Diagnostics()
    loaded = load_profiles([Named(name)], near, diagnostics)
    diagnostics.check()
    return _select(loaded, catalogue, load_middleware(), diagnostics)


def _select(
    loaded: ProfileSet, catalogue: Catalogue, middleware: Middleware, diagnostics: Diagnostics
) -> Selection:
    resolved = resolve_profiles(loaded, diagnostics)
    diagnostics.check()
    application = Application(profiles=loaded.requested)
    names = component_names(application, resolved)
    catalogue = with_outside(catalogue, INSTALLED, names, capabilities(), diagnostics)
    diagnostics.check()
    host = read_target(application.target.name, near=Path(), span=None, diagnostics=diagnostics)
    parts = tuple(part.component.name for part in host.target.parts) if host is not None else ()
    selection = resolve_selection(application, resolved, catalogue, middleware, diagnostics, parts)
    diagnostics.check()
    for diagnostic in diagnostics:
        echo_found(f"{diagnostic.render()}\n")
    return selection


def list_profiles(profiles: Mapping[str, Profile], catalogue: Catalogue, kind: str) -> str:
    """Return the list of `profiles` in format `kind`; a profile is ready when all that it selects is."""
    middleware = load_middleware()
    ready = {}
    for name in profiles:
        selection = _select(ProfileSet((Named(name),), profiles), catalogue, middleware, Diagnostics())
        ready[name] = all(chosen.component.ready for chosen in selection.components)
    if kind == "json":
        data = [_data(profile, ready[profile.name]) for profile in profiles.values()]
        return json.dumps(data, indent=2, sort_keys=True, ensure_ascii=False) + "\n"
    if kind == "dot":
        return _dot(profiles)
    rows = [
        (p.name, "ready" if ready[p.name] else "planned", ", ".join(_parts(p)), _summary(p))
        for p in profiles.values()
    ]
    return format_table(("PROFILE", "STATUS", "COMPONENTS", "WHAT FOR"), rows)


def _parts(profile: Profile) -> list[str]:
    names = [change.name for change in profile.components]
    return [*names, *(f"{axis}: {value.name}" for axis, value in profile.axes.items())]


def _summary(profile: Profile) -> str:
    return f"{profile.summary}{_origin(profile, ' (from {})')}"


def _origin(profile: Profile, text: str = "{}") -> str:
    """Return where a profile is from that does not ship with the tool."""
    if profile.builtin or profile.span is None:
        return ""
    extension = INSTALLED.profile(profile.name, None, Diagnostics())
    return text.format(extension.origin) if extension is not None else ""


def _data(profile: Profile, ready: bool) -> dict[str, object]:
    return {
        "name": profile.name,
        "summary": profile.summary,
        "status": "ready" if ready else "planned",
        "components": [change.name for change in profile.components],
        "axes": {axis: value.name for axis, value in profile.axes.items()},
        **({"from": origin} if (origin := _origin(profile)) else {}),
    }


def _dot(profiles: Mapping[str, Profile]) -> str:
    lines = ["digraph profiles {", "  rankdir=LR;"]
    lines += [f'  "profile {name}" [label="{name}", shape=ellipse];' for name in profiles]
    parts = sorted({part for profile in profiles.values() for part in _parts(profile)})
    lines += [f'  "{part}" [shape=box];' for part in parts]
    lines += [f'  "profile {n}" -> "{part}";' for n, profile in profiles.items() for part in _parts(profile)]
    return "\n".join([*lines, "}", ""])
