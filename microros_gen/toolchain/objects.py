# SPDX-License-Identifier: Apache-2.0
"""Creates the objects of an output folder: copies those in the store, and compiles the others in parallel."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from pathlib import Path

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.records import dataclass
from microros_gen.toolchain.contents import Contents, joined
from microros_gen.toolchain.object_store import Found, ObjectStore
from microros_gen.toolchain.stamps import Stamps
from microros_gen.toolchain.toolchain import run

Progress = Callable[[int, int, str], None]
"""Is called with the number of compiled sources, the number of all, and the path of the last one."""

ENDINGS = (".o", ".d", ".ci")
"""What a compilation makes: the object, the files that it read, and the call graph (gcc)."""

# With these a compiler reads or makes more than the store knows of, or does what this machine can.
_NOT_KEPT = re.compile(
    r"@|--coverage|-ftest-coverage|-fprofile|-fauto-profile|-fplugin|-fdump|-save-temps|-gsplit-dwarf|-fstack-usage"
    r"|-m(arch|cpu|tune)=native|-B|-?-specs=.*[/\\]|-wrapper|-Xclang|-Wp,|-Wa,|-Xassembler|-time"
)
# A processor has the next compiler while this program takes the result of the last one.
_WAITING = 1
_DEBUG = re.compile(r"-g(?!0$)")
_TIMES = (b"__DATE__", b"__TIME__", b"__TIMESTAMP__")


@dataclass(frozen=True)
class Unit:
    """A source and the compiler call that creates its object; `compiler` identifies the compiler."""

    source: str
    object: str
    command: tuple[str, ...]
    compiler: str

    @cached_property
    def identity(self) -> str:
        """A digest of the call."""
        return joined([self.compiler, *self.command])


class Objects:
    """The objects of the output folder `out`; without a store each is compiled."""

    def __init__(
        self,
        out: Path,
        contents: Contents,
        stamps: Stamps,
        store: ObjectStore | None,
        progress: Progress | None = None,
    ) -> None:
        """Prepare to create objects in `out`; `progress` is told of each that was compiled."""
        self._out = out
        self._contents = contents
        self._stamps = stamps
        self._store = store
        self._progress = progress
        self._timed: dict[str, bool] = {}

    def copy(self, units: Sequence[Unit]) -> list[Unit]:
        """Copy the objects that the store has; return the other units."""
        for folder in {(self._out / unit.object).parent for unit in units}:
            folder.mkdir(parents=True, exist_ok=True)
        return [unit for unit in units if not self._copied(unit)]

    def compile(self, units: Sequence[Unit]) -> None:
        """Compile the units, long sources first: so no processor is left with one of them at the end.

        Raises UserError with status 1 and the compiler's output if one fails.
        """
        units = sorted(units, key=lambda unit: -len(self._contents.read(unit.source) or b""))
        failed = {}
        with ThreadPoolExecutor(max_workers=(os.cpu_count() or 1) + _WAITING) as pool:
            results = pool.map(lambda unit: run(unit.command, self._out), units)
            for done, (unit, result) in enumerate(zip(units, results, strict=True), start=1):
                if self._progress is not None:
                    self._progress(done, len(units), unit.source)
                if result.returncode == 0:
                    self._keep(unit)
                else:
                    message = f"{unit.source} does not compile:\n{result.stdout.rstrip()}"
                    failed[unit.source] = Diagnostic(message, id="MG-8201")
        if failed:
            raise UserError([failed[source] for source in sorted(failed)], status=1)

    def close(self) -> None:
        """Reduce the store to its maximum size."""
        if self._store is not None:
            self._store.close()

    def _copied(self, unit: Unit) -> bool:
        found = None
        if self._store is not None and _is_kept(unit):
            found = self._store.find(self._key(unit), self._contents.of_files)
        if found is None:
            return False
        for ending in ENDINGS:
            path = self._made(unit, ending)
            if ending in found.outputs:
                path.write_bytes(found.outputs[ending])
            else:
                path.unlink(missing_ok=True)
        self._stamps.record(unit.object, unit.identity, found.files)
        return True

    def _keep(self, unit: Unit) -> None:
        files = _dependencies(self._made(unit, ".d"))
        self._stamps.record(unit.object, unit.identity, files)
        if self._store is None or not _is_kept(unit) or any(map(self._has_time, files)):
            return
        paths = {ending: self._made(unit, ending) for ending in ENDINGS}
        contents = {ending: path.read_bytes() for ending, path in paths.items() if path.is_file()}
        self._store.keep(self._key(unit), self._contents.of_files, Found(files, contents))

    def _key(self, unit: Unit) -> str:
        """Return what identifies a compilation before the files that it reads are known."""
        place = self._place if any(map(_DEBUG.match, unit.command)) else ""
        return joined([unit.identity, place, self._contents.of_file(unit.source)])

    @cached_property
    def _place(self) -> str:
        """The folder, which debug information names."""
        return str(self._out.resolve())

    def _has_time(self, name: str) -> bool:
        found = self._timed.get(name)
        if found is None:
            content = self._contents.read(name) or b""
            found = self._timed[name] = any(time in content for time in _TIMES)
        return found

    def _made(self, unit: Unit, ending: str) -> Path:
        return self._out / f"{unit.object.removesuffix('.o')}{ending}"


def _is_kept(unit: Unit) -> bool:
    return not any(map(_NOT_KEPT.match, unit.command))


def _dependencies(depfile: Path) -> list[str]:
    text = depfile.read_text(encoding="utf-8").replace("\\\n", " ")
    names = text.split(":", 1)[1].replace("\\ ", "\0").split()
    return [name.replace("\0", " ") for name in names]
