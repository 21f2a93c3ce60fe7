# SPDX-License-Identifier: Apache-2.0
"""Four images of one chip: three send to the first one, which reads from each of them in turn."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from tests.support.runtime.images import FOUR, Image, program_of_four

pytestmark = pytest.mark.system

SURE = 1
TURNS = 8
SENDERS = pytest.mark.parametrize("place", [0, 1, 2], ids=[name for name in FOUR if name != "first"])


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, Path]:
    folder = tmp_path_factory.mktemp("four")
    with ThreadPoolExecutor(2) as threads:
        return dict(zip(FOUR, threads.map(lambda name: program_of_four(folder, name), FOUR), strict=True))


@contextmanager
def chip(
    programs: Mapping[str, Path], folder: Path, place: int
) -> Iterator[tuple[Image, Image, list[Image]]]:
    """Start all images: the receiver, the sender at a place, and the others."""
    memory = folder / "memory"
    memory.write_bytes(os.urandom(4096))
    with ExitStack() as stack:
        images = [stack.enter_context(Image(programs[name], memory)) for name in FOUR]
        for image in (*images, *images):
            assert image.spin() == []
        receiver, *senders = images
        sender = senders.pop(place)
        yield receiver, sender, senders


@SENDERS
def test_messages_of_each_image_are_read_in_each_round(
    programs: Mapping[str, Path], tmp_path: Path, place: int
) -> None:
    """Two images always have messages; that of the third is among the first three."""
    with chip(programs, tmp_path, place) as (receiver, sender, others):
        assert sender.publish(SURE, "once") == ""
        printed: list[str] = []
        while len(printed) < 3:
            for other in others:
                other.publish(SURE, "often")  # refused while its ring is full
            found = receiver.call(f"take {SURE}")
            assert found[:2] == (0, "")
            printed += found[2]
        assert f"got {SURE} once" in printed


@SENDERS
def test_requests_of_each_image_have_their_turn(
    programs: Mapping[str, Path], tmp_path: Path, place: int
) -> None:
    """Two images always have requests; that of the third is among the first after the queue of two."""
    with chip(programs, tmp_path, place) as (server, client, others):
        for number in range(1, TURNS):
            assert client.ask(number, 2)[0] == ""
            served: list[str] = []
            while len(served) < 5 and f"asked {number} 2" not in served:
                for other in others:
                    other.ask(0, 0)  # refused while its ring is full
                server.spin()
                served += server.call("serve")[2]
            assert f"asked {number} 2" in served
