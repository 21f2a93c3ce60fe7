# SPDX-License-Identifier: Apache-2.0
"""What the command `rosidl` of ROS 2 finds: `rosidl generate --type microros`, `--type-support microros`.

Entry points of pyproject.toml name `Generator`. rosidl_cli calls it and is not needed for it: the tool installs, and
runs, where there is no ROS.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path

from microros_gen import compiler
from microros_gen.diagnostics import UserError
from microros_gen.typesupport.plan.capacity import Defaults

_APPLICATION = """\
version: 1
components: [+cdr, +cdr_decode]
transport: {{type: custom}}
liveliness: none
interfaces: [{interfaces}]
limits: {{"*": {{string: {string}, sequence: {sequence}}}}}
"""


class Generator:
    """Structures, encoders and decoders of interfaces, and what they stand on: a type and its support are one here.

    `string` (bytes) and `sequence` (elements) are the capacities of what the interfaces leave open:
    `rosidl generate --type-support 'microros[string: 32, sequence: 8]' …`.
    """

    def __init__(
        self, name: str, string: int | None = Defaults().string, sequence: int | None = Defaults().sequence
    ) -> None:
        self.name = name
        self._limits = {"string": string, "sequence": sequence}

    def generate(
        self,
        package_name: str,
        interface_files: Sequence[str | Path],
        include_paths: Iterable[Path],
        output_path: Path,
    ) -> list[Path]:
        """Write the sources of `interface_files` to `output_path`; return their paths.

        A file is relative to the current folder, or to the folder before a colon (`DIR:msg/Type.msg`); dependencies
        are looked for in `include_paths` and then where the tool looks. Ends the program with the tool's diagnostics
        where something is wrong.
        """
        with tempfile.TemporaryDirectory() as temporary:
            package = Path(temporary) / package_name
            origins = dict(_staged(str(file), package) for file in interface_files)
            config = Path(temporary) / "microros.yaml"
            names = ", ".join(sorted({f"{package_name}/{p.parent.name}/{p.stem}" for p in origins}))
            config.write_text(
                _APPLICATION.format(interfaces=names, **self._limits), encoding="utf-8", newline="\n"
            )
            paths = (package, *(Path(path) for path in include_paths))
            try:
                generated = compiler.generate(
                    compiler.Options(config=config, interface_paths=paths), Path(output_path)
                )
            except UserError as error:
                _report(error, package, origins)
                raise SystemExit(error.status) from None
        for warning in generated.planned.warnings:
            print(warning.render(), file=sys.stderr)
        report = generated.report
        return [generated.out / name for name in sorted((*report.written, *report.unchanged))]


def _staged(file: str, package: Path) -> tuple[Path, Path]:
    """Copy an interface file into a package of that name; return the copy and its origin."""
    prefix, _, relative = file.rpartition(":")
    origin = Path(prefix) / relative
    copy = package / origin.parent.name / origin.name
    copy.parent.mkdir(parents=True, exist_ok=True)
    try:
        shutil.copyfile(origin, copy)
    except OSError as error:
        raise SystemExit(f"error: cannot read the interface file '{origin}': {error.strerror}") from None
    return copy, origin


def _report(error: UserError, package: Path, origins: dict[Path, Path]) -> None:
    for diagnostic in error.diagnostics:
        text = (
            diagnostic.render()
            .replace(f"looked in {package}, ", "looked in ")
            .replace("--interface-path", "-I")
        )
        for copy, origin in origins.items():
            text = text.replace(str(copy), str(origin))
        print(text, file=sys.stderr)
