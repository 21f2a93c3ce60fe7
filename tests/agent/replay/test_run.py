# SPDX-License-Identifier: Apache-2.0
"""The loop of a replay with more links than select(2) can watch."""

from __future__ import annotations

import errno
import io
import os
import resource
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from microros_gen.agent.recording.message_index import ENTRIES_OF_BLOCK
from microros_gen.agent.recording.packets import Datagram, endpoint
from microros_gen.agent.recording.packets import encode as encode_frame
from microros_gen.agent.recording.pcapng import INBOUND, interface, packet, section
from microros_gen.agent.recording.recorded import Conversation, open_recording
from microros_gen.agent.replay.links import Received
from microros_gen.agent.replay.player import Player
from microros_gen.agent.replay.run import ClientSide, Replay
from microros_gen.agent.wire.data_messages import WriteData
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.session_messages import CreateClient
from microros_gen.agent.wire.submessages import encode
from microros_gen.cli.agent.replaying import _allow_descriptors, _run
from microros_gen.diagnostics import UserError
from tests.support.agent.fakes import Bench
from tests.support.agent.recordings import record_visitor

LINKS = 1100
FD_SETSIZE = 1024


class Answered:
    """A link whose other end is a separate agent; an event of the system says that answers wait."""

    def __init__(self) -> None:
        self._bench = Bench()
        self._event = os.eventfd(0)
        self._answers: list[bytes] = []

    def fileno(self) -> int:
        return self._event

    def send(self, number: int, message: bytes) -> None:
        self._bench.now += 0.05
        self._answers += map(bytes.fromhex, self._bench.say(message))
        if self._answers:
            os.eventfd_write(self._event, 1)

    def receive(self, received: Received) -> None:
        os.eventfd_read(self._event)
        answers, self._answers = self._answers, []
        for answer in answers:
            received(0, answer)

    def close(self) -> None:
        os.close(self._event)


@pytest.fixture
def conversation(tmp_path: Path) -> Conversation:
    record_visitor(tmp_path / "a", "udp4 127.0.0.1:8888", 7)
    with open_recording(tmp_path / "a") as recording:
        (found,) = recording.conversations
        return replace(found, messages=tuple(found.messages))


@pytest.fixture
def few_descriptors() -> Iterator[None]:
    """Let the process begin with the soft limit that Linux has by default."""
    before = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(FD_SETSIZE, before[1]), before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_NOFILE, before)


@pytest.mark.usefixtures("few_descriptors")
def test_more_conversations_than_descriptors_of_select(conversation: Conversation) -> None:
    if resource.getrlimit(resource.RLIMIT_NOFILE)[1] < LINKS + 100:
        pytest.skip("the system allows fewer descriptors")
    _allow_descriptors(LINKS)
    players = [Player(conversation, as_agent=False, wait_s=60) for _ in range(LINKS)]
    links = [Answered() for _ in players]
    assert max(link.fileno() for link in links) > FD_SETSIZE
    side = ClientSide(players, links, [0] * LINKS)
    try:
        Replay(players, side, 0).run()
        assert {player.difference for player in players} == {""}
        assert all(player.done for player in players)
    finally:
        side.close()
        for link in links:
            link.close()


def test_only_the_messages_of_the_chosen_client_are_kept(tmp_path: Path) -> None:
    record_visitor(tmp_path / "a", "udp4 127.0.0.1:8888", 7, 8)
    with open_recording(tmp_path / "a") as whole, open_recording(tmp_path / "a", "00000008") as chosen:
        assert chosen.outside == 0
        assert [each.key for each in chosen.conversations] == [each.key for each in whole.conversations]
        assert len(list(chosen.conversations[0].messages)) == 1
        assert list(chosen.conversations[1].messages) == list(whole.conversations[1].messages)


def test_the_messages_of_several_clients_are_read_side_by_side(tmp_path: Path) -> None:
    """Longer than one block of the index; each conversation has its own place in the file."""
    count = 2 * ENTRIES_OF_BLOCK + 7
    path = tmp_path / "a"
    places = [(endpoint(f"127.0.0.1:{port}"), key) for port, key in ((5, 7), (6, 8))]
    with path.open("wb") as file:
        file.write(section("test") + interface("udp4 127.0.0.1:8888", ""))
        opened = [(place, opening(key)) for place, key in places]
        samples = [
            (place, join(Header(0x81, 1, n & 0xFFFF), [encode(WriteData(n & 0xFFFF, 0x0015, bytes([key])))]))
            for n in range(count)
            for place, key in places
        ]
        for at, (place, data) in enumerate(opened + samples):
            frame = encode_frame(Datagram(place, endpoint("127.0.0.1:8888"), data))
            file.write(packet(0, at, frame, INBOUND))
    with open_recording(path) as recording:
        first, second = (iter(each.messages) for each in recording.conversations)
        both = [message for pair in zip(first, second, strict=True) for message in pair]
    assert [message.data for message in both] == [data for _, data in opened + samples]
    assert [message.number for message in both] == list(range(1, len(both) + 1))


def opening(key: int) -> bytes:
    return join(Header(0x80, 0, 0), [encode(CreateClient(key.to_bytes(4, "big"), 0x81, 512))])


def test_a_recording_from_a_pipe(tmp_path: Path) -> None:
    record_visitor(tmp_path / "a", "udp4 127.0.0.1:8888", 7)
    reader, writer = os.pipe()
    with os.fdopen(reader, "rb") as end, os.fdopen(writer, "wb") as start:
        start.write((tmp_path / "a").read_bytes())
        start.close()
        with open_recording(Path(f"/dev/fd/{end.fileno()}")) as piped, open_recording(tmp_path / "a") as file:
            for first, second in zip(piped.conversations, file.conversations, strict=True):
                assert list(first.messages) == list(second.messages)


def test_a_file_that_is_shortened_meanwhile(tmp_path: Path) -> None:
    record_visitor(tmp_path / "a", "udp4 127.0.0.1:8888", 7)
    with open_recording(tmp_path / "a") as recording:
        (tmp_path / "a").write_bytes(b"")
        with pytest.raises(UserError, match="cannot be replayed: it was changed meanwhile"):
            list(recording.conversations[0].messages)


class Share(io.BytesIO):
    """A file on a network share, which may be lost."""

    lost = False

    def read(self, size: int | None = -1, /) -> bytes:
        if self.lost:
            raise OSError(errno.ESTALE, os.strerror(errno.ESTALE))
        return super().read(size)


def test_a_file_that_cannot_be_read_any_more(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The other side of the replay is not at fault."""
    record_visitor(tmp_path / "a", "udp4 127.0.0.1:8888", 7)
    file = Share((tmp_path / "a").read_bytes())
    monkeypatch.setattr(Path, "open", lambda *_: file)
    with open_recording(tmp_path / "a") as recording:
        player = Player(recording.conversations[0], as_agent=False, wait_s=60)
        link = Answered()
        side = ClientSide([player], [link], [0])
        run = Replay([player], side, 0)
        file.lost = True
        with pytest.raises(UserError, match=f"/a cannot be replayed: {os.strerror(errno.ESTALE)}"):
            _run(run)
    side.close()
    link.close()
