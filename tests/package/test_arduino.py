# SPDX-License-Identifier: Apache-2.0
"""The package `arduino`: its layout, its examples, and nodes of ROS 2 on a Mega, an Uno and the host."""

from __future__ import annotations

import os
import pty
import re
import shutil
import subprocess
import time
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from microros_gen.package.render import describe, plan_package, render_package
from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.firmware.running import started
from tests.support.package.arduino import (
    CORE,
    LIBRARY,
    MEGA,
    SKETCHES,
    UNO,
    built,
    host_program,
    library,
    simulated,
)
from tests.support.patience import deadline, seconds

SENDER = """\
version: 1
profiles: [pure_sender]
errors: code
liveliness: none
transport: {type: custom, framing: true}
session: {key: 1}
nodes:
  - name: uno
    publishers: [{topic: count, type: std_msgs/msg/Int32, qos: {reliability: best_effort}}]
"""
TRANSPORT = """\
#include <HostNetwork.h>
#include <micro_ros_arduino.h>
static HostUDP udp;
static HostClient client;
static void begin_transport()
{
  const char * const kind = getenv("TRANSPORT");
  const uint16_t port = (uint16_t)atoi(getenv("AGENT"));

  if (strcmp(kind, "udp") == 0) {
    set_microros_udp_transport(udp, IPAddress(127, 0, 0, 1), port);
  } else if (strcmp(kind, "tcp") == 0) {
    set_microros_tcp_transport(client, IPAddress(127, 0, 0, 1), port);
  } else if (strcmp(kind, "stream") == 0) {
    set_microros_stream_transport(Serial);
  } else {
    set_microros_transports();
  }
}
#define BEGIN_TRANSPORT() begin_transport()
"""


@pytest.fixture(scope="module")
def files() -> dict[str, bytes]:
    return render_package(plan_package(describe("arduino"), None))


@pytest.fixture(scope="module")
def sketchbook(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the library of the general plan."""
    folder = tmp_path_factory.mktemp("sketchbook")
    library(folder)
    return folder


@pytest.fixture(scope="module")
def host(sketchbook: Path) -> Path:
    """The sketch `echo` for the host: the library as for a core of 64 bits."""
    return host_program(sketchbook, SKETCHES / "echo" / "echo.ino", TRANSPORT)


@pytest.fixture(scope="module")
def domain() -> int:
    return own_domain()


@pytest.fixture(scope="module")
def observer(domain: int) -> Iterator[Observer]:
    with observing(domain) as running:
        yield running


def test_the_layout_is_that_of_a_library(files: dict[str, bytes]) -> None:
    """Arduino library specification 1.5: properties, src/, examples/NAME/NAME.ino, keywords separated by tabs."""
    lines = files["library.properties"].decode().splitlines()
    properties = dict(line.split("=", 1) for line in lines)
    assert properties["name"] == LIBRARY
    assert re.fullmatch(r"\d+\.\d+\.\d+", properties["version"])
    assert properties["architectures"] == "*"
    assert properties["category"] == "Communication"
    assert properties.keys() >= {"author", "maintainer", "sentence", "paragraph", "url", "includes"}
    for line in files["keywords.txt"].decode().splitlines():
        assert re.fullmatch(r"\w+\t(KEYWORD[12]|LITERAL1)", line), line
    examples = [name for name in files if name.startswith("examples/")]
    assert examples
    for name in examples:
        assert re.fullmatch(r"examples/(\w+)/\1\.ino", name), name
    top = {name.partition("/")[0] for name in files}
    assert top == {
        "LICENSE",
        "README.md",
        "examples",
        "keywords.txt",
        "library.properties",
        "manifest.json",
        "sbom.spdx.json",
        "src",
    }


def test_each_keyword_is_declared(files: dict[str, bytes]) -> None:
    headers = b"\n".join(content for name, content in files.items() if name.endswith(".h")).decode()
    words = [line.split("\t")[0] for line in files["keywords.txt"].decode().splitlines()]
    assert [word for word in words if not re.search(rf"\b{word}\b", headers)] == []


def test_the_plan_of_a_project_has_no_examples(tmp_path: Path) -> None:
    config = tmp_path / "microros.yaml"
    config.write_text(SENDER)
    own = render_package(plan_package(describe("arduino"), config))
    assert not [name for name in own if name.startswith("examples/")]


@pytest.mark.builds
@pytest.mark.parametrize(("processor", "is_warned"), [("atmega328p", True), ("atmega2560", False)])
def test_too_little_ram_is_explained(tmp_path: Path, processor: str, is_warned: bool) -> None:
    """The linker only says that a section is not within a region. Arduino compiles without warnings by default."""
    if shutil.which("avr-g++") is None:
        pytest.skip("no avr-g++: apt-get install gcc-avr avr-libc")
    source = library(tmp_path) / "src" / "board_memory.cpp"
    call = ["avr-g++", f"-mmcu={processor}", "-std=gnu++11", "-w", "-fsyntax-only", str(source)]
    done = subprocess.run(call, capture_output=True, text=True, check=True)
    assert ("too little RAM" in done.stderr) == is_warned
    assert ("microros-gen package arduino -c microros.yaml -o micro_ros_arduino" in done.stderr) == is_warned


@pytest.mark.system
@pytest.mark.builds
@pytest.mark.parametrize(
    "name",
    [
        pytest.param("publisher", marks=pytest.mark.variant),
        pytest.param("subscriber", marks=pytest.mark.variant),
        "add_two_ints",
    ],
)
def test_the_examples_fit_a_mega(sketchbook: Path, name: str) -> None:
    """Half of the 8 KiB of RAM are for the stack and the sketch."""
    sketch = built(sketchbook, MEGA, sketchbook / "libraries" / LIBRARY / "examples" / name / f"{name}.ino")
    assert sketch.ram <= 4300
    assert sketch.flash <= 32 * 1024


@pytest.mark.system
@pytest.mark.ros
@pytest.mark.builds
def test_a_mega_answers(sketchbook: Path, observer: Observer, domain: int) -> None:
    """Both directions, with a float64 that the board has as a float; the agent restarts in between."""
    sketch = built(sketchbook, MEGA, SKETCHES / "echo" / "echo.ino")
    observer.subscribe("/from_board", "std_msgs/msg/Int32")
    observer.subscribe("/twist_from_board", "geometry_msgs/msg/Twist")
    with simulated(sketchbook, MEGA, sketch) as board:
        for number in (1234, -77):
            with started(
                "agent", "serial", "--dev", board.device, "--domain", str(domain), domain=domain
            ) as agent:
                agent.wait_for("agent ready")
                _answered(observer, number)
        assert sketch.ram + board.touched_stack() < 8192


@pytest.mark.system
@pytest.mark.ros
@pytest.mark.builds
def test_a_service_on_a_mega(sketchbook: Path, observer: Observer, domain: int) -> None:
    """The example, called by rclpy."""
    example = sketchbook / "libraries" / LIBRARY / "examples" / "add_two_ints" / "add_two_ints.ino"
    sketch = built(sketchbook, MEGA, example)
    with (
        simulated(sketchbook, MEGA, sketch) as board,
        started("agent", "serial", "--dev", board.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        observer.ask(do="ask_sums", service="/add_two_ints", pairs=[[1 << 40, 2], [-5, 3]])
        end = deadline(60)
        while (sums := observer.ask(do="sums")) is None or None in sums:
            assert time.monotonic() < end, sums
            time.sleep(0.1)
        assert sums == [(1 << 40) + 2, -2]


@pytest.mark.ros
@pytest.mark.builds
def test_an_uno_publishes(tmp_path: Path, observer: Observer, domain: int) -> None:
    """2 KiB of RAM: a plan for the sketch."""
    config = tmp_path / "microros.yaml"
    config.write_text(SENDER)
    library(tmp_path, config)
    sketch = built(tmp_path, UNO, SKETCHES / "sender" / "sender.ino")
    assert sketch.ram <= 1200
    observer.subscribe("/count", "std_msgs/msg/Int32", reliable=False)
    with (
        simulated(tmp_path, UNO, sketch) as board,
        started("agent", "serial", "--dev", board.device, "--domain", str(domain), domain=domain) as agent,
    ):
        agent.wait_for("agent ready")
        values = [sample["data"] for _, sample in observer.got(3, 60, "/count")]
        assert values == sorted(values)
        assert sketch.ram + board.touched_stack() < 2048


@pytest.mark.system
@pytest.mark.ros
@pytest.mark.builds
@pytest.mark.parametrize("kind", ["udp", "tcp"])
def test_network_classes(host: Path, observer: Observer, domain: int, kind: str) -> None:
    """Classes of the kinds UDP and Client over the host's sockets; millis() and micros() wrap meanwhile."""
    observer.subscribe("/from_board", "std_msgs/msg/Int32")
    observer.subscribe("/twist_from_board", "geometry_msgs/msg/Twist")
    transport = (f"{kind}4", "--port", "0")
    with running_agent(domain, "--domain", str(domain), transport=transport) as agent:
        port = agent.device.rpartition(":")[2]
        with _running(host, kind, port, None) as board:
            _answered(observer, 21)
            time.sleep(2)
            _answered(observer, 22)
            assert board.poll() is None


@pytest.mark.system
@pytest.mark.ros
@pytest.mark.builds
@pytest.mark.parametrize("kind", ["stream", "serial"])
def test_streams(host: Path, observer: Observer, domain: int, kind: str) -> None:
    """A Stream over a pseudo-terminal; a large number has bytes that frames escape."""
    observer.subscribe("/from_board", "std_msgs/msg/Int32")
    observer.subscribe("/twist_from_board", "geometry_msgs/msg/Twist")
    board_end, agent_end = pty.openpty()
    tty.setraw(board_end)
    tty.setraw(agent_end)
    serial = ("agent", "serial", "--dev", os.ttyname(agent_end), "--domain", str(domain))
    try:
        with started(*serial, domain=domain) as agent, _running(host, kind, "0", board_end) as board:
            agent.wait_for("agent ready")
            _answered(observer, 0x3E7D7E7D)
            assert board.poll() is None
    finally:
        os.close(board_end)
        os.close(agent_end)


@contextmanager
def _running(host: Path, kind: str, port: str, line: int | None) -> Iterator[subprocess.Popen[bytes]]:
    environment = {**os.environ, "TRANSPORT": kind, "AGENT": port}
    with subprocess.Popen([str(host)], stdin=line, stdout=line, env=environment) as process:
        try:
            yield process
        finally:
            process.kill()


def _answered(observer: Observer, number: int) -> None:
    """Publish a number until the board has answered it on both topics."""
    wanted = {"/from_board", "/twist_from_board"}
    end = deadline(90)
    while wanted:
        assert time.monotonic() < end, f"no answer on {sorted(wanted)}"
        observer.ask(do="publish", topic="/to_board", type="std_msgs/msg/Int32", values=[{"data": number}])
        time.sleep(0.2)
        for topic, sample in observer.ask(do="samples"):
            value = sample["data"] if topic == "/from_board" else -2.0 * sample["angular"]["z"]
            if value == 2 * number:
                wanted.discard(topic)


@pytest.mark.system
@pytest.mark.builds
@pytest.mark.parametrize(
    "compiler",
    [
        # Arduino's builder compiles them for an AVR with all warnings, and `host` for 64 bits.
        pytest.param(("avr-gcc", "-mmcu=atmega2560"), marks=pytest.mark.variant),
        ("arm-none-eabi-gcc", "-mcpu=cortex-m0plus", "-mthumb"),
        pytest.param(
            ("arm-none-eabi-gcc", "-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard"),
            marks=pytest.mark.variant,
        ),
        pytest.param(
            ("riscv64-unknown-elf-gcc", "-march=rv32imac", "-mabi=ilp32", "--specs=picolibc.specs"),
            marks=pytest.mark.variant,
        ),
        pytest.param(("gcc", "-m32"), marks=pytest.mark.variant),
        pytest.param(("gcc", "-m64"), marks=pytest.mark.variant),
    ],
    ids=lambda words: " ".join(words[:2]),
)
def test_the_sources_are_for_every_core(sketchbook: Path, compiler: tuple[str, ...]) -> None:
    """16, 32 and 64 bits, 8-byte numbers aligned to 1, 4 and 8: the planned sizes are asserted in the sources."""
    if shutil.which(compiler[0]) is None:
        pytest.skip(f"no {compiler[0]}")
    source = sketchbook / "libraries" / LIBRARY / "src"
    files = [str(path) for path in sorted(source.rglob("*.c"))]
    call = [*compiler, "-std=gnu11", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-Wno-type-limits"]
    done = subprocess.run(
        [*call, f"-I{CORE}", f"-I{source}", *files],
        capture_output=True,
        text=True,
        timeout=seconds(120),
        check=False,
    )
    assert done.returncode == 0, done.stderr[:3000]
    assert (
        b"CDR_SIZE_ANY(" in (source / "microros_sources" / "std_msgs" / "string__type_support.c").read_bytes()
    )
