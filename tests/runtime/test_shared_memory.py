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
        assert shown[DEPTH].startswith("/first/sure: the other image has not taken earlier messages")
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
                second.begin("listen 150")
                first.begin(f"flood 1000 {start}")  # killed in the middle
                _, _, lines = second.result()
            counts = {name: int(count) for name, count in map(str.split, lines)}
            assert (counts["torn"], counts["back"]) == (0, 0)
            assert counts["heard"] > total
            total = counts["heard"]


def refused(image: Image, other: str, words: str) -> None:
    """Each subscription says once that nothing can arrive, to whoever looks for messages."""
    assert image.call(f"take {BEST}")[:2] == (1, f"/{other}/best: {words}")
    assert image.spin() == [f"error /{other}/sure: {words}"]
    assert image.spin() == []


def test_an_image_of_another_build(programs: tuple[Path, Path], memory: Path, tmp_path: Path) -> None:
    """Its depth differs: the calls of both images say so."""
    other = program(tmp_path, "second", TOPICS.replace("depth: 3", "depth: 4"))
    words = "the other image was built for other topics, types, limits or depths"
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
    with Image(programs[0], tmp_path) as first:  # a folder cannot be mapped
        words = "the platform has no memory that two images share"
        assert first.publish(BEST, "a") == f"/first/best: {words}"
        refused(first, "second", words)
