# SPDX-License-Identifier: Apache-2.0
"""Decoders under other compilers and targets, a big endian one among them, and under libFuzzer with the sanitizers."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.support.examples import examples
from tests.support.typesupport.build import DECODING, WARNINGS, Generated, run, unity
from tests.support.typesupport.replay import FUZZ, REPLAY, write_bodies, write_program, write_seeds

pytestmark = [pytest.mark.ros, pytest.mark.builds, pytest.mark.system]

COMPILED = ("__type_support.c", "__storage.c", "__decode.c")
INITIALIZED = (
    *(
        f"geometry_msgs/{name}__functions.c"
        for name in ("point", "pose", "quaternion", "transform", "vector3")
    ),
    *("test_msgs/defaults__functions.c", "test_interface_files/defaults__functions.c"),
)
"""Functions that storage calls, for elements of fixed size that do not start at zero."""
MODES = ("empty", "full", "random", "random")
SANITIZERS = "-fsanitize=address,undefined,implicit-conversion"
GARBAGE = "-Wl,--gc-sections"
FUZZ_RUNS = 60_000
FUZZ_SECONDS = int(os.environ.get("MICROROS_FUZZ_SECONDS", "600"))


def needs(*programs: str) -> None:
    for program in programs:
        if shutil.which(program) is None:
            pytest.skip(f"{program} is not installed")


def objects(generated: Generated, name: str, command: list[str], program: Path) -> list[Path]:
    """Compile the generated code with every warning as an error, and the program without."""
    extra = "".join(f'#include "{c}"\n' for c in DECODING)
    source = unity(generated, f"{name}_unity.c", *COMPILED, *INITIALIZED, extra=extra)
    code, main = generated.folder / f"{name}.o", generated.folder / f"{name}_main.o"
    run([*command, *WARNINGS, "-ffunction-sections", *generated.includes, "-c", source, "-o", code])
    run([*command, "-std=c99", "-w", *generated.includes, "-c", program, "-o", main])
    return [main, code]


@pytest.fixture(scope="session")
def replayed(everything: Generated) -> tuple[Path, int]:
    """The file of bodies, and how many it has."""
    path = everything.folder / "bodies"
    return path, write_bodies(everything, path, MODES)


def replay(everything: Generated, replayed: tuple[Path, int], program: list[str | Path]) -> None:
    """Bodies of both byte orders: each must encode to the same little endian bytes as everywhere."""
    path, count = replayed
    assert run([*program, path]) == f"{count} bodies\n"
    assert count > 8 * 200


@pytest.mark.variant
@pytest.mark.system
def test_32_bit_reads_the_same(everything: Generated, replayed: tuple[Path, int], tmp_path: Path) -> None:
    probe = tmp_path / "probe.c"
    probe.write_text("#include <stdio.h>\nint main(void) { return 0; }\n")
    found = subprocess.run(["gcc", "-m32", probe, "-o", tmp_path / "probe"], capture_output=True, check=False)
    if found.returncode != 0:
        pytest.skip("no 32-bit C library (gcc-multilib)")
    program = write_program(everything, "replay.c", REPLAY)
    compiled = objects(everything, "replay_m32", ["gcc", "-m32", "-O0"], program)
    output = everything.folder / "replay_m32"
    run(["gcc", "-m32", GARBAGE, *compiled, "-o", output])
    replay(everything, replayed, [output])


@pytest.mark.parametrize(
    ("target", "emulator"),
    [
        ("powerpc-linux-gnu", "qemu-ppc"),
        pytest.param("arm-linux-gnueabihf", "qemu-arm", marks=pytest.mark.variant),
    ],
)
def test_other_targets_read_the_same(
    everything: Generated, replayed: tuple[Path, int], target: str, emulator: str
) -> None:
    """A big endian one, and Arm: clang compiles for both; start files and libraries are Debian's for cross gcc."""
    needs("clang", emulator, f"{target}-ld")
    library, compiler = Path("/usr") / target / "lib", sorted(Path("/usr/lib/gcc-cross").glob(f"{target}/*"))
    if not (library / "libc.a").exists() or not compiler:
        pytest.skip(f"no C library for {target}")
    command = ["clang", f"--target={target}", "-O0", "-isystem", f"/usr/{target}/include"]
    program = write_program(everything, "replay.c", REPLAY)
    compiled = objects(everything, f"replay_{target}", command, program)
    start = [library / "crt1.o", library / "crti.o", compiler[-1] / "crtbegin.o"]
    end: list[str | Path] = [
        "--start-group",
        "-lc",
        "-lgcc",
        "-lgcc_eh",
        "--end-group",
        compiler[-1] / "crtend.o",
        library / "crtn.o",
    ]
    output = everything.folder / f"replay_{target}"
    link: list[str | Path] = [
        f"{target}-ld",
        "-static",
        "--gc-sections",
        "--no-warn-rwx-segments",
        "-o",
        str(output),
        *start,
        *compiled,
    ]
    run([*link, f"-L{library}", f"-L{compiler[-1]}", *end])
    replay(everything, replayed, [emulator, output])


@pytest.fixture(scope="session")
def fuzzer(everything: Generated) -> Path:
    needs("clang")
    command = ["clang", "-O0", f"-fsanitize=fuzzer,{SANITIZERS.removeprefix('-fsanitize=')}"]
    command += ["-fno-sanitize-recover=all", "-Wno-unused-command-line-argument"]
    output = everything.folder / "fuzz"
    compiled = objects(everything, "fuzz", command, write_program(everything, "fuzz_main.c", FUZZ))
    run([*command, GARBAGE, *compiled, "-o", output])
    return output


def fuzz(program: Path, corpus: Path, *options: str) -> None:
    environment = {k: v for k, v in os.environ.items() if k != "LD_PRELOAD"}
    # No limit of its resident memory: Linux counts that of pytest, which started it, as its own peak.
    command: list[str | Path] = [program, "-max_len=4096", "-rss_limit_mb=0", "-print_final_stats=1"]
    command += [*options, corpus]
    result = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=corpus, check=False)
    assert result.returncode == 0, result.stderr[-4000:]
    print(*(line for line in result.stderr.splitlines() if line.startswith("stat::")), sep="\n")


@pytest.mark.system
@pytest.mark.examples
def test_whatever_the_bytes_nothing_is_out_of_bounds(
    everything: Generated, fuzzer: Path, tmp_path: Path
) -> None:
    """A slice of the long run: the same first bytes and the same changes each time."""
    write_seeds(everything, tmp_path / "corpus")
    fuzz(fuzzer, tmp_path / "corpus", f"-runs={examples(FUZZ_RUNS)}", "-seed=1")


@pytest.mark.long
def test_fuzzing_for_long(everything: Generated, fuzzer: Path, tmp_path: Path) -> None:
    write_seeds(everything, tmp_path / "corpus")
    fuzz(fuzzer, tmp_path / "corpus", f"-max_total_time={FUZZ_SECONDS}")
