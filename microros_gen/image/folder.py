# SPDX-License-Identifier: Apache-2.0
"""What an output folder says of itself: its manifest, its sources, and what built it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path, PurePosixPath
from typing import Any

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.documents.files import LARGEST_RECORD, read_json, read_text
from microros_gen.image.elf import Elf
from microros_gen.image.linker_map import Placed, is_of_tool_chain, member_of, parse_map
from microros_gen.image.members import Sources
from microros_gen.image.records import ImageRecord, LibraryRecord, Located, locate
from microros_gen.interfaces.closure import split_type_name
from microros_gen.output.tree import MANIFEST
from microros_gen.records import dataclass
from microros_gen.toolchain.archive import Member, read_archive
from microros_gen.toolchain.compile import LIBRARY, MAP, TOOLS, object_name
from microros_gen.typesupport.plan.names import c_name, type_files


@dataclass(frozen=True)
class Folder:
    """An output folder that was built. `tools` names compiler and archiver; `manifest` is manifest.json.

    `linked` is an image that a user linked with the library; None: the example. `library` is the library as CMake
    built it; None: as `build` did, or as somebody else who left no record.
    """

    path: Path
    manifest: Mapping[str, Any]
    sources: tuple[str, ...]
    tools: Mapping[str, Any]
    linked: ImageRecord | None = None
    library: LibraryRecord | None = None

    @property
    def image(self) -> Path | None:
        """The linked image, or None where there is the library alone."""
        if self.linked is not None:
            return self.linked.image
        path = self.path / "bin" / str(self.manifest["image"])
        return path if path.is_file() and self.library is None else None

    @property
    def image_name(self) -> str:
        """The image as people know it."""
        return str(self.linked.image) if self.linked is not None else f"bin/{self.manifest['image']}"

    @property
    def components(self) -> tuple[str, ...]:
        """The selected components."""
        return tuple(self.manifest["selection"]["components"])

    @cached_property
    def placed(self) -> tuple[Placed, ...]:
        """What the linker says of the image; empty where it left no map."""
        try:
            path = self.linked.map if self.linked is not None else self.path / MAP
            return parse_map(read_text(path, errors="replace", largest=LARGEST_RECORD))
        except OSError:
            return ()

    def object_path(self, source: str) -> Path | None:
        """Return the object of a source of this folder, or of what the map calls so; None where there is no file."""
        if source.endswith((".c", ".S")):
            path = self._made.get(source, self.path / object_name(source))
            return path if path.is_file() else None
        return self._found(source)

    def object(self, source: str) -> Elf | None:
        """Return the object that `object_path` has, or one out of a library that the map names."""
        if source not in self._read:
            path, member = self.object_path(source), None
            if path is None:
                member = self._archived(source)
            held = member.content if member is not None else None
            place = path or self.path / source
            self._read[source] = Elf(place, held) if path is not None or held else None
        return self._read[source]

    @cached_property
    def _read(self) -> dict[str, Elf | None]:
        return {}

    @cached_property
    def _made(self) -> Mapping[str, Path]:
        """Source → object, of a library that CMake builds: `…/robot.dir/src/session/xrce_session.c.o`."""
        found: dict[str, Path] = {}
        for path in self.library.objects if self.library is not None else ():
            name = path.with_suffix("").as_posix()
            found.update({s: path for s in self.sources if name.endswith(f"/{s}")})
        return found

    def _found(self, name: str) -> Path | None:
        """Return the file that the linker called `name`, relative to the folder in which it ran."""
        folders = self.linked.folders if self.linked is not None else (self.path,)
        return next((p for p in (folder / name for folder in folders) if p.is_file()), None)

    def _archived(self, source: str) -> Member | None:
        """Return an object from a library of the map: by its name there, or by the source that it was made from."""
        if not source.endswith((".c", ".S")):
            archive, name = member_of(source)
            matching = (m for path, m in self._members if path.name == archive and m.name == name)
            return next(matching, None)
        named = [m for _, m in self._members if source in self.by_name.candidates(m.name)]
        for member in named:
            symbols = [s.name for s in Elf(self.path / member.name, member.content).symbols]
            if len(named) == 1 or self.by_name.of(member.name, symbols) == source:
                return member
        return None

    @cached_property
    def _members(self) -> tuple[tuple[Path, Member], ...]:
        """The objects of the libraries in the map, those of the tool chain left out."""
        names = {member_of(p.object)[0] for p in self.placed} if self.linked is not None else set()
        files = sorted({path for name in names if name for path in [self._found(name)] if path is not None})
        if self.linked is not None and not files:
            files = [path for path in (self.path / LIBRARY,) if path.is_file()]
        own = (path for path in files if not is_of_tool_chain(path.name))
        return tuple((path, member) for path in own for member in read_archive(path))

    @cached_property
    def by_name(self) -> Sources:
        """Finds the source of an object by its name and symbols."""
        return Sources(self.path, self.sources)

    def shown_file(self, name: str) -> str:
        """Return a file as it was given to the compiler, without this folder where it lies in it."""
        for base in (self.path, self.path.resolve()):
            if name.startswith(f"{base}/"):
                return name[len(f"{base}/") :]
        return name

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
                sources = (files.functions_source, files.type_support_source, files.storage_source)
                found.update(dict.fromkeys(sources, text))
        return found

    @cached_property
    def c_types(self) -> Mapping[str, str]:
        """Name of the C struct → type: `std_msgs__msg__Int32` → `std_msgs/msg/Int32`."""
        names = ((split_type_name(text), text) for text in self.manifest["types"])
        return {c_name(name): text for name, text in names if name is not None}


def read_folder(path: Path, image: Path | None = None, linker_map: Path | None = None) -> Folder:
    """Read an output folder, or the one of a CMake build folder, with the image that was built from it.

    Raises UserError if none exists, or it was not built.
    """
    located = locate(path, image, linker_map)
    try:
        manifest = read_json(located.output / MANIFEST, follow=False)
        sources = tuple(read_text(located.output / "sources.txt", follow=False).split("\n")[:-1])
        manifest["selection"]["reasons"], manifest["memory"], manifest["image"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        message = f"{located.output} is not an output folder of microros-gen"
        raise UserError(
            [Diagnostic(message, hint="Give the folder that `build` wrote", id="MG-8405")]
        ) from error
    return Folder(located.output, manifest, sources, _tools(located), located.image, located.library)


def _tools(located: Located) -> Mapping[str, Any]:
    """Return what built the library: CMake's record, or `build`; nothing if only an image exists."""
    if located.library is not None:
        return {"archiver": located.library.archiver}
    try:
        tools = read_json(located.output / TOOLS, follow=False)
    except (OSError, ValueError):
        tools = None
    if isinstance(tools, dict) and (located.output / LIBRARY).is_file():
        return tools
    if located.image is not None:
        return {}
    message = f"{located.output} has not been built yet"
    hint = (
        "Make it with `microros-gen build`; for your own image give the CMake build folder, or --image FILE"
    )
    raise UserError([Diagnostic(message, hint=hint, id="MG-8406")])
