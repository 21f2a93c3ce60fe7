# SPDX-License-Identifier: Apache-2.0
"""What a CMake build says of its libraries and images: one file each below BUILD/.microros (microros_image.cmake)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.documents.files import read_json
from microros_gen.output.tree import MANIFEST
from microros_gen.records import dataclass

RECORDS = ".microros"
VERSION = 1
_NONE = "is not an output folder of microros-gen, and no CMake build folder that has one"
_HINT = "Give the folder that `build` wrote, or a CMake build folder after it was configured"
_ABOVE = 4
"""How many folders above an image object names of its map may begin in."""


@dataclass(frozen=True)
class LibraryRecord:
    """A library that CMake builds from the output folder `output`; `arguments` are those of `generate`.

    `key` is its target's name and CMake's configuration (Debug), of which a build folder may have several.
    """

    key: tuple[str, str]
    output: Path
    archive: Path
    objects: tuple[Path, ...]
    archiver: str
    arguments: tuple[str, ...]


@dataclass(frozen=True)
class ImageRecord:
    """An image of a user. `map` is where the linker was told to describe it, `folders` where it may have run.

    `objects` are those of the executable itself; empty where nobody said. `library` is the key of its library.
    """

    image: Path
    map: Path
    objects: tuple[Path, ...]
    folders: tuple[Path, ...]
    library: tuple[str, str] = ("", "")


@dataclass(frozen=True)
class Located:
    """What a command was asked for: an output folder, the CMake library made from it, an image of a user's."""

    output: Path
    library: LibraryRecord | None = None
    image: ImageRecord | None = None


def locate(path: Path, image: Path | None = None, linker_map: Path | None = None) -> Located:
    """Find the image that `path` (an output folder or a CMake build folder), `--image` and `--map` name.

    `image` may be an executable that was linked outside of CMake, or the archive of a library of the build folder.
    Raises UserError where there is nothing, or more than one to choose from.
    """
    is_output = (path / MANIFEST).is_file()
    home = _home_of(path) if is_output else path
    libraries, images = _read(home) if home is not None else ((), ())
    if is_output:
        libraries = tuple(r for r in libraries if _same(r.output, path))
    elif not libraries:
        raise _nothing(path)
    keys = {r.key for r in libraries}
    images = tuple(r for r in images if r.library in keys)
    if image is not None:
        return _given(path if is_output else None, libraries, images, image, linker_map)
    if is_output and (not libraries or _has_example(path)):
        return Located(path)
    return _chosen(path, libraries, images)


def _given(
    output: Path | None,
    libraries: tuple[LibraryRecord, ...],
    images: tuple[ImageRecord, ...],
    image: Path,
    linker_map: Path | None,
) -> Located:
    """Return what `--image` names: an image of the records, an archive of them, or one that nobody recorded."""
    for library in libraries:
        if _same(library.archive, image):
            return Located(library.output, library)
    for record in images:
        if _same(record.image, image):
            library = next(r for r in libraries if r.key == record.library)
            known = record if linker_map is None else _unrecorded(image, linker_map, record)
            return Located(library.output, library, known)
    if len({r.output for r in libraries}) > 1:
        message = f"{image} is not an image of this build folder, which has several libraries"
        raise UserError(
            [
                Diagnostic(
                    message,
                    hint=f"Give the output folder of its library: {_outputs(libraries)}",
                    id="MG-8407",
                )
            ]
        )
    found = next((r for r in libraries if r.archive.is_file()), libraries[0] if libraries else None)
    place = output or (found.output if found else Path())
    return Located(place, found, _unrecorded(image, linker_map))


def _outputs(libraries: Iterable[LibraryRecord]) -> str:
    return ", ".join(sorted({str(r.output) for r in libraries}))


def _unrecorded(image: Path, linker_map: Path | None, known: ImageRecord | None = None) -> ImageRecord:
    whole = image.resolve()
    candidates = (image.with_suffix(".map"), image.with_name(f"{image.name}.map"))
    path = linker_map or next((p for p in candidates if p.is_file()), candidates[0])
    if known is not None:
        return replace(known, map=path)
    folders = (image.parent, Path(), *list(whole.parents)[1:_ABOVE])
    return ImageRecord(image, path, (), folders)


def _chosen(path: Path, libraries: tuple[LibraryRecord, ...], images: tuple[ImageRecord, ...]) -> Located:
    built = [record for record in images if record.image.is_file()]
    if len(built) == 1:
        library = next(r for r in libraries if r.key == built[0].library)
        return Located(library.output, library, built[0])
    if built:
        options = ", ".join(f"--image {record.image}" for record in built)
        raise UserError(
            [Diagnostic(f"{path} has {len(built)} images", hint=f"Choose one: {options}", id="MG-8408")]
        )
    if images:
        raise _not_built(path, images[0].image)
    if len({r.output for r in libraries}) > 1:
        message = f"{path} has several libraries and no image"
        raise UserError([Diagnostic(message, hint=f"Choose one: {_outputs(libraries)}", id="MG-8409")])
    archived = [r for r in libraries if r.archive.is_file()]
    if not archived:
        raise _not_built(path, libraries[0].archive)
    return Located(archived[0].output, archived[0])


def _not_built(path: Path, missing: Path) -> UserError:
    hint = f"Build it: cmake --build {_home_of(path) or path}"
    return UserError([Diagnostic(f"{missing} has not been built yet", hint=hint, id="MG-8410")])


def _nothing(path: Path) -> UserError:
    below = sorted(p.parent for p in path.glob(f"*/{RECORDS}") if p.is_dir()) if path.is_dir() else []
    hint = f"Give one of {', '.join(map(str, below))}" if below else _HINT
    return UserError([Diagnostic(f"{path} {_NONE}", hint=hint, id="MG-8411")])


def _home_of(path: Path) -> Path | None:
    """Return the CMake build folder around `path`, itself included; None if none exists."""
    whole = path.resolve()
    return next((p for p in (whole, *whole.parents) if (p / RECORDS).is_dir()), None)


def _has_example(out: Path) -> bool:
    """Whether `microros-gen build` made this folder's library itself."""
    return (out / "lib").is_dir()


def _same(first: Path, second: Path) -> bool:
    return first.resolve() == second.resolve()


def _read(home: Path) -> tuple[tuple[LibraryRecord, ...], tuple[ImageRecord, ...]]:
    found = [_load(path) for path in sorted((home / RECORDS).glob("*.json"))]
    libraries = tuple(r for r in found if isinstance(r, LibraryRecord))
    return libraries, tuple(r for r in found if isinstance(r, ImageRecord))


def _load(path: Path) -> LibraryRecord | ImageRecord:
    try:
        data = read_json(path)
        if data["version"] == VERSION:
            return _image(data) if data["kind"] == "image" else _library(data)
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        pass
    message = f"{path} was not written by this version of microros-gen"
    raise UserError([Diagnostic(message, hint=f"Configure again: cmake {path.parent.parent}", id="MG-8412")])


def _library(data: Mapping[str, Any]) -> LibraryRecord:
    return LibraryRecord(
        (str(data["name"]), str(data["config"])),
        Path(data["output"]),
        Path(data["archive"]),
        _paths(data["objects"]),
        str(data["archiver"]),
        _words(data["arguments"]),
    )


def _image(data: Mapping[str, Any]) -> ImageRecord:
    return ImageRecord(
        Path(data["image"]),
        Path(data["map"]),
        _paths(data["objects"]),
        _paths(data["folders"]),
        (str(data["library"]), str(data["config"])),
    )


def _words(text: str) -> tuple[str, ...]:
    return tuple(word for word in text.split(";") if word)


def _paths(text: str) -> tuple[Path, ...]:
    return tuple(map(Path, _words(text)))
