# SPDX-License-Identifier: Apache-2.0
"""The loop of a replay with more links than select(2) can watch."""

from __future__ import annotations

import os
import resource
from collections.abc import Iterator
from pathlib import Path

import pytest

from microros_gen.agent.recording.recorded import Conversation, read_recording
from microros_gen.agent.replay.links import Received
from microros_gen.agent.replay.player import Player
from microros_gen.agent.replay.run import ClientSide, Replay
from microros_gen.cli.agent.replaying import _allow_descriptors
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
    ((found,), _) = read_recording(tmp_path / "a")
    return found


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
    whole, _ = read_recording(tmp_path / "a")
    chosen, outside = read_recording(tmp_path / "a", whole[1].key)
    assert outside == 0
    assert [each.key for each in chosen] == [each.key for each in whole]
    assert len(chosen[0].messages) == 1
    assert chosen[1] == whole[1]
