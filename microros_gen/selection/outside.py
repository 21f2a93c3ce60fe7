# SPDX-License-Identifier: Apache-2.0
"""The catalog of a run: the components that ship with the tool, and those from outside that are named."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from types import MappingProxyType

from microros_gen.application.model import Application
from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.named import Named
from microros_gen.selection.component import Catalogue, Component, ResolvedProfile
from microros_gen.selection.extension import INSTALLED, Extension, Extensions, files_of
from microros_gen.selection.extension_file import check_needs, read_outside


def component_names(application: Application, profiles: Iterable[ResolvedProfile]) -> Iterator[Named]:
    """Yield the names of components that the application and its profiles write, with their places."""
    for change in application.components:
        yield Named(change.name, change.span)
    for profile in profiles:
        for named in (*profile.adds, *profile.drops):
            yield Named(named.name, profile.place(named.span))


def with_outside(
    builtin: Catalogue,
    extensions: Extensions,
    names: Iterable[Named],
    capabilities: Iterable[str],
    diagnostics: Diagnostics,
) -> Catalogue:
    """Return `builtin` and the components of each extension that is named, or brings one of `names` or what they need.

    Errors in `diagnostics`: a faulty component, one with the name or a header of another, and an unknown `needs`.
    """
    reader = _Reader(builtin, extensions, tuple(capabilities), diagnostics)
    for extension in extensions.named:
        reader.take(extension)
    for name in names:
        reader.want(name.name, name.span)
    if not reader.found:
        return builtin
    _check_headers(builtin, reader.found, diagnostics)
    return MappingProxyType(dict(sorted({**builtin, **reader.found}.items())))


def with_installed(builtin: Catalogue, capabilities: Iterable[str]) -> Catalogue:
    """Return `builtin` and all components of installed packages; a package whose components do not hold is left out."""
    capabilities = tuple(capabilities)
    found: dict[str, Component] = {}
    for extension in INSTALLED.installed():
        diagnostics = Diagnostics()
        reader = _Reader(builtin, INSTALLED, capabilities, diagnostics)
        reader.take(extension)
        if not diagnostics.has_errors():
            found = {**reader.found, **found}
    return MappingProxyType(dict(sorted({**builtin, **found}.items())))


class _Reader:
    """Follows names to extensions, and from their components to what these need."""

    def __init__(
        self,
        builtin: Catalogue,
        extensions: Extensions,
        capabilities: tuple[str, ...],
        diagnostics: Diagnostics,
    ) -> None:
        self.found: dict[str, Component] = {}
        self._builtin = builtin
        self._extensions = extensions
        self._capabilities = capabilities
        self._diagnostics = diagnostics
        self._taken: list[Extension] = []

    def want(self, name: str, span: Span | None) -> None:
        """Take the extension that brings `name`; where none does, the resolver reports the name."""
        if name not in self._builtin and name not in self.found:
            extension = self._extensions.component(name, span, self._diagnostics)
            if extension is not None:
                self.take(extension)

    def take(self, extension: Extension) -> None:
        """Read all components of an extension, and what they need of others."""
        if extension in self._taken:
            return
        self._taken.append(extension)
        new = [c for name in extension.component_names() if (c := self._read(extension, name)) is not None]
        for component in new:
            for need in component.needs:
                self.want(need, extension.span)
        for component in new:
            check_needs(component, (*self._builtin, *self.found), self._diagnostics)

    def _read(self, extension: Extension, name: str) -> Component | None:
        folder = extension.component(name)
        assert folder is not None
        other = self.found.get(name)
        if name in self._builtin or other is not None:
            taken = "the built-in component" if other is None else other.origin
            message = f"the name '{name}' of a component from {extension.origin} is taken by {taken}"
            self._diagnostics.error(message, extension.span, f"Rename the folder {folder}", id="MG-4070")
            return None
        component = read_outside(extension, folder, self._capabilities, self._diagnostics)
        if component is not None:
            self.found[name] = component
        return component


def _check_headers(builtin: Catalogue, found: dict[str, Component], diagnostics: Diagnostics) -> None:
    """Report each header of a component from outside that another component has."""
    owners: dict[str, str] = {}
    for component in (*builtin.values(), *found.values()):
        replaced = {f"include/{r.header}" for r in component.contributes.replaces}
        names = (name.removesuffix(".j2") for name, _ in files_of(component.folder))
        for header in (name for name in names if name.startswith("include/") and name not in replaced):
            owner = owners.setdefault(header, component.name)
            if owner != component.name and component.name in found:
                message = f"the components '{owner}' and '{component.name}' both have '{header}'"
                hint = f"Rename it in {component.folder}"
                diagnostics.error(message, None, hint, id="MG-4071")
