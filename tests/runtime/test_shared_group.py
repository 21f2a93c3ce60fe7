# SPDX-License-Identifier: Apache-2.0
"""Three images of one chip as processes: one sends to two and serves both, these send to it and exchange a topic."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from tests.support.patience import deadline
from tests.support.runtime.images import GROUP, Image, group_program

pytestmark = pytest.mark.system

BEST, SURE, SIDE = 0, 1, 2
DEPTH = 3
QUEUE = 2
"""Of the service."""
ROUNDS = 33
"""More than there are rings."""
FULL = "another image has not taken earlier messages: raise its depth or queue"
OTHER = "another image was built for other topics, types, limits or depths"
HEADER = len(GROUP) * 8
"""Bytes: two words of each image."""


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, Path]:
    folder = tmp_path_factory.mktemp("group")
    return {name: group_program(folder, name) for name in GROUP}


@pytest.fixture
def memory(tmp_path: Path) -> Path:
    """A memory with anything in it, as the RAM of a chip has at power-on."""
    path = tmp_path / "memory"
    path.write_bytes(os.urandom(4096))
    return path


@contextmanager
def chip(programs: Mapping[str, Path], memory: Path) -> Iterator[tuple[Image, Image, Image]]:
    """Start all images; each reader follows the writers of the others."""
    with ExitStack() as stack:
        images = [stack.enter_context(Image(programs[name], memory)) for name in GROUP]
        follow(*images)
        yield images[0], images[1], images[2]


def follow(*images: Image) -> None:
    for image in (*images, *images):  # a writer begins, then the readers of the others
        assert image.spin() == []


def until(image: Image, count: int, more: Callable[[], list[str]] | None = None) -> list[str]:
    """Return what an image heard once it was `count` lines."""
    lines, end = image.spin(), deadline(10)
    while len(lines) < count and time.monotonic() < end:
        lines += more() if more else []
        lines += image.spin()
    return lines


def served(image: Image, command: str) -> list[str]:
    """Return what a command prints once it succeeds: the other image's message is on its way."""
    end = deadline(10)
    while (done := image.call(command))[0] != 0 and time.monotonic() < end:
        image.spin()
    assert done[:2] == (0, ""), done
    return done[2]


def test_a_message_reaches_each_image(programs: Mapping[str, Path], memory: Path) -> None:
    """More of them than twice the slots: the counts wrap."""
    with chip(programs, memory) as (first, second, third):
        for number in range(4 * DEPTH):
            for topic in (BEST, SURE):
                assert first.publish(topic, f"n{number}", "bytes" if number % 2 else "publish") == ""
            assert second.publish(SIDE, f"s{number}") == ""
            news = [f"got {BEST} n{number}", f"got {SURE} n{number}"]
            assert sorted(until(second, 2)) == news
            assert sorted(until(third, 3)) == [*news, f"got {SIDE} s{number}"]


def test_messages_of_several_images_arrive(programs: Mapping[str, Path], memory: Path) -> None:
    """Those of each one in order, none twice."""
    with chip(programs, memory) as (first, second, third):
        for step in range(3):
            for image, name in ((second, "b"), (third, "c")):
                for number in range(DEPTH):
                    assert image.publish(SURE, f"{name}{step}{number}") == ""
            found = until(first, 2 * DEPTH)
            for name in "bc":
                assert [line for line in found if line.startswith(f"got {SURE} {name}")] == [
                    f"got {SURE} {name}{step}{number}" for number in range(DEPTH)
                ]
            assert len(found) == 2 * DEPTH


def test_an_image_that_takes_nothing_does_not_delay_the_others(
    programs: Mapping[str, Path], memory: Path
) -> None:
    """The publisher is told, or counts; the other image gets each message once."""
    with chip(programs, memory) as (first, second, third):
        before = first.counts("dropped")["dropped"]
        for number in range(DEPTH):
            assert first.publish(SURE, f"x{number}") == first.publish(BEST, f"x{number}") == ""
            assert len(until(second, 2)) == 2
        assert first.publish(SURE, "y") == f"/news/sure: {FULL}"
        assert first.publish(BEST, "y") == ""
        assert sorted(until(second, 2)) == [f"got {BEST} y", f"got {SURE} y"]
        assert first.counts("dropped")["dropped"] == before + 1
        assert sorted(until(third, 2 * DEPTH)) == sorted(
            f"got {topic} x{number}" for topic in (BEST, SURE) for number in range(DEPTH)
        )
        assert first.publish(SURE, "z") == ""
        assert (until(second, 1), until(third, 1)) == ([f"got {SURE} z"], [f"got {SURE} z"])
        assert [second.call("unsubscribe")[0], first.publish(SURE, "w")] == [0, ""]
        assert (until(third, 1), second.spin()) == ([f"got {SURE} w"], [])


@pytest.mark.parametrize("place", [1, 2])
def test_an_image_restarts(programs: Mapping[str, Path], memory: Path, place: int) -> None:
    """What it had written arrives, it gets later messages, and the third image notices nothing."""
    with chip(programs, memory) as images:
        first, restarted, stays = images[0], images[place], images[3 - place]
        assert restarted.publish(SURE, "last") == ""
        assert [first.publish(SURE, f"a{number}") for number in range(DEPTH)] == [""] * DEPTH
        assert until(stays, DEPTH) == [f"got {SURE} a{number}" for number in range(DEPTH)]
        restarted.kill()
        assert first.publish(SURE, "b") == f"/news/sure: {FULL}"
        assert until(stays, 1) == [f"got {SURE} b"]
        with Image(programs[GROUP[place]], memory) as again:
            assert again.spin() == []
            assert first.publish(SURE, "c") == ""
            assert (until(stays, 1), until(again, 1)) == ([f"got {SURE} c"], [f"got {SURE} c"])
            assert again.publish(SURE, "new") == ""
            assert stays.publish(SURE, "same") == ""
            found = until(first, 3)
            assert sorted(found) == [f"got {SURE} {text}" for text in ("last", "new", "same")]
            assert found.index(f"got {SURE} last") < found.index(f"got {SURE} new")


def test_the_sender_restarts(programs: Mapping[str, Path], memory: Path) -> None:
    """It goes on for both readers, each of which has its own place."""
    with chip(programs, memory) as (first, second, third):
        assert [first.publish(SURE, text) for text in "ab"] == ["", ""]
        assert until(second, 2) == [f"got {SURE} {text}" for text in "ab"]
        first.kill()
        with Image(programs["first"], memory) as again:
            assert again.publish(SURE, "c") == ""
            assert until(second, 1) == [f"got {SURE} c"]
            assert again.publish(SURE, "d") == f"/news/sure: {FULL}"
            assert until(second, 1) == [f"got {SURE} d"]
            assert until(third, 3) == [f"got {SURE} {text}" for text in "abc"]


def test_one_server_answers_each_client(programs: Mapping[str, Path], memory: Path) -> None:
    """Requests have the same numbers in both images: a reply goes to the image of its request."""
    with chip(programs, memory) as (first, second, third):
        assert first.call("attend")[:2] == second.call("attend")[:2] == third.call("attend")[:2] == (0, "")
        for number in range(1, 8):
            assert second.counts("available") == third.counts("available") == {"available": 1}
            assert second.ask(number, 10) == third.ask(number, 20) == ("", [f"sent {number}"])
            assert sorted(until(first, 2)) == [f"asked {number} 10", f"asked {number} 20"]
            assert until(second, 1) == [f"reply {number} {number + 10}"]
            assert until(third, 1) == [f"reply {number} {number + 20}"]


def test_a_client_that_restarts_gets_no_replies_of_the_former_one(
    programs: Mapping[str, Path], memory: Path
) -> None:
    """Nor does the other client; the reply is counted, and the requests of both go on."""
    with chip(programs, memory) as (first, second, third):
        assert second.ask(1, 1) == ("", ["sent 1"])
        assert served(first, "serve") == ["asked 1 1"]
        second.kill()
        with Image(programs["second"], memory) as again:
            follow(again, first, third)
            assert third.ask(5, 5) == again.ask(7, 7) == ("", ["sent 1"])
            before = first.counts("dropped")["dropped"]
            assert first.call("respond")[:2] == (0, "")
            assert first.counts("dropped")["dropped"] == before + 1
            for _ in range(2):
                request = served(first, "serve")
                assert first.call("respond")[:2] == (0, "")
                client, total = (third, 10) if request == ["asked 5 5"] else (again, 14)
                assert served(client, "reply") == [f"reply 1 {total}"]
            assert again.call("reply")[0] != 0
            assert third.call("reply")[0] != 0


def test_a_busy_client_does_not_starve_another(programs: Mapping[str, Path], memory: Path) -> None:
    """One client always has more requests than the queue of the server takes, which is two.

    The server takes one at a time, at each pace: whatever its rounds in between are, the other client comes next.
    """
    with chip(programs, memory) as (first, second, third):
        while second.ask(1, 1)[0] == "":
            first.spin()
        for pace in range(1, ROUNDS):
            assert third.ask(2, pace)[0] == ""
            before = 0
            while served(first, "serve") != [f"asked 2 {pace}"]:
                before += 1
                assert before <= 2 * QUEUE, f"{pace} rounds: the request of the third image is never taken"
                second.ask(1, 1)
                for _ in range(pace):
                    first.spin()
            second.ask(1, 1)
            first.spin()


def other_build(folder: Path, board: str = "third") -> Path:
    """Build an image of a system in which all depths are larger, so that all rings are elsewhere."""
    return group_program(folder, board, "depth: 3", "depth: 5")


def test_an_image_of_another_build(programs: Mapping[str, Path], memory: Path, tmp_path: Path) -> None:
    """Nobody exchanges anything, and it writes nothing where the others may still have their rings."""
    other = other_build(tmp_path)
    with chip(programs, memory) as (first, second, third):
        third.kill()
        assert [first.publish(SURE, text) for text in "ab"] == ["", ""]
        before = memory.read_bytes()
        with Image(other, memory) as wrong:
            assert wrong.spin() == [f"error /side: {OTHER}"]  # the last one of those that the executor found
            assert wrong.spin() == []
            assert wrong.publish(SURE, "c") == f"/talk/sure: {OTHER}"
            assert wrong.ask(1, 1) == (f"/sum: {OTHER}", [])
            after = memory.read_bytes()
            assert [at for at in range(4096) if before[at] != after[at] and not 16 <= at < HEADER] == []
            assert first.publish(SURE, "d") == f"/news/sure: {OTHER}"
            assert second.publish(SIDE, "d") == f"/side: {OTHER}"
        with Image(programs["third"], memory) as again:
            for image in (again, first, second, again, first, second):
                image.spin()
            assert first.publish(SURE, "e") == ""
            assert until(second, 1)[-1:] == [f"got {SURE} e"]
            assert until(again, 1)[-1:] == [f"got {SURE} e"]


def test_an_image_of_another_build_begins(programs: Mapping[str, Path], memory: Path, tmp_path: Path) -> None:
    """Its rings are in the memory when the others start."""
    other = other_build(tmp_path)
    with Image(other, memory) as wrong:
        assert wrong.spin() == []
        with Image(programs["first"], memory) as first, Image(programs["second"], memory) as second:
            assert first.publish(SURE, "a") == f"/news/sure: {OTHER}"
            assert second.publish(SURE, "a") == f"/talk/sure: {OTHER}"
            assert wrong.publish(SURE, "a") == f"/talk/sure: {OTHER}"


def test_memory_that_is_cleared_while_all_run(programs: Mapping[str, Path], memory: Path) -> None:
    with chip(programs, memory) as (first, second, third):
        assert first.publish(SURE, "lost") == ""
        with memory.open("r+b") as file:
            file.write(bytes(4096))
        follow(first, second, third)
        assert first.publish(SURE, "next") == ""
        assert (until(second, 1), until(third, 1)) == ([f"got {SURE} next"], [f"got {SURE} next"])


def test_no_message_is_torn(programs: Mapping[str, Path], memory: Path) -> None:
    """A writer that never rests, and is killed and started again, beside two readers: the ring of one is full."""
    with Image(programs["second"], memory) as second, Image(programs["third"], memory) as third:
        total = dict.fromkeys((second, third), 0)
        for start in (1, 10**9):
            with Image(programs["first"], memory) as first:
                for image in (first, second, third, first):
                    image.spin()  # the rings may have the last numbers of the former writer
                first.begin(f"flood 20000 {start}")  # killed in the middle
                for reader in (second, third):
                    counts = reader.listened(total[reader])
                    assert (counts["torn"], counts["back"]) == (0, 0)
                    assert counts["heard"] > total[reader]
                    total[reader] = counts["heard"]
