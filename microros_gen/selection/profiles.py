# SPDX-License-Identifier: Apache-2.0
"""Profiles with everything that they extend folded in; what stands nearer to a profile wins."""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

from microros_gen.application.model import ComponentChange, NodeDecl
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.named import Named
from microros_gen.selection.component import Profile, ProfileSet, ResolvedProfile, in_lists
from microros_gen.selection.declared import at, without_components
from microros_gen.selection.profile_nodes import joined_nodes


def resolve_profiles(profiles: ProfileSet, diagnostics: Diagnostics) -> tuple[ResolvedProfile, ...]:
    """Return the requested profiles, folded, in the order that their files give them, then by name.

    Errors: a profile that extends itself, `+x` and `-x` in one file, and bases that disagree about an axis or
    a component where the profile itself decides nothing.
    """
    folder = _Folder(profiles, diagnostics)
    found: dict[str, ResolvedProfile] = {}
    for name in profiles.requested:
        resolved = folder.fold(name.name, name.span)
        if resolved is not None:
            found.setdefault(resolved.name, replace(resolved, requested=name.span))
    return tuple(sorted(found.values(), key=in_lists))


def unique_changes(
    changes: tuple[ComponentChange, ...], diagnostics: Diagnostics
) -> dict[str, ComponentChange]:
    """Return the changes of one file by component.

    `+x` and `-x` in it are an error that names both places.
    """
    found: dict[str, ComponentChange] = {}
    for change in changes:
        first = found.setdefault(change.name, change)
        if first.add != change.add:
            diagnostics.error(
                f"'{signed(change)}' contradicts '{signed(first)}'{at(first.span)}",
                change.span,
                "Remove one of them",
                id="MG-4022",
            )
    return found


def signed(change: ComponentChange) -> str:
    """Return the change as a user writes it: `+timers` or `-ping`."""
    return f"{'+' if change.add else '-'}{change.name}"


class _Folder:
    """Folds profiles along `extends`, each once."""

    def __init__(self, profiles: ProfileSet, diagnostics: Diagnostics) -> None:
        self._profiles = profiles.profiles
        self._diagnostics = diagnostics
        self._folded: dict[str, ResolvedProfile] = {}
        self._path: list[str] = []

    def fold(self, key: str, span: Span | None) -> ResolvedProfile | None:
        """Return the profile `key` folded; None where it is unknown (said before) or extends itself."""
        profile = self._profiles.get(key)
        if profile is None:
            return None
        if key in self._path:
            names = [self._profiles[k].name for k in (*self._path[self._path.index(key) :], key)]
            message = f"the profile '{profile.name}' extends itself ({' → '.join(names)})"
            self._diagnostics.error(message, span, "Remove one of the `extends`", id="MG-4023")
            return None
        if key not in self._folded:
            self._path.append(key)
            bases = [b for base in profile.extends if (b := self.fold(base.name, base.span)) is not None]
            self._path.pop()
            self._folded[key] = self._join(profile, bases)
        return self._folded[key]

    def _join(self, profile: Profile, bases: list[ResolvedProfile]) -> ResolvedProfile:
        own = unique_changes(profile.components, self._diagnostics)
        self._check_known_drops(profile, own, bases)
        adds = {n.name: n for base in reversed(bases) for n in base.adds if n.name not in own}
        drops = {n.name: n for base in reversed(bases) for n in base.drops if n.name not in own}
        for name in sorted(set(adds) & set(drops)):
            self._diagnostics.error(
                f"the profile '{profile.name}' extends one that has '{name}'{at(adds[name].span)} and "
                f"one that drops it{at(drops[name].span)}",
                profile.span,
                f"Decide with +{name} or -{name} in its components",
                id="MG-4024",
            )
        for change in own.values():
            (adds if change.add else drops)[change.name] = Named(change.name, change.span)
        return ResolvedProfile(
            name=profile.name,
            summary=profile.summary,
            adds=tuple(adds.values()),
            drops=tuple(drops.values()),
            axes=MappingProxyType(self._axes(profile, bases)),
            builtin=profile.builtin,
            span=profile.span,
            nodes=self._nodes(profile, bases),
            order=profile.order,
        )

    def _nodes(self, profile: Profile, bases: list[ResolvedProfile]) -> tuple[NodeDecl, ...]:
        if profile.nodes is not None:
            return profile.nodes
        dropped = {change.name for change in profile.components if not change.add}
        return without_components(joined_nodes(node for base in bases for node in base.nodes), dropped)

    def _check_known_drops(
        self, profile: Profile, own: dict[str, ComponentChange], bases: list[ResolvedProfile]
    ) -> None:
        if bases or profile.extends:
            return
        for change in own.values():
            if not change.add:
                message = f"'-{change.name}' drops nothing: the profile '{profile.name}' extends no other"
                self._diagnostics.warning(
                    message, change.span, "Add `extends: […]`, or remove it", id="MG-4025"
                )

    def _axes(self, profile: Profile, bases: list[ResolvedProfile]) -> dict[str, Named]:
        chosen: dict[str, Named] = {}
        own = profile.axes
        for base in bases:
            for axis, value in base.axes.items():
                first = chosen.setdefault(axis, value)
                if first.name != value.name and axis not in own:
                    self._diagnostics.error(
                        f"the profile '{profile.name}' extends {axis}: {first.name}{at(first.span)} and "
                        f"{axis}: {value.name}{at(value.span)}",
                        profile.span,
                        f"Choose with `{axis}:` in it",
                        id="MG-4026",
                    )
        return {**chosen, **own}
