# SPDX-License-Identifier: Apache-2.0
"""Frames of serial lines: the C code against an encoder and decoder in Python and against captured bytes."""

from __future__ import annotations

import random
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from microros_gen.selection.find_components import components_folder
from tests.support.examples import examples
from tests.support.patience import seconds
from tests.support.plans import POOL, changed
from tests.support.runtime.frames import CLIENT, Event, crc16, events, frame, stuffed
from tests.support.runtime.harness import FIXTURES, SANITIZE, Tree, compile_objects, components, link, render
from tests.support.slices import first

SERIAL = changed(POOL, transport__kind="serial")
SEND, KEPT = "xrce_framing_send.c", "xrce_framing_kept.c"
VARIANTS = {
    "gcc": ("gcc", SANITIZE, SEND),
    "clang": ("clang", SANITIZE, KEPT),
    "m32": ("gcc", ("-m32", "-Os"), KEPT),
    "clang-m32": ("clang", ("-m32", "-O2"), SEND),
}
# CREATE_CLIENT with the key A1 7E C3 7D and its answer, as captured between the public client and agent.
LOGIN = bytes.fromhex("8000000000011000585243450100010fa17ec37d8100fc01")
LOGIN_FRAME = bytes.fromhex("7e01001800800000000001100058524345 0100010fa17d5ec37d5d8100fc016ad6")
ANSWER = bytes.fromhex("81000000 04010b00 0000 58524345 0100010f 00")
ANSWER_FRAME = bytes.fromhex("7e00011300 81000000 04010b00 0000 58524345 0100010f 00 00ec")


class Framing:
    """The program of c/framing.c."""

    def __init__(self, program: Path, exact: bool) -> None:
        self.exact = exact  # it knows the size of a frame before, not just that none is larger
        self._process = subprocess.Popen(
            [program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )

    def open(self, capacity: int, chunk: int = 32) -> None:
        self._say(f"open {capacity} {chunk}")

    def feed(self, data: bytes) -> list[Event]:
        self._say(f"feed {data.hex()}")
        found = []
        while (line := self._line()) != "end":
            found.append(Event(None if line == "bad" else bytes.fromhex(line.removeprefix("got "))))
        return found

    def send(self, message: bytes, room: int = 400_000, kind: str = "room") -> tuple[bool, bytes]:
        self._say(f"{kind} {room}")
        self._say(f"send {message.hex()}")
        word, _, line = self._line().partition(" ")
        return word == "sent", bytes.fromhex(line)

    def end(self) -> None:
        _, errors = self._process.communicate(timeout=seconds(20))
        assert (self._process.returncode, errors) == (0, "")

    def _say(self, line: str) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()

    def _line(self) -> str:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            assert self._process.stderr is not None
            raise AssertionError(self._process.stderr.read())
        return line.rstrip("\n")


def _sources(folder: Path, sends: str) -> tuple[Tree, list[Path]]:
    tree = render(folder, SERIAL, components(SERIAL))
    own = components_folder() / "framing" / "src"
    return tree, [own / name for name in ("xrce_framing.c", "xrce_framing_arrived.c", sends)]


@pytest.fixture(scope="module", params=first(VARIANTS.values(), 2), ids=list(VARIANTS))
def framing(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Framing]:
    compiler, flags, sends = request.param
    tree, sources = _sources(tmp_path_factory.mktemp("framing"), sends)
    objects = compile_objects(tree, [*sources, FIXTURES / "framing.c"], compiler, flags)
    running = Framing(link(objects, compiler, flags, tree.folder / "framing"), sends == KEPT)
    yield running
    running.end()


QUICK = settings(max_examples=examples(150), deadline=None, suppress_health_check=[HealthCheck.too_slow])
SPECIAL = st.sampled_from([0x00, 0x01, 0x5D, 0x5E, 0x7D, 0x7E])
BYTES = st.lists(SPECIAL | st.integers(0, 255), max_size=90).map(bytes)
MESSAGES = BYTES.filter(bool)


def test_the_oracle_itself() -> None:
    assert crc16(b"123456789") == 0xBB3D  # the check value of CRC-16/ARC
    assert frame(LOGIN, 1, 0) == LOGIN_FRAME
    assert frame(ANSWER) == ANSWER_FRAME
    assert events(b"xx" + ANSWER_FRAME[:9] + ANSWER_FRAME + b"\x7d" + ANSWER_FRAME[:5]) == [
        Event(None),
        Event(ANSWER),
    ]


def test_captured_frames(framing: Framing) -> None:
    assert framing.send(LOGIN) == (True, LOGIN_FRAME)
    framing.open(64)
    assert framing.feed(ANSWER_FRAME) == [Event(ANSWER)]
    assert framing.feed(ANSWER_FRAME * 3) == [Event(ANSWER)] * 3


@pytest.mark.parametrize("size", [1, 25, 26, 27, 31, 32, 33, 512, 65535])
def test_sends_any_size(framing: Framing, size: int) -> None:
    message = random.Random(size).randbytes(size)
    assert framing.send(message) == (True, frame(message, 1, 0))
    only_special = bytes([0x7E]) * size
    assert framing.send(only_special) == (True, frame(only_special, 1, 0))
    framing.open(size)
    assert framing.feed(frame(message)) == [Event(message)]


@given(message=MESSAGES, room=st.integers(0, 250))
@QUICK
def test_a_line_that_takes_not_all(framing: Framing, message: bytes, room: int) -> None:
    whole = frame(message, CLIENT, 0)
    sent, taken = framing.send(message, room)
    stuffed = sum(byte in b"\x7d\x7e" for byte in message)
    least = len(whole) if framing.exact else 13 + len(message) + stuffed
    assert sent == (room >= least), "as if each byte around the message were stuffed"
    assert taken == (whole if sent else b""), "a frame goes whole or not at all"
    sent, taken = framing.send(message, room, "silent")
    assert sent == (room >= len(whole))
    assert taken == whole[:room]


def test_65536_bytes_are_refused(framing: Framing) -> None:
    assert framing.send(bytes(65536)) == (False, b"")


@given(
    messages=st.lists(MESSAGES, max_size=6),
    cuts=st.lists(st.integers(1, 40), min_size=1),
    chunk=st.integers(1, 40),
)
@QUICK
def test_any_split(framing: Framing, messages: list[bytes], cuts: list[int], chunk: int) -> None:
    stream = b"".join(map(frame, messages))
    framing.open(90, chunk)
    found = []
    for i in range(len(stream) + 1):
        size = cuts[i % len(cuts)]
        found += framing.feed(stream[:size])
        stream = stream[size:]
        if not stream:
            break
    assert found == [Event(message) for message in messages]


@given(noise=BYTES, message=MESSAGES, capacity=st.integers(1, 90), chunk=st.integers(1, 40))
@QUICK
def test_noise(framing: Framing, noise: bytes, message: bytes, capacity: int, chunk: int) -> None:
    stream = noise + frame(message) + noise
    framing.open(capacity, chunk)
    found = framing.feed(stream)
    assert found == events(stream, capacity)
    assert (Event(message) in found) or len(message) > capacity


@given(
    messages=st.lists(MESSAGES, min_size=3, max_size=5),
    victim=st.integers(0, 4),
    at=st.integers(0, 200),
    byte=SPECIAL | st.integers(0, 255),
    way=st.sampled_from(["change", "drop", "insert"]),
)
@QUICK
def test_one_bad_byte_costs_one_frame(
    framing: Framing, messages: list[bytes], victim: int, at: int, byte: int, way: str
) -> None:
    frames = [frame(message) for message in messages]
    victim %= len(frames)
    at %= len(frames[victim])
    hurt = frames[victim]
    frames[victim] = hurt[:at] + (b"" if way == "drop" else bytes([byte])) + hurt[at + (way != "insert") :]
    stream = b"".join(frames)
    framing.open(90)
    found = framing.feed(stream)
    assert found == events(stream, 90)
    messages_read = [event.message for event in found if event.message is not None]
    rest = messages[:victim] + messages[victim + 1 :]
    assert messages_read in (rest, messages)


@pytest.mark.parametrize(
    "wrong",
    [
        frame(b"hello", 1, 0),  # an echo
        frame(b"hello", 0, 2),
        frame(b"hello", 7, 1),
        frame(b""),
        frame(bytes(17)),
        frame(b"hello")[:-2] + b"xy",
        frame(b"hello")[:-3],
        frame(b"hello")[:6] + b"\x7d\x41" + frame(b"hello")[6:],
        frame(b"hello")[:6] + b"\x7d\x7d" + frame(b"hello")[6:],
        b"\x7e\x00\x01" + stuffed(b"\xff\xff") + b"hello",
        b"\x7e\x7d",
    ],
)
def test_wrong_frames(framing: Framing, wrong: bytes) -> None:
    framing.open(16)
    assert framing.feed(frame(b"one") + wrong + frame(b"two")) == [Event(b"one"), Event(None), Event(b"two")]


def test_flags_between_frames_are_nothing(framing: Framing) -> None:
    framing.open(16)
    assert framing.feed(b"\x7e\x7e" + frame(b"one") + b"\x7e\x7e\x7e" + frame(b"two")) == [
        Event(b"one"),
        Event(b"two"),
    ]
