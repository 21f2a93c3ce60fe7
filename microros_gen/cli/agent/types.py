# SPDX-License-Identifier: Apache-2.0
"""Type hashes for the agent: what its clients were generated with, and what interface files say."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import field
from pathlib import Path
from typing import Any

from microros_gen.diagnostics import Diagnostics, Span
from microros_gen.documents.files import read_json
from microros_gen.records import dataclass

_KEYED = re.compile(r"(0[xX][0-9a-fA-F]{1,8})=(.+)")
_HASH = re.compile(r"RIHS01_[0-9a-f]{64}")

HashOf = Callable[[str], "str | None"]


@dataclass(frozen=True)
class ManifestOf:
    """A manifest and the client that it is of, where somebody said so (a key, as `0xA1B2C3D4`)."""

    path: Path
    key: str | None = None
    span: Span | None = field(default=None, compare=False, repr=False)

    @staticmethod
    def of(text: str, folder: Path, span: Span | None = None) -> ManifestOf:
        """Return what `FILE` or `KEY=FILE` says, perhaps at a place; the file is relative to `folder`."""
        match = _KEYED.fullmatch(text)
        return (
            ManifestOf(folder / match[2], match[1], span) if match else ManifestOf(folder / text, None, span)
        )


@dataclass(frozen=True)
class ClientTypes:
    """Type → hash, as clients were generated: `by_client` by key or by node (`/ns/node`), `common` of all others."""

    common: Mapping[str, str]
    by_client: Mapping[str, Mapping[str, str]]

    def all(self) -> set[tuple[str, str]]:
        """Return every type with each of its hashes."""
        maps = (self.common, *self.by_client.values())
        return {pair for types in maps for pair in types.items()}


class TypeHashes:
    """Answers, for a type as `pkg/msg/Type`, which RIHS01 hash (REP-2011) it has; None: nobody here knows it.

    It is asked where a client has its own manifest: manifests of no client in particular (`common`) come first,
    then interface files (`of_files`).
    """

    def __init__(self, of_files: HashOf, common: Mapping[str, str]) -> None:
        self._of_files = of_files
        self._common = common

    def __call__(self, type_name: str) -> str | None:
        """Return the hash of a type; never raises, whatever the name."""
        return self._common.get(type_name) or self._of_files(type_name)

    def differences(self, clients: ClientTypes) -> list[str]:
        """Return the types whose definition on this machine is another one than that of a client."""
        return sorted(
            {name for name, type_hash in clients.all() if self._of_files(name) not in (None, type_hash)}
        )


def read_manifests(manifests: Sequence[ManifestOf], diagnostics: Diagnostics) -> ClientTypes:
    """Return what manifests that `build` or `generate` wrote say; faults go to `diagnostics`.

    A manifest is of the client whose key was given, else of the nodes that it declares, else of every client.
    """
    common: dict[str, str] = {}
    by_client: dict[str, dict[str, str]] = {}
    first: dict[tuple[str, str], Path] = {}
    for manifest in dict.fromkeys(manifests):
        content = _read(manifest, diagnostics)
        clients = [manifest.key] if manifest.key else content.nodes
        for client in clients or [""]:
            known = by_client.setdefault(client, {}) if client else common
            for name, type_hash in content.types.items():
                if known.setdefault(name, type_hash) != type_hash:
                    before = first[client, name]
                    message = f"{manifest.path} and {before} have different definitions of {name}"
                    hint = f"Name the client of each: --manifest 0xKEY={manifest.path}"
                    diagnostics.error(message, manifest.span, hint, id="MG-9710")
                first.setdefault((client, name), manifest.path)
    return ClientTypes(common, by_client)


@dataclass(frozen=True)
class _Content:
    types: Mapping[str, str]
    nodes: list[str]


def _read(manifest: ManifestOf, diagnostics: Diagnostics) -> _Content:
    path, span = manifest.path, manifest.span
    try:
        data: Any = read_json(path)
        types = {str(name): str(about["hash"]) for name, about in data["types"].items()}
        nodes = [f"{n['namespace'].rstrip('/')}/{n['name']}" for n in data["entities"]["nodes"]]
        if all(_HASH.fullmatch(type_hash) for type_hash in types.values()):
            return _Content(types, nodes)
    except OSError as error:
        diagnostics.error(f"{path} cannot be read: {error.strerror}", span, id="MG-9711")
        return _Content({}, [])
    except (ValueError, KeyError, TypeError, AttributeError):
        pass
    diagnostics.error(
        f"{path} is not a manifest of microros-gen",
        span,
        "Give OUT/manifest.json of the client",
        id="MG-9712",
    )
    return _Content({}, [])
