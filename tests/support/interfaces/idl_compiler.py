# SPDX-License-Identifier: Apache-2.0
"""The IDL compiler of Eclipse Cyclone DDS, from its wheel on PyPI."""

from __future__ import annotations

import importlib.util
import os
import struct
import subprocess
from dataclasses import dataclass
from pathlib import Path

from elftools.elf.elffile import ELFFile

# A back end that writes nothing: the test is about what the compiler accepts, not about its output.
BACK_END = "int generate(const void * tree, const void * config) { (void)config; return tree == 0; }\n"
WRITABLE = 2  # PF_W


@dataclass(frozen=True)
class IdlCompiler:
    """`idlc`, ready to run."""

    program: Path
    back_end: Path
    libraries: Path

    def refusal(self, file: Path, includes: Path) -> str:
        """Return what the compiler says against `file`; empty where it takes it."""
        command = [str(self.program), "-f", "case-sensitive", "-x", "final", "-l", str(self.back_end)]
        environment = {**os.environ, "LD_LIBRARY_PATH": str(self.libraries)}
        done = subprocess.run(
            [*command, "-I", str(includes), str(file)],
            capture_output=True,
            text=True,
            errors="replace",
            env=environment,
            cwd=self.back_end.parent,
            check=False,
        )
        return "" if done.returncode == 0 else f"exit {done.returncode}: {done.stdout}{done.stderr}"


def idl_compiler(folder: Path) -> IdlCompiler:
    """Return the compiler of the wheel, with its program corrected and a back end in `folder`."""
    spec = importlib.util.find_spec("cyclonedds")
    assert spec is not None
    assert spec.origin is not None
    package = Path(spec.origin).parent
    program = folder / "idlc"
    program.write_bytes(_repaired(package / ".libs" / "idlc"))
    program.chmod(0o755)
    source, back_end = folder / "back_end.c", folder / "back_end.so"
    source.write_text(BACK_END, encoding="utf-8")
    subprocess.run(["gcc", "-shared", "-fPIC", "-o", back_end, source], check=True)
    return IdlCompiler(program, back_end, package.with_name("cyclonedds.libs"))


def _repaired(program: Path) -> bytes:
    """Return the program with its dynamic section writable.

    patchelf moved that of the wheel 11.0.1 across a page that is loaded read-only, so the program ends in the loader.
    """
    image = bytearray(program.read_bytes())
    with program.open("rb") as file:
        elf = ELFFile(file)
        segments = list(elf.iter_segments())
        dynamic = next(s for s in segments if s["p_type"] == "PT_DYNAMIC")
        end = dynamic["p_vaddr"] + dynamic["p_memsz"]
        for index, segment in enumerate(segments):
            begins = segment["p_vaddr"] & ~0xFFF
            overlaps = begins < end and segment["p_vaddr"] + segment["p_memsz"] > dynamic["p_vaddr"]
            if segment["p_type"] == "PT_LOAD" and overlaps:
                place = elf["e_phoff"] + index * elf["e_phentsize"] + 4
                struct.pack_into("<I", image, place, segment["p_flags"] | WRITABLE)
    return bytes(image)
