# SPDX-License-Identifier: Apache-2.0
"""The boards of examples/boards: each compiles for its processor, and its port carries samples to ROS 2.

No vendor's SDK is needed: stand_ins/ declares the few functions that the ports call of it, and has them over POSIX, so
that a port can run on a computer. The image of the Nucleo runs in QEMU as it is.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.platform.find import read_target
from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.paths import ROOT
from tests.support.patience import deadline

BOARDS = ROOT / "examples" / "boards"
STAND_INS = Path(__file__).parent / "stand_ins"
SOURCES = {
    "nucleo_f446re": ("serial.c",),
    "pico": ("usb.c",),
    "esp32c3": ("main/port.c", "main/main.c"),
}
STRICT = (
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wsign-conversion",
    "-Wshadow",
    "-Werror",
)


def run(*command: str | Path) -> str:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    words = [str(word) for word in command]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{words}\n{done.stdout}{done.stderr}"
    return done.stdout


def tool(*arguments: str | Path) -> str:
    return run(sys.executable, "-m", "microros_gen", *arguments)


def compiler_of(board: str) -> list[str]:
    """Return the compiler of a board's processor with its flags, or skip."""
    found = re.search(r"\{name: ([\w.-]+)\}", (BOARDS / board / "microros.yaml").read_text(encoding="utf-8"))
    assert found
    target = read_target(found[1], BOARDS / board, None, Diagnostics())
    assert target is not None
    if shutil.which(target.target.compilers[0]) is None:
        pytest.skip(f"no {target.target.compilers[0]}: apt-get install {target.target.package}")
    return [target.target.compilers[0], *target.target.c_flags]


@pytest.mark.parametrize("board", SOURCES)
def test_application_and_port_compile_for_the_processor(board: str, tmp_path: Path) -> None:
    compiler = compiler_of(board)
    tool("generate", "-c", BOARDS / board / "microros.yaml", "-o", tmp_path / "out")
    include = [f"-I{tmp_path / 'out/include'}", f"-isystem{STAND_INS / board}"]
    for source in ("../counter.c", *SOURCES[board]):
        run(*compiler, *STRICT, *include, "-c", BOARDS / board / source, "-o", tmp_path / "object.o")


def test_the_project_for_esp_idf_has_every_function_once(tmp_path: Path) -> None:
    """Its sources become one archive, so what port.c has must be nowhere else."""
    board = BOARDS / "esp32c3"
    tool("generate", "-c", board / "microros.yaml", "-o", tmp_path)
    (left_out,) = re.findall(
        r'EXCLUDE REGEX "(.*)"', (board / "main/CMakeLists.txt").read_text(encoding="utf-8")
    )
    names = re.compile(r"^[a-z]\w* \**(port_\w+)\([^;]*$", re.MULTILINE)
    own = set(names.findall((board / "main/port.c").read_text(encoding="utf-8")))
    assert {"port_time_ms", "port_sleep_ms", "port_udp_open", "port_udp_receive"} <= own
    for source in (tmp_path / "sources.txt").read_text(encoding="utf-8").split():
        found = own & set(names.findall((tmp_path / source).read_text(encoding="utf-8")))
        assert bool(found) is bool(re.search(left_out.replace("\\\\", "\\"), source)), source


@pytest.mark.long
@pytest.mark.parametrize("board", ["pico", "esp32c3"])
def test_the_library_compiles_for_the_processor(board: str, tmp_path: Path) -> None:
    """That of the Nucleo is compiled and linked by the commands of its page."""
    compiler_of(board)
    assert "library" in tool("build", "-c", BOARDS / board / "microros.yaml", "-o", tmp_path / "out")


def counts(observer: Observer) -> None:
    """Wait until six samples came, each one more than the one before."""
    seen: list[int] = []
    end = deadline(60)
    while len(seen) < 6:
        assert time.monotonic() < end, seen
        seen += [value["data"] for topic, value in observer.ask(do="samples") if topic == "/count"]
        time.sleep(0.05)
    assert seen == list(range(seen[0], seen[0] + len(seen)))


@contextmanager
def running(*command: str | Path, **more: str) -> Iterator[None]:
    process = subprocess.Popen([str(word) for word in command], env={**os.environ, **more})
    try:
        yield
        assert process.poll() is None
    finally:
        process.kill()
        process.wait(10)


def built_here(board: str, folder: Path, *changes: tuple[str, str]) -> Path:
    """Build a board's application, port and stand-ins for this computer; `changes` are of its microros.yaml."""
    text = (BOARDS / board / "microros.yaml").read_text(encoding="utf-8")
    text = re.sub(r"\{name: [\w.-]+\}", "{name: host}", text)
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / "microros.yaml").write_text(text, encoding="utf-8")
    tool("build", "-c", folder / "microros.yaml", "-o", folder / "out")
    sources = [
        BOARDS / "counter.c",
        *(BOARDS / board / name for name in SOURCES[board]),
        STAND_INS / board / "posix.c",
    ]
    include = [f"-I{folder / 'out/include'}", f"-I{STAND_INS / board}"]
    run(
        "cc",
        "-D_DEFAULT_SOURCE",
        *STRICT,
        *include,
        *sources,
        folder / "out/lib/libmicroros.a",
        "-o",
        folder / "board",
    )
    return folder / "board"


@pytest.fixture
def observer() -> Iterator[Observer]:
    with observing(own_domain()) as found:
        found.subscribe("/count", "std_msgs/msg/Int32", reliable=True)
        yield found


@pytest.mark.long
@pytest.mark.ros
def test_the_port_of_the_esp32c3_carries_samples(observer: Observer, tmp_path: Path) -> None:
    domain = own_domain()
    with running_agent(domain, "--domain", str(domain)) as agent:
        place = f"127.0.0.1:{agent.port}"
        with running(built_here("esp32c3", tmp_path, ("192.168.1.10:8888", place))):
            counts(observer)


@pytest.mark.long
@pytest.mark.ros
def test_the_port_of_the_pico_carries_samples(observer: Observer, tmp_path: Path) -> None:
    domain = own_domain()
    program = built_here("pico", tmp_path)
    with (
        running_agent(domain, "--domain", str(domain), transport=("pty",)) as agent,
        running(program, BOARD_LINE=agent.device),
    ):
        counts(observer)


@pytest.mark.long
@pytest.mark.ros
def test_the_image_of_the_nucleo_carries_samples(observer: Observer, tmp_path: Path) -> None:
    """In QEMU's nearest machine: its clock is another, and it has no unique id."""
    compiler_of("nucleo_f446re")
    if shutil.which("qemu-system-arm") is None:
        pytest.skip("no qemu-system-arm: apt-get install qemu-system-arm")
    for name, old, new in (
        ("board.yaml", "clock_hz: 16000000", "clock_hz: 168000000"),
        ("microros.yaml", "{key: device}", "{key: 7}"),
    ):
        text = (BOARDS / "nucleo_f446re" / name).read_text(encoding="utf-8")
        assert old in text
        (tmp_path / name).write_text(text.replace(old, new), encoding="utf-8")
    out, build = tmp_path / "out", tmp_path / "build"
    tool("generate", "-c", tmp_path / "microros.yaml", "-o", out)
    toolchain = f"-DCMAKE_TOOLCHAIN_FILE={out / 'toolchain.cmake'}"
    run("cmake", "-S", BOARDS / "nucleo_f446re", "-B", build, f"-DMICROROS_OUT={out}", toolchain)
    run("cmake", "--build", build)
    domain = own_domain()
    with running_agent(domain, "--domain", str(domain), transport=("pty",)) as agent:
        line = [
            "-chardev",
            f"serial,id=line,path={agent.device}",
            "-serial",
            "null",
            "-serial",
            "chardev:line",
        ]
        machine = ["qemu-system-arm", "-M", "netduinoplus2", "-display", "none"]
        with running(*machine, *line, "-kernel", build / "counter.elf"):
            counts(observer)
