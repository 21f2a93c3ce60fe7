# SPDX-License-Identifier: Apache-2.0
"""Two images of one chip as processes: what arrives over the memory that both have, whichever of them restarts."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.support.patience import deadline
from tests.support.runtime.images import TOPICS, Image, program

BEST, SURE = 0, 1
DEPTH = 3


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("images")
    return program(folder, "first"), program(folder, "second")


@pytest.fixture
def memory(tmp_path: Path) -> Path:
    """A memory with anything in it, as the RAM of a chip has at power-on."""
    path = tmp_path / "memory"
    path.write_bytes(os.urandom(4096))
    return path


@contextmanager
def both(programs: tuple[Path, Path], memory: Path) -> Iterator[tuple[Image, Image]]:
    """Start both images; each reader follows the writer of the other image."""
    with Image(programs[0], memory) as first, Image(programs[1], memory) as second:
        follow(first, second)
        yield first, second


def follow(first: Image, second: Image) -> None:
    for image in (first, second, first, second):  # a writer begins, then the reader of the other image
        assert image.spin() == []


def heard(image: Image, count: int) -> list[str]:
    """Return what an image heard once it was `count` lines."""
    lines, end = image.spin(), deadline(10)
    while len(lines) < count and time.monotonic() < end:
        lines += image.spin()
    return lines


def test_messages_arrive_in_both_directions(programs: tuple[Path, Path], memory: Path) -> None:
    """More of them than twice the slots: the counts wrap."""
    with both(programs, memory) as (first, second):
        for number in range(4 * DEPTH):
            for topic in (BEST, SURE):
                assert first.publish(topic, f"to{number}") == ""
                assert second.publish(topic, f"fro{number}") == ""
            assert sorted(heard(second, 2)) == [f"got {BEST} to{number}", f"got {SURE} to{number}"]
            assert sorted(heard(first, 2)) == [f"got {BEST} fro{number}", f"got {SURE} fro{number}"]


def test_bytes_are_the_same(programs: tuple[Path, Path], memory: Path) -> None:
    with both(programs, memory) as (first, second):
        assert first.publish(SURE, "bytes", "bytes") == ""
        assert heard(second, 1) == [f"got {SURE} bytes"]
        assert first.publish(SURE, "taken") == ""
        assert second.call(f"take {SURE}") == (0, "", [f"got {SURE} taken"])
        assert "the encoded message is larger than a slot" in first.publish(SURE, "x" * 43, "bytes")
        assert "data" in first.publish(SURE, "x" * 43)
        assert second.spin() == []


def test_an_absent_reader_is_no_error(programs: tuple[Path, Path], memory: Path) -> None:
    with Image(programs[0], memory) as first:
        for number in range(2 * DEPTH):
            assert first.publish(SURE, str(number)) == ""
        with Image(programs[1], memory) as second:
            follow(first, second)
            assert first.publish(SURE, "now") == ""
            assert heard(second, 1) == [f"got {SURE} now"]


def test_a_slow_reader(programs: tuple[Path, Path], memory: Path) -> None:
    """A full ring: a reliable publisher is told, another drops and counts. What it took arrives in order."""
    with both(programs, memory) as (first, second):
        before = first.counts("dropped")["dropped"]
        shown = [first.publish(SURE, str(number)) for number in range(DEPTH + 1)]
        assert shown[:DEPTH] == [""] * DEPTH
        assert shown[DEPTH].startswith("/first/sure: another image has not taken earlier messages")
        assert [first.publish(BEST, str(number)) for number in range(DEPTH + 2)] == [""] * (DEPTH + 2)
        assert first.counts("dropped")["dropped"] == before + 2
        found = heard(second, 2 * DEPTH)
        for topic in (BEST, SURE):
            assert [line for line in found if line.split()[1] == str(topic)] == [
                f"got {topic} {number}" for number in range(DEPTH)
            ]
        assert first.publish(SURE, "again") == ""
        assert heard(second, 1) == [f"got {SURE} again"]


def test_a_writer_that_restarts_goes_on(programs: tuple[Path, Path], memory: Path) -> None:
    with both(programs, memory) as (first, second):
        assert [first.publish(SURE, text) for text in ("a", "b")] == ["", ""]
        first.kill()
        with Image(programs[0], memory) as again:
            assert again.publish(SURE, "c") == ""
            assert "has not taken" in again.publish(SURE, "d")
            assert heard(second, 3) == [f"got {SURE} {text}" for text in "abc"]
            assert again.publish(SURE, "e") == ""
            assert heard(second, 1) == [f"got {SURE} e"]


def test_a_reader_that_restarts_gets_later_messages(programs: tuple[Path, Path], memory: Path) -> None:
    with both(programs, memory) as (first, second):
        assert [first.publish(SURE, text) for text in "abc"] == ["", "", ""]
        second.kill()
        assert "has not taken" in first.publish(SURE, "d")
        with Image(programs[1], memory) as again:
            assert again.spin() == []
            assert [first.publish(SURE, text) for text in "efg"] == ["", "", ""]
            assert heard(again, 3) == [f"got {SURE} {text}" for text in "efg"]


def test_an_image_that_closes_hears_nothing(programs: tuple[Path, Path], memory: Path) -> None:
    """A reliable publisher has no subscription then, and earlier messages are not for the next context."""
    with both(programs, memory) as (first, second):
        assert [first.publish(SURE, text) for text in "abc"] == ["", "", ""]
        assert second.publish(SURE, "last") == ""
        assert second.call("close")[:2] == (0, "")
        assert [first.publish(SURE, text) for text in "defgh"] == [""] * 5
        assert heard(first, 1) == [f"got {SURE} last"]
        assert second.call("open")[:2] == (0, "")
        follow(first, second)
        assert [first.publish(SURE, text) for text in "ij"] == ["", ""]
        assert heard(second, 2) == [f"got {SURE} i", f"got {SURE} j"]


def test_a_subscription_that_closes_hears_nothing(programs: tuple[Path, Path], memory: Path) -> None:
    with both(programs, memory) as (first, second):
        assert second.call("unsubscribe")[:2] == (0, "")
        assert [first.publish(SURE, text) for text in "abcde"] == [""] * 5
        assert second.publish(SURE, "more") == ""
        assert heard(first, 1) == [f"got {SURE} more"]


def served(image: Image, command: str) -> list[str]:
    """Return what a command prints once it succeeds: the other image's message is on its way."""
    end = deadline(10)
    while (done := image.call(command))[0] != 0 and time.monotonic() < end:
        image.spin()
    assert done[:2] == (0, ""), done
    return done[2]


def test_services_in_both_directions(programs: tuple[Path, Path], memory: Path) -> None:
    """Each image has a server and a client; more requests than twice the slots: the counts wrap."""
    with both(programs, memory) as (first, second):
        for image in (first, second):
            assert image.counts("available") == {"available": 1}
            assert image.call("attend")[:2] == (0, "")
        for number in range(1, 10):
            assert first.ask(number, 10) == ("", [f"sent {number}"])
            assert second.ask(number, 20) == ("", [f"sent {number}"])
            assert heard(second, 1) == [f"asked {number} 10"]
            assert heard(first, 2) == [f"asked {number} 20", f"reply {number} {number + 10}"]
            assert heard(second, 1) == [f"reply {number} {number + 20}"]


def test_requests_that_wait(programs: tuple[Path, Path], memory: Path) -> None:
    """Two in the queue of the server, two in the ring; what it has taken arrives in order, and replies likewise."""
    with both(programs, memory) as (first, second):
        assert [first.ask(number, 0)[0] for number in (1, 2)] == ["", ""]
        second.spin()
        assert [first.ask(number, 0)[0] for number in (3, 4)] == ["", ""]
        full = "/second/sum: another image has not taken earlier messages: raise its depth or queue"
        assert first.ask(5, 0) == (full, [])
        for number in range(1, 5):
            assert served(second, "serve") == [f"asked {number} 0"]
            assert second.call("respond")[1] == (full if number == 3 else "")
            second.spin()
            if number == 3:
                first.spin()  # takes the first two, which the client does not wait for any more
                assert second.call("respond")[1] == ""
        assert [line for _ in range(2) for line in served(first, "reply")] == ["reply 3 3", "reply 4 4"]
        assert first.ask(6, 0) == ("", ["sent 5"])
        assert served(second, "serve") == ["asked 6 0"]


def test_a_client_that_restarts_gets_no_replies_of_the_former_one(
    programs: tuple[Path, Path], memory: Path
) -> None:
    """The first request of the new one has the same number as that of the former one."""
    with both(programs, memory) as (first, second):
        assert first.ask(1, 1) == ("", ["sent 1"])
        assert served(second, "serve") == ["asked 1 1"]
        first.kill()
        with Image(programs[0], memory) as again:
            follow(again, second)
            assert again.ask(20, 20) == ("", ["sent 1"])
            assert second.call("respond")[:2] == (0, "")
            assert served(second, "serve") == ["asked 20 20"]
            assert second.call("respond")[:2] == (0, "")
            assert served(again, "reply") == ["reply 1 40"]
            assert again.call("reply")[0] != 0
        assert second.counts("available") == {"available": 1}  # killed: nobody closed it


def test_a_server_that_restarts(programs: tuple[Path, Path], memory: Path) -> None:
    """Its replies from before arrive; requests that it had not taken are lost, as with the agent."""
    with both(programs, memory) as (first, second):
        assert first.ask(1, 1) == ("", ["sent 1"])
        assert served(second, "serve") == ["asked 1 1"]
        assert second.call("respond")[:2] == (0, "")
        assert first.ask(2, 2) == ("", ["sent 2"])
        second.kill()
        with Image(programs[1], memory) as again:
            follow(first, again)
            assert served(first, "reply") == ["reply 1 2"]
            assert first.ask(3, 3) == ("", ["sent 3"])
            assert served(again, "serve") == ["asked 3 3"]
            assert again.call("respond")[:2] == (0, "")
            assert served(first, "reply") == ["reply 3 6"]
            assert again.call("close")[:2] == (0, "")
            assert first.counts("available") == {"available": 0}
            before = first.counts("dropped")["dropped"]
            assert [first.ask(number, 0)[0] for number in range(4)] == [""] * 4  # as without a server
            assert first.counts("dropped")["dropped"] == before + 4


def test_memory_that_is_cleared_while_both_run(programs: tuple[Path, Path], memory: Path) -> None:
    """One core may clear it when the other one has begun: both ends become valid again."""
    with both(programs, memory) as (first, second):
        assert first.publish(SURE, "lost") == ""
        memory.write_bytes(memory.read_bytes())  # of the same size: the mapping stays
        with memory.open("r+b") as file:
            file.write(bytes(4096))
        follow(first, second)
        assert first.publish(SURE, "next") == ""
        assert heard(second, 1) == [f"got {SURE} next"]


def test_no_message_is_torn(programs: tuple[Path, Path], memory: Path) -> None:
    """A writer that never rests, and is killed and started again, beside a reader that never rests."""
    with Image(programs[1], memory) as second:
        total = 0
        for start in (1, 10**9, 2 * 10**9):
            with Image(programs[0], memory) as first:
                for image in (first, second, first):
                    image.spin()  # the ring may have the last numbers of the former writer
                first.begin(f"flood 20000 {start}")  # killed in the middle
                counts = second.listened(total)
            assert (counts["torn"], counts["back"]) == (0, 0)
            assert counts["heard"] > total
            total = counts["heard"]


def refused(image: Image, other: str, words: str) -> None:
    """Each subscription says once that nothing can arrive, to whoever looks for messages."""
    assert image.call(f"take {BEST}")[:2] == (1, f"/{other}/best: {words}")
    own = "first" if other == "second" else "second"
    assert image.call("serve")[:2] == (1, f"/{own}/sum: {words}")
    assert image.ask(1, 1) == (f"/{other}/sum: {words}", [])
    assert image.spin() == [f"error /{other}/sure: {words}"]
    assert image.spin() == []


def test_an_image_of_another_build(programs: tuple[Path, Path], memory: Path, tmp_path: Path) -> None:
    """Its depth differs: the calls of both images say so."""
    other = program(tmp_path, "second", TOPICS.replace("depth: 3", "depth: 4"))
    words = "another image was built for other topics, types, limits or depths"
    with both(programs, memory) as (first, second):
        assert [first.publish(SURE, text) for text in "xy"] == ["", ""]
        second.kill()
        with Image(other, memory) as second:
            assert second.publish(SURE, "a") == f"/second/sure: {words}"
            refused(second, "first", words)
            assert first.publish(SURE, "a") == f"/first/sure: {words}"
            refused(first, "second", words)
        with Image(
            programs[1], memory
        ) as second:  # of the same build again: what the other one wrote over is lost
            follow(first, second)
            assert first.publish(SURE, "b") == ""
            assert heard(second, 1) == [f"got {SURE} b"]


def test_a_platform_without_such_memory(programs: tuple[Path, Path], tmp_path: Path) -> None:
    """It is asked once in a context, and again in the next one."""
    memory = tmp_path / "memory"
    memory.mkdir()  # a folder cannot be mapped
    with Image(programs[0], memory) as first:
        words = "the platform has no memory that images share"
        assert first.publish(BEST, "a") == f"/first/best: {words}"
        refused(first, "second", words)
        memory.rmdir()
        assert first.spin() == []
        assert (first.publish(BEST, "a"), memory.exists()) == (f"/first/best: {words}", False)
        assert first.call("close")[:2] == (0, "")
        assert first.call("open")[:2] == (0, "")
        assert first.publish(BEST, "a") == ""
