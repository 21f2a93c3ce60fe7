# SPDX-License-Identifier: Apache-2.0
"""The generated C under other compilers, targets and languages: the same bytes everywhere, and no warning."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.support.slices import first
from tests.support.typesupport.build import DECODING, WARNINGS, Generated, run, unity
from tests.support.typesupport.selfcheck import write_selfcheck

pytestmark = [pytest.mark.ros, pytest.mark.builds]

COMPILED = ("__type_support.c", "__storage.c", "__functions.c", "__decode.c")
DECODERS = "".join(f'#include "{source}"\n' for source in DECODING)
GARBAGE = ["-ffunction-sections", "-fdata-sections", "-Wl,--gc-sections"]
"""What the program does not call needs the allocator, which it does not have."""


def needs(program: str) -> None:
    if shutil.which(program) is None:
        pytest.skip(f"{program} is not installed")


def build(generated: Generated, name: str, command: list[str]) -> Path:
    """Compile the self-check; only the generated code has to be free of warnings, on its own."""
    output = generated.folder / name
    source = unity(generated, f"{name}_unity.c", *COMPILED, extra=DECODERS)
    objects = generated.folder / f"{name}.o"
    run([*command, *WARNINGS, *GARBAGE, *generated.includes, "-c", source, "-o", objects])
    main = write_selfcheck(generated)
    program = generated.folder / f"{name}_main.o"
    plain = [option for option in command if not option.startswith("-fsanitize=")]
    run([*plain, "-std=c99", "-w", *GARBAGE, *generated.includes, "-c", main, "-o", program])
    run([*command, *GARBAGE, program, objects, "-o", output])
    return output


BOTH_LIMITS = pytest.mark.parametrize(
    "limits_case", ["same", pytest.param("differing", marks=pytest.mark.long)], indirect=True
)


@pytest.fixture(scope="session")
def baseline(limits_case: Generated) -> str:
    """What gcc on this host prints. Its bytes are held against ROS 2 in test_bytes.py."""
    printed = run([build(limits_case, "baseline", ["gcc", "-O0"])])
    assert "WRONG" not in printed
    assert len(printed.splitlines()) > 300
    return printed


@BOTH_LIMITS
@pytest.mark.lint
def test_portable_path_writes_the_same(limits_case: Generated, baseline: str) -> None:
    """Byte by byte, as on a big endian target: no run is copied as it lies in memory."""
    assert run([build(limits_case, "portable", ["gcc", "-O0", "-DCDR_HOST_IS_LITTLE_ENDIAN=0"])]) == baseline


@BOTH_LIMITS
@pytest.mark.lint
def test_clang_with_sanitizers_writes_the_same(limits_case: Generated, baseline: str) -> None:
    """Storage and body are blocks of exactly their size, so a byte too far is seen."""
    needs("clang")
    options = ["-fsanitize=address,undefined,implicit-conversion", "-fno-sanitize-recover=all"]
    program = build(limits_case, "sanitized", ["clang", "-O0", "-Wno-unused-command-line-argument", *options])
    environment = {**os.environ, "ASAN_OPTIONS": "detect_leaks=0"}
    environment.pop("LD_PRELOAD", None)
    result = subprocess.run([program], capture_output=True, text=True, env=environment, check=False)
    assert result.returncode == 0, result.stderr
    assert result.stdout == baseline


@BOTH_LIMITS
@pytest.mark.lint
def test_32_bit_writes_the_same(limits_case: Generated, baseline: str, tmp_path: Path) -> None:
    probe = tmp_path / "probe.c"
    probe.write_text("#include <stdio.h>\nint main(void) { return 0; }\n")
    found = subprocess.run(["gcc", "-m32", probe, "-o", tmp_path / "probe"], capture_output=True, check=False)
    if found.returncode != 0:
        pytest.skip("no 32-bit C library (gcc-multilib)")
    assert run([build(limits_case, "m32", ["gcc", "-m32", "-O0"])]) == baseline


@BOTH_LIMITS
def test_cortex_m_compiles(limits_case: Generated) -> None:
    """Sizes of structs and storage under the Arm EABI are those of the plan (asserted in the code)."""
    needs("arm-none-eabi-gcc")
    source = unity(limits_case, "arm.c", *COMPILED, extra=DECODERS)
    command = ["arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", *WARNINGS, *limits_case.includes]
    run([*command, "-fsyntax-only", source])


@pytest.mark.parametrize("compiler", first(["g++", "clang++"]))
@BOTH_LIMITS
def test_headers_are_usable_from_cpp(limits_case: Generated, compiler: str, tmp_path: Path) -> None:
    """All of them in one C++ file, in both orders; and each by itself in C."""
    needs(compiler)
    headers = sorted(path for path in limits_case.files if path.endswith(".h"))
    for order in (headers, headers[::-1]):
        source = tmp_path / "headers.cpp"
        source.write_text("".join(f'#include "{h.removeprefix("include/")}"\n' for h in order))
        command = [compiler, "-std=c++11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only"]
        run([*command, *limits_case.includes, source])


@pytest.mark.system
def test_each_header_compiles_alone(everything: Generated, tmp_path: Path) -> None:
    sources = []
    packages = ("include/test_msgs/", "include/sensor_msgs/", "include/std_msgs/")
    for header in sorted(p for p in everything.files if p.endswith(".h") and p.startswith(packages)):
        source = tmp_path / (header.replace("/", "_") + ".c")
        source.write_text(f'#include "{header.removeprefix("include/")}"\n')
        sources.append(source)
    run(["gcc", *WARNINGS, "-fsyntax-only", *everything.includes, *sources])
