# SPDX-License-Identifier: Apache-2.0
"""Serial lines on pseudo-terminals: one agent and its line in this process, clients at the other end."""

from __future__ import annotations

import contextlib
import os
import random
import threading
import time
import tracemalloc
from collections.abc import Iterator
from pathlib import Path

import pytest

from microros_gen.agent.server import Server
from microros_gen.agent.transport.line import QUEUE_BYTES, Line
from microros_gen.agent.transport.serial import Pty, open_device, serial_line, speeds
from microros_gen.diagnostics import UserError
from tests.support.agent.cable import Cable
from tests.support.agent.captured_frames import CREATE_CLIENT_FRAME, STATUS_AGENT_FRAME
from tests.support.agent.client import XrceClient, int32_body
from tests.support.agent.fakes import Bench
from tests.support.agent.serial_link import SerialLink, frame
from tests.support.patience import deadline

INT32 = "std_msgs/msg/Int32"


class Served:
    """An agent with fakes after real lines, in a thread."""

    def __init__(self, *lines: Line, bench: Bench | None = None) -> None:
        self.bench = bench or Bench()
        self.ready: list[str] = []
        self._server = Server(self.bench.agent, lines, self.bench.log)
        self._thread = threading.Thread(target=self._run)

    def _run(self) -> None:
        self._server.run(lambda transport: self.ready.append(transport.label), time.monotonic)

    def __enter__(self) -> Served:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._server.stop()
        self._thread.join()

    def wait_for(self, text: str, count: int = 1) -> None:
        end = deadline(5)
        while self.bench.text.getvalue().count(text) < count:
            assert time.monotonic() < end, f"no '{text}' in:\n{self.bench.text.getvalue()}"
            time.sleep(0.01)


def wait_until(done, what: str) -> None:  # type: ignore[no-untyped-def]
    end = deadline(5)
    while not done():
        assert time.monotonic() < end, what
        time.sleep(0.01)


@pytest.fixture
def cable() -> Iterator[Cable]:
    plugged = Cable()
    yield plugged
    with contextlib.suppress(OSError):
        plugged.pull()


def publish(client: XrceClient, served: Served, values: range) -> None:
    """Connect, create a publisher, send, and see that it arrived."""
    assert client.connect() == 0
    writer = client.publisher("node", "count", INT32, 0)
    before = len(served.bench.bridge.published)
    for value in values:
        client.write(writer, int32_body(value))
    client.drain()
    received = [data[4:] for _, data in served.bench.bridge.published[before:]]
    assert received == [int32_body(v) for v in values]


def test_a_client_on_a_device(cable: Cable) -> None:
    bench = Bench()
    with Served(serial_line(cable.device, 115_200, bench.log), bench=bench) as served:
        publish(XrceClient(SerialLink(cable.end)), served, range(100))
        assert served.ready == [f"serial {cable.device}"]
    assert not bench.log.counters, bench.text.getvalue()


def test_captured_bytes_of_the_public_client(cable: Cable) -> None:
    """Its CREATE_CLIENT is answered byte for byte as its own agent does."""
    bench = Bench()
    link = SerialLink(cable.end)
    with Served(serial_line(cable.device, 115_200, bench.log), bench=bench) as served:
        link.send_raw(bytes.fromhex(CREATE_CLIENT_FRAME))
        served.wait_for("client A17EC37D connected")
        assert os.read(cable.end, 100) == bytes.fromhex(STATUS_AGENT_FRAME)


def test_several_clients_on_one_line(cable: Cable) -> None:
    bench = Bench()
    # Two links on one descriptor take each other's frames: they are used one after the other.
    with Served(serial_line(cable.device, 115_200, bench.log), bench=bench) as served:
        for address in (1, 2, 0x7D, 0x7E, 255):
            client = XrceClient(SerialLink(cable.end, address), key=0x100 + address)
            publish(client, served, range(5))
        assert len(bench.agent.clients) == 5
        places = {client.place for client in bench.agent.clients}
        assert f"{cable.device} client 126" in places


def test_what_an_older_run_left_in_the_line(cable: Cable) -> None:
    link = SerialLink(cable.end)
    link.send_raw(b"ets Jun  8 2016\r\n" + frame(b"x" * 50)[7:])
    link.send_raw(frame(b"y" * 50)[:30])
    bench = Bench()
    with Served(serial_line(cable.device, 115_200, bench.log), bench=bench) as served:
        publish(XrceClient(link), served, range(10))
    assert bench.log.counters == {"frame_noise": 1, "frame_truncated": 1}
    assert "ets Jun" in bench.text.getvalue()


def test_unplugged_and_plugged_in_again(tmp_path: Path) -> None:
    """The path stays, as /dev/ttyACM0 does; the client goes on when the device is back."""
    device = tmp_path / "tty"
    bench = Bench()
    line = serial_line(str(device), 115_200, bench.log)
    assert "cannot be opened (No such file or directory); waiting for it" in bench.text.getvalue()
    with Served(line, bench=bench) as served:
        for turn in range(3):
            assert len(served.ready) == min(turn, 1)
            cable = Cable()
            device.symlink_to(cable.device)
            served.wait_for("is back" if turn else "is available", max(turn, 1))
            publish(XrceClient(SerialLink(cable.end)), served, range(20))
            device.unlink()
            cable.pull()
            served.wait_for("is gone", turn + 1)
    assert bench.text.getvalue().count("cannot be opened") == 1
    assert served.ready == [f"serial {device}"]


def test_two_devices_and_one_of_them_vanishes(cable: Cable) -> None:
    other = Cable()
    bench = Bench()
    lines = [serial_line(c.device, 9600, bench.log) for c in (cable, other)]
    with Served(*lines, bench=bench) as served:
        publish(XrceClient(SerialLink(other.end), key=2), served, range(5))
        other.pull()
        served.wait_for("is gone")
        publish(XrceClient(SerialLink(cable.end), key=1), served, range(50))


def test_a_client_that_does_not_read(cable: Cable) -> None:
    """The agent does not wait for it, holds a bounded queue, and goes on when it reads again."""
    bench = Bench()
    line = serial_line(cable.device, 115_200, bench.log)
    message = bytes(1_000)
    start = time.monotonic()
    for _ in range(200):
        line.send(message, (line.label, 1))
    assert time.monotonic() - start < 2
    assert line.writing
    assert bench.log.counters["line_full"] > 200 - 1 - (QUEUE_BYTES + 65_536) // 1_000
    link = SerialLink(cable.end)
    link.settimeout(1.0)
    received = 0
    with contextlib.suppress(TimeoutError):
        while line.writing:
            assert link.recv(0) == message  # frames are whole
            received += 1
            line.pump(lambda *_: None)
    assert received > QUEUE_BYTES // 1_000 - 5
    line.close()


def test_noise_in_front_of_the_whole_agent(cable: Cable) -> None:
    """Never raises, keeps its memory, tells each kind of fault once, and serves the next client."""
    drown(cable, chunks=400, seed=7)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(10))
def test_noise_in_front_of_the_whole_agent_at_length(cable: Cable, seed: int) -> None:
    drown(cable, chunks=20_000, seed=seed)


def drown(cable: Cable, chunks: int, seed: int) -> None:
    chance = random.Random(seed)
    bench = Bench()
    link = SerialLink(cable.end)
    with Served(serial_line(cable.device, 115_200, bench.log), bench=bench) as served:
        tracemalloc.start()
        try:
            for _ in range(chunks):
                link.send_raw(noise(chance))
            assert tracemalloc.get_traced_memory()[0] < 1_500_000
        finally:
            tracemalloc.stop()
        link.send_raw(b"\x7e")
        time.sleep(0.1)
        bench.now += 1  # what strangers may say in one second is used up
        publish(XrceClient(SerialLink(cable.end, 9), key=0x77), served, range(10))
    faults = bench.log.counters
    assert {"frame_noise", "frame_crc", "frame_truncated", "frame_escape"} <= set(faults)
    assert not [kind for kind in faults if kind.startswith("internal_")], bench.text.getvalue()
    assert bench.text.getvalue().count("further ones are only counted") == len(faults)


def noise(chance: random.Random) -> bytes:
    """Return random bytes, broken frames, and whole frames with nonsense in them."""
    match chance.randrange(4):
        case 0:
            return chance.randbytes(chance.randrange(1, 300))
        case 1:
            whole = bytearray(frame(chance.randbytes(40)))
            whole[chance.randrange(len(whole))] ^= 1 << chance.randrange(8)
            return bytes(whole)
        case 2:
            return frame(chance.randbytes(40))[: chance.randrange(1, 40)]
        case _:
            head = bytes((0x81, chance.choice((0, 1, 0x80)), chance.randrange(16), 0))
            return frame(head + bytes((chance.randrange(17), 1)) + chance.randbytes(chance.randrange(60)), 3)


@pytest.mark.parametrize(
    ("device", "baud", "wanted"),
    [
        ("/dev/null", 115_200, "/dev/null is not a serial device"),
        ("/dev/ttyUSB77", 115_201, "no serial speed of 115201 bit/s. The nearest is 115200"),
        ("/", 115_200, "/ is not a serial device"),
    ],
)
def test_what_can_never_be_a_line(device: str, baud: int, wanted: str) -> None:
    with pytest.raises(UserError, match=wanted):
        serial_line(device, baud, Bench().log)


def test_a_device_has_one_agent(cable: Cable) -> None:
    first = serial_line(cable.device, 115_200, Bench().log)
    with pytest.raises(UserError, match="in use by another program"):
        serial_line(cable.device, 115_200, Bench().log)
    first.close()
    os.close(open_device(cable.device, 921_600))
    assert 921_600 in speeds()


def test_a_pseudo_terminal(tmp_path: Path) -> None:
    """Its name stays while clients come and go, and the link goes with it."""
    link = tmp_path / "board"
    link.symlink_to("/dev/pts/99999")  # left by an agent that was killed
    bench = Bench()
    pty = Pty(bench.log, link)
    assert str(link.readlink()) == pty.device
    with Served(pty, bench=bench) as served:
        for _ in range(2):
            with XrceClient(SerialLink(str(link))) as client:
                publish(client, served, range(20))
        assert served.ready == [f"serial {link}"]
    assert not link.is_symlink()
    assert not bench.log.counters


def test_a_link_does_not_replace_a_file(tmp_path: Path) -> None:
    (tmp_path / "board").write_text("precious")
    with pytest.raises(UserError, match="board: File exists"):
        Pty(Bench().log, tmp_path / "board")
    assert (tmp_path / "board").read_text() == "precious"
