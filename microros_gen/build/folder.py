# SPDX-License-Identifier: Apache-2.0
"""What an output folder says of itself: its manifest, its sources, and what built it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path, PurePosixPath
from typing import Any

from microros_gen.build.compile import LIBRARY, MAP, TOOLS, object_name
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.output.tree import MANIFEST
from microros_gen.plan.types_names import c_name, type_files
from microros_gen.resolve.interfaces import split_type_name
from microros_gen.sources.files import LARGEST_RECORD, read_json, read_text


@dataclass(frozen=True)
class Folder:
    """An output folder that was built. `tools` names compiler and archiver; `manifest` is manifest.json.

    `outside` is an image that somebody else linked with the library, and its map; None: the example.
    """

    path: Path
    manifest: Mapping[str, Any]
    sources: tuple[str, ...]
    tools: Mapping[str, Any]
    outside: tuple[Path, Path] | None = None

    @property
    def image(self) -> Path | None:
        """The linked image, or None for a target that has the library alone."""
        if self.outside is not None:
            return self.outside[0]
        path = self.path / "bin" / str(self.manifest["image"])
        return path if path.is_file() else None

    @property
    def image_name(self) -> str:
        """The image as people know it."""
        return str(self.outside[0]) if self.outside is not None else f"bin/{self.manifest['image']}"

    @property
    def components(self) -> tuple[str, ...]:
        """The selected components."""
        return tuple(self.manifest["selection"]["components"])

    @property
    def map_text(self) -> str:
        """What the linker says of the image."""
        try:
            path = self.outside[1] if self.outside is not None else self.path / MAP
            return read_text(path, errors="replace", largest=LARGEST_RECORD)
        except OSError:
            return ""

    def object_path(self, source: str) -> Path:
        """Return the object of a source of this folder; of an outside image's, what its map calls it."""
        if source.endswith((".c", ".S")):
            return self.path / object_name(source)
        around = self.outside[0].parent if self.outside is not None else self.path
        path = Path(source)
        return path if path.is_file() else around / path

    @cached_property
    def objects(self) -> Mapping[str, str]:
        """Member of the library → source below the folder."""
        return {PurePosixPath(object_name(source)).name: source for source in self.sources}

    @cached_property
    def types(self) -> Mapping[str, str]:
        """Source below the folder → the type that it supports."""
        found = {}
        for text in self.manifest["types"]:
            name = split_type_name(text)
            if name is not None:
                files = type_files(name)
                made = (files.functions_source, files.type_support_source, files.storage_source)
                found.update(dict.fromkeys(made, text))
        return found

    @cached_property
    def c_types(self) -> Mapping[str, str]:
        """Name of the C struct → type: `std_msgs__msg__Int32` → `std_msgs/msg/Int32`."""
        names = ((split_type_name(text), text) for text in self.manifest["types"])
        return {c_name(name): text for name, text in names if name is not None}


def read_folder(path: Path) -> Folder:
    """Read an output folder; raises UserError where it is none, or was not built."""
    try:
        manifest = read_json(path / MANIFEST, follow=False)
        sources = tuple(read_text(path / "sources.txt", follow=False).split("\n")[:-1])
        manifest["selection"]["reasons"], manifest["memory"], manifest["image"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise UserError(
            [
                Diagnostic(
                    f"{path} is no output folder of microros-gen", hint="Give the folder that `build` wrote"
                )
            ]
        ) from error
    try:
        tools = read_json(path / TOOLS, follow=False)
    except (OSError, ValueError):
        tools = None
    if not isinstance(tools, dict) or not (path / LIBRARY).is_file():
        raise UserError(
            [
                Diagnostic(
                    f"{path} was not built yet", hint="Make it with `microros-gen build`, then measure it"
                )
            ]
        )
    return Folder(path, manifest, sources, tools)
