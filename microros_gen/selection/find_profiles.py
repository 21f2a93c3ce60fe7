# SPDX-License-Identifier: Apache-2.0
"""Finds and reads profiles: those that ship with the tool, and the user's own files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

from microros_gen.diagnostics import Diagnostics, Source, Span, nearest
from microros_gen.documents.files import is_file, read_text
from microros_gen.documents.named import Named
from microros_gen.documents.shipped import profiles_folder
from microros_gen.selection.component import Middleware, Profile, ProfileSet, in_lists
from microros_gen.selection.extension import INSTALLED, Extensions
from microros_gen.selection.profile_file import parse_middleware, parse_profile

MIDDLEWARE_FILE = "middleware.yaml"
_SUFFIXES = (".yaml", ".yml")


def load_builtin_profiles(folder: Path | None = None) -> Mapping[str, Profile]:
    """Return the built-in profiles of `folder` by name, in the order that their files give them.

    Raises UserError where a file of the folder is faulty or not named as its profile.
    """
    root = profiles_folder() if folder is None else folder
    diagnostics = Diagnostics()
    found: dict[str, Profile] = {}
    for path in sorted(root.glob("*.yaml")):
        if path.name != MIDDLEWARE_FILE:
            source = _read(path, f"profiles/{path.name}", diagnostics)
            profile = parse_profile(source, diagnostics, builtin=True) if source else None
            if profile is not None and profile.name != path.stem:
                diagnostics.error(
                    f"'{path.name}' describes '{profile.name}'",
                    profile.span,
                    "Rename one of them",
                    id="MG-4014",
                )
            elif profile is not None:
                found[profile.name] = profile
    diagnostics.check()
    return MappingProxyType({profile.name: profile for profile in sorted(found.values(), key=in_lists)})


def load_middleware(folder: Path | None = None) -> Middleware:
    """Return the middleware table of `folder` (the tool's unless given).

    Raises UserError where it is faulty.
    """
    root = profiles_folder() if folder is None else folder
    diagnostics = Diagnostics()
    source = _read(root / MIDDLEWARE_FILE, f"profiles/{MIDDLEWARE_FILE}", diagnostics)
    middleware = parse_middleware(source, diagnostics) if source else None
    diagnostics.check()
    if middleware is None:
        diagnostics.error(f"'{MIDDLEWARE_FILE}' is empty", id="MG-4015")
        diagnostics.check()
        raise AssertionError
    return middleware


def load_profiles(
    requested: Iterable[Named],
    near: Path,
    diagnostics: Diagnostics,
    builtin_folder: Path | None = None,
    extensions: Extensions = INSTALLED,
) -> ProfileSet:
    """Read the requested profiles and all that they extend.

    A reference is the name of a built-in profile, the name of a file `NAME.yaml` in `near` (the folder of the
    application file), a path (with a `/` or an ending .yaml or .yml) from there, or the name of a profile that
    `extensions` have. What a user's profile extends is looked for next to that file. What cannot be found or read
    is an error in `diagnostics` and left out.
    """
    reader = _Reader(load_builtin_profiles(builtin_folder), extensions, diagnostics)
    keys = [reader.take(name, near) for name in requested]
    unique = {key.name: key for key in reversed([k for k in keys if k is not None])}
    return ProfileSet(tuple(reversed(unique.values())), MappingProxyType(reader.found))


class _Reader:
    """Follows references from profile to profile, each file once."""

    def __init__(
        self, builtin: Mapping[str, Profile], extensions: Extensions, diagnostics: Diagnostics
    ) -> None:
        self._builtin = builtin
        self._extensions = extensions
        self._diagnostics = diagnostics
        self.found: dict[str, Profile] = {}

    def take(self, name: Named, near: Path) -> Named | None:
        """Read what `name` refers to and all that it extends; return its key."""
        if name.name in self._builtin:
            self._take_builtin(name.name)
            return name
        path = _user_file(name.name, near)
        if path is None and not _is_path(name.name):
            extension = self._extensions.profile(name.name, name.span, self._diagnostics)
            path = extension.profile(name.name) if extension is not None else None
        if path is None:
            self._unknown(name, near)
            return None
        key = path.as_posix()
        if key not in self.found and not self._take_file(path, key, name.span):
            return None
        return Named(key, name.span)

    def _take_builtin(self, name: str) -> None:
        if name not in self.found:
            self.found[name] = self._builtin[name]
            for base in self._builtin[name].extends:
                if base.name in self._builtin:
                    self._take_builtin(base.name)

    def _take_file(self, path: Path, key: str, span: Span | None) -> bool:
        source = _read(path, key, self._diagnostics, span)
        profile = parse_profile(source, self._diagnostics) if source else None
        if profile is None:
            return False
        other = next((k for k, p in self.found.items() if p.name == profile.name), None)
        if other is None and profile.name in self._builtin:
            other = f"the built-in {profile.name}"
        if other is not None:
            hint = "Give it a different name"
            self._diagnostics.error(
                f"the profile name '{profile.name}' is taken by {other}", profile.span, hint, id="MG-4016"
            )
        self.found[key] = profile
        bases = tuple(self.take(base, path.parent) for base in profile.extends)
        self.found[key] = replace(profile, extends=tuple(b for b in bases if b is not None))
        return True

    def _unknown(self, name: Named, near: Path) -> None:
        files = [p.stem for p in sorted(near.glob("*.yaml"))] if not _is_path(name.name) else []
        hint = nearest(name.name, [*self._builtin, *files])
        if _is_path(name.name):
            self._diagnostics.error(
                f"profile file '{name.name}' not found in '{near}'", name.span, hint, id="MG-4017"
            )
            return
        hint = (
            hint
            or f"Built-in: {', '.join(self._builtin)}; a file {name.name}.yaml next to the application is found, too"
        )
        self._diagnostics.error(f"unknown profile '{name.name}'", name.span, hint, id="MG-4018")


def _is_path(name: str) -> bool:
    return "/" in name or "\\" in name or name.endswith(_SUFFIXES)


def _user_file(name: str, near: Path) -> Path | None:
    names = (name,) if _is_path(name) else tuple(f"{name}{suffix}" for suffix in _SUFFIXES)
    return next((near / n for n in names if is_file(near / n)), None)


def _read(path: Path, shown: str, diagnostics: Diagnostics, span: Span | None = None) -> Source | None:
    try:
        return Source(shown, read_text(path))
    except OSError as fault:
        diagnostics.error(f"cannot read '{shown}': {fault.strerror}", span, id="MG-4019")
    except UnicodeDecodeError:
        diagnostics.error(f"'{shown}' is not UTF-8", span, "Save the file as UTF-8", id="MG-4020")
    return None
