# SPDX-License-Identifier: Apache-2.0
"""Compiles an output folder: up-to-date objects stay, the others are compiled in parallel."""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Sequence
from pathlib import Path, PurePosixPath

from microros_gen.client.plan.project import Project
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.records import dataclass
from microros_gen.toolchain.contents import Contents
from microros_gen.toolchain.identity import CALL_GRAPH, Identity, identify
from microros_gen.toolchain.library import write_library
from microros_gen.toolchain.object_store import ObjectStore
from microros_gen.toolchain.objects import Objects, Progress, Unit
from microros_gen.toolchain.stamps import Stamps
from microros_gen.toolchain.toolchain import WARNINGS, Toolchain, run

OBJECTS = ".build"
LIBRARY = "lib/libmicroros.a"
MAP = f"{OBJECTS}/image.map"
SELFTEST_MAP = "bin/selftest.map"
TOOLS = f"{OBJECTS}/tools.json"
SCRIPT_STAMP = f"{OBJECTS}/linker_script.sha256"
# What programs that write flash take, next to the ELF file: endings and objcopy's names.
SELFTEST_SOURCES = "selftest/sources.txt"
_FLASH_FORMATS = {".hex": "ihex", ".bin": "binary"}
_PIPE = "-pipe"
"""gcc's assembler reads while the compiler writes; they exchange no file."""
_OVERFLOW = re.compile(r"region `?(\w+)'? overflowed by (\d+) bytes")
_REGIONS = {"text": "FLASH", "data": "RAM"}
"""Memory regions of linker scripts of C libraries (AVR), as this project's scripts name them."""
_RAM_EXCEEDED = re.compile(r"section `[.]\w+' is not within region `data'")


@dataclass(frozen=True)
class BuildReport:
    """What was built (paths relative to the output folder), and where the objects come from.

    They were compiled, copied from the object store, or kept from the last build. `selftest` is the image of the
    self-test.
    """

    library: str
    image: str | None
    compiled: int
    kept: int
    copied: int = 0
    selftest: str | None = None


def compile_project(
    out: Path,
    project: Project,
    tools: Toolchain,
    store: ObjectStore | None = None,
    selftest: str | None = None,
    progress: Progress | None = None,
) -> BuildReport:
    """Compile the sources of `project` in `out`, and link its example if possible, and the self-test to bin/`selftest`.

    Objects in `store` are copied; `progress` is called for each that is compiled.

    Raises UserError with status 1 and the compiler's output when a step fails.
    """
    sources = (out / "sources.txt").read_text(encoding="utf-8").split("\n")[:-1]
    image = None if project.lacks_image else project.image
    script = project.linker_script
    return compile_tree(out, sources, project.example, image, tools, script, store, selftest, progress)


def compile_tree(
    out: Path,
    sources: Sequence[str],
    example: str,
    image: str | None,
    tools: Toolchain,
    script: str | None = None,
    store: ObjectStore | None = None,
    selftest: str | None = None,
    progress: Progress | None = None,
) -> BuildReport:
    """Compile `sources` (relative paths) to lib/libmicroros.a, and `example` with it to bin/`image`.

    `image` None: the example is compiled and not linked. `selftest` is the image of the self-test below bin/; None: do
    not link one. `script` is the linker script of an image for a board, which
    is also converted to .hex and .bin.

    Raises UserError with status 1 and the compiler's output when a step fails.
    """
    identity = identify(tools.compiler, os.environ)
    library_units = [_unit(source, tools, identity) for source in sources]
    example_unit = _unit(example, tools, identity)
    test_units = [_unit(source, tools, identity) for source in _selftest_sources(out)] if selftest else []
    units = [*library_units, example_unit, *test_units]
    contents = Contents(out)
    stamps = Stamps(out, out / OBJECTS / "stamps.json", contents)
    stale = [unit for unit in units if not stamps.is_fresh(unit.object, unit.identity)]
    objects = Objects(out, contents, stamps, store, progress)
    try:
        missing = objects.copy(stale)
        objects.compile(missing)
    finally:
        objects.close()
        stamps.save(unit.object for unit in units)
    if stale or not (out / LIBRARY).is_file():
        _archive(out, [u.object for u in library_units], tools)
    linker = _Linker(out, tools, script, bool(stale))
    linked = linker.images(f"bin/{image}", [example_unit.object], MAP) if image else ()
    tested = (
        linker.images(f"bin/{selftest}", [u.object for u in test_units], SELFTEST_MAP) if selftest else ()
    )
    if linked or tested:
        linker.record()
    _record(out, tools, identity)
    _remove_others(
        out, {u.object for u in units}, {LIBRARY, *linked, *tested, *([SELFTEST_MAP] if tested else [])}
    )
    image_path = linked[0] if linked else None
    kept, copied = len(units) - len(stale), len(stale) - len(missing)
    test_path = tested[0] if tested else None
    return BuildReport(LIBRARY, image_path, len(missing), kept, copied, test_path)


def object_name(source: str) -> str:
    """Return the path of the object of a C file, below the output folder; members of the library have unique names.

    `src/std_msgs/int32__functions.c` → `.build/src/std_msgs/std_msgs__int32__functions.o`.
    """
    path = PurePosixPath(source)
    name = f"{path.parent.name}__{path.stem}" if path.parts[0] == "src" else path.stem
    return f"{OBJECTS}/{path.parent}/{name}.o"


def _unit(source: str, tools: Toolchain, identity: Identity) -> Unit:
    target = object_name(source)
    depends = target.removesuffix(".o") + ".d"
    facts = (CALL_GRAPH, _PIPE) if identity.call_graph else ()
    # -MD, not -MMD: headers of the system count, too.
    flags = (*WARNINGS, *tools.c_flags, *facts, "-Iinclude", "-MD", "-MF", depends)
    return Unit(source, target, (tools.compiler, *flags, "-c", source, "-o", target), identity.digest)


def _record(out: Path, tools: Toolchain, identity: Identity) -> None:
    """Write which tools built this folder, for `size` and `explain`."""
    data = {"compiler": tools.compiler, "archiver": tools.archiver, "call_graph": identity.call_graph}
    (out / TOOLS).write_text(json.dumps(data, sort_keys=True), encoding="utf-8", newline="\n")


def _archive(out: Path, objects: Sequence[str], tools: Toolchain) -> None:
    (out / LIBRARY).parent.mkdir(parents=True, exist_ok=True)
    fresh = f"{OBJECTS}/libmicroros.a"
    (out / fresh).unlink(missing_ok=True)
    if tools.archives or not write_library(out / fresh, [out / name for name in objects]):
        _must_succeed([tools.archiver, "rcsD", fresh, *objects], out, "the library cannot be archived")
    (out / fresh).replace(out / LIBRARY)


def _selftest_sources(out: Path) -> list[str]:
    return (out / SELFTEST_SOURCES).read_text(encoding="utf-8").split("\n")[:-1]


@dataclass(frozen=True)
class _Linker:
    """Links images of one folder with its library; `stale`: something was compiled."""

    out: Path
    tools: Toolchain
    script: str | None
    stale: bool

    def images(self, image: str, objects: Sequence[str], linker_map: str) -> tuple[str, ...]:
        """Link an outdated image; return its files below bin/, the one with symbols first."""
        products = [image]
        if self.tools.objcopy is not None:
            products += [str(PurePosixPath(image).with_suffix(suffix)) for suffix in _FLASH_FORMATS]
        is_there = all((self.out / product).is_file() for product in (*products, linker_map))
        if self.stale or not is_there or _text(self.out / SCRIPT_STAMP) != self._digest():
            self._link(image, objects, linker_map)
            for product in products[1:]:
                _convert(self.out, image, product, self.tools)
        return tuple(products)

    def record(self) -> None:
        """Write which linker script the images have; after all of them."""
        (self.out / SCRIPT_STAMP).write_text(self._digest(), encoding="utf-8", newline="\n")

    def _link(self, image: str, objects: Sequence[str], linker_map: str) -> None:
        (self.out / image).parent.mkdir(parents=True, exist_ok=True)
        fresh = f"{OBJECTS}/image"
        tools, script = self.tools, self.script
        flags = [
            *tools.c_flags,
            *tools.link_flags,
            f"-Wl,-Map={linker_map}",
            *(("-T", script) if script else ()),
        ]
        command = [tools.compiler, *flags, *objects, LIBRARY, *tools.libraries, "-o", fresh]
        result = run(command, self.out)
        if result.returncode != 0:
            hint = _too_large(result.stdout)
            name = "self-test" if linker_map == SELFTEST_MAP else "example"
            what = f"the {name} cannot be linked:\n{result.stdout.rstrip()}"
            raise UserError([Diagnostic(what, hint=hint, id="MG-8202")], status=1)
        (self.out / fresh).replace(self.out / image)

    def _digest(self) -> str:
        return _digest_of(self.out, self.script)


def _too_large(message: str) -> str | None:
    """Return a hint if the linker reports that a memory region is too small."""
    if _RAM_EXCEEDED.search(message):
        return (
            "The variables take more than the target's RAM: `errors: code` leaves out the texts of errors; else lower"
            " pools or limits"
        )
    match = _OVERFLOW.search(message)
    if match is None:
        return None
    region, size = _REGIONS.get(match[1], match[1]), match[2]
    lower = (
        "memory.stack, pools or limits"
        if region == "RAM"
        else "what is selected, or `errors: text` to `errors: code`"
    )
    return f"It takes {size} bytes more than the target's {region.lower()}: lower {lower}"


def _convert(out: Path, image: str, product: str, tools: Toolchain) -> None:
    assert tools.objcopy is not None
    fresh = f"{OBJECTS}/image{PurePosixPath(product).suffix}"
    kind = _FLASH_FORMATS[PurePosixPath(product).suffix]
    _must_succeed([tools.objcopy, "-O", kind, image, fresh], out, "the image cannot be converted")
    (out / fresh).replace(out / product)


def _digest_of(out: Path, script: str | None) -> str:
    return hashlib.sha256((out / script).read_bytes()).hexdigest() if script else "none"


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except OSError:
        return ""


def _must_succeed(command: Sequence[str], out: Path, what: str) -> None:
    result = run(command, out)
    if result.returncode != 0:
        raise UserError([Diagnostic(f"{what}:\n{result.stdout.rstrip()}", id="MG-8203")], status=1)


def _remove_others(out: Path, objects: set[str], products: set[str]) -> None:
    for path in (out / OBJECTS).rglob("*.o"):
        if path.relative_to(out).as_posix() not in objects:
            path.unlink()
            for suffix in (".d", ".ci"):
                path.with_suffix(suffix).unlink(missing_ok=True)
    for folder in ("lib", "bin"):
        for path in (out / folder).glob("*"):
            if path.is_file() and path.relative_to(out).as_posix() not in products:
                path.unlink()
