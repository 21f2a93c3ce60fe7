# SPDX-License-Identifier: Apache-2.0
"""Type hashes for the agent: what its clients were generated with, and what interface files say."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from microros_gen.diagnostics import Diagnostics

_HASH = re.compile(r"RIHS01_[0-9a-f]{64}")

HashOf = Callable[[str], "str | None"]


class TypeHashes:
    """Answers, for a type as `pkg/msg/Type`, which RIHS01 hash (REP-2011) it has; None: nobody here knows it.

    Manifests of clients come first (`manifests`: type → hash), then interface files (`of_files`).
    """

    def __init__(self, of_files: HashOf, manifests: Mapping[str, str]) -> None:
        self._of_files = of_files
        self._manifests = manifests

    def __call__(self, type_name: str) -> str | None:
        """Return the hash of a type; never raises, whatever the name."""
        return self._manifests.get(type_name) or self._of_files(type_name)

    def differences(self) -> list[str]:
        """Return the types whose definition here is another one than that of a client."""
        return sorted(n for n, told in self._manifests.items() if self._of_files(n) not in (None, told))


def read_manifests(paths: Sequence[Path], diagnostics: Diagnostics) -> dict[str, str]:
    """Return type → hash of all manifests that `build` or `generate` wrote; faults go to `diagnostics`."""
    found: dict[str, str] = {}
    first: dict[str, Path] = {}
    for path in dict.fromkeys(paths):
        for name, told in _types(path, diagnostics).items():
            if found.setdefault(name, told) != told:
                message = f"{path} and {first[name]} have different definitions of {name}"
                hint = "Generate both clients from the same interface files, or give each an agent of its own"
                diagnostics.error(message, hint=hint)
            first.setdefault(name, path)
    return found


def _types(path: Path, diagnostics: Diagnostics) -> dict[str, str]:
    try:
        types: Any = json.loads(path.read_text(encoding="utf-8"))["types"]
        found = {str(name): str(about["hash"]) for name, about in types.items()}
    except OSError as error:
        diagnostics.error(f"{path} cannot be read: {error.strerror}")
        return {}
    except (ValueError, KeyError, TypeError, AttributeError):
        found = {"": ""}
    if not all(_HASH.fullmatch(told) for told in found.values()):
        diagnostics.error(
            f"{path} is no manifest of microros-gen", hint="Give OUT/manifest.json of the client"
        )
        return {}
    return found
