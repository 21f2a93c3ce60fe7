# SPDX-License-Identifier: Apache-2.0
"""Three images of one chip: one layout of the memory for all, and what their applications have to agree about."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.client.views.presence import manifest_entries, report_rows
from tests.support.components.chips import part, planned, refused
from tests.support.runtime.images import GROUP, GROUP_SYSTEM, MEMBERS, write_group

TEXTS = {board: member.application(board) for board, member in MEMBERS.items()}
HEADER, ENDS, HEAD, TEXT, CALL = 6, 6, 1, 12, 3
"""Words: of all images, of the ends of a ring, of a size, of a text of 40 characters, and of the identity of a call."""


def test_all_images_have_one_layout(tmp_path: Path) -> None:
    """Of each pair first the ends, then the slots, and one pair after the other."""
    parts = [part(write_group(tmp_path), board) for board in GROUP]
    found = [(r.images, r.topic, r.part, r.ends, r.at, r.words, r.slots) for r in parts[0].chip_rings]
    at = HEADER
    expected = []
    for images, names in (((0, 1), True), ((0, 2), True), ((1, 2), False)):
        rings = [("/news/best", "", HEAD + TEXT, 3), ("/news/sure", "", HEAD + TEXT, 3)]
        rings += [("/sum", "Request", HEAD + CALL + 4, 2), ("/sum", "Response", HEAD + CALL + 2, 2)]
        rings += [("/talk/best", "", HEAD + TEXT, 3), ("/talk/sure", "", HEAD + TEXT, 3)]
        rings = rings if names else [("/side", "", HEAD + TEXT, 3)]
        slots = at + ENDS * len(rings)
        for index, (topic, of, words, count) in enumerate(rings):
            expected.append((images, topic, of, at + ENDS * index, slots, words, count))
            slots += words * count
        at = slots
    assert found == expected
    assert {each.ring_words for each in parts} == {at}
    assert len({each.shared_key for each in parts}) == 1
    assert [(each.shared_image, each.chip_images, each.group) for each in parts] == [
        (index, 3, True) for index in range(3)
    ]
    for each in parts[1:]:
        assert [(r.at, r.ends, r.words) for r in each.chip_rings] == [
            (r.at, r.ends, r.words) for r in parts[0].chip_rings
        ]


def test_rings_of_an_endpoint_are_neighbors(tmp_path: Path) -> None:
    """The table in C has those of a publisher, or of a service, one after the other."""
    first = part(write_group(tmp_path), "first")
    assert [(r.ring.topic, r.other, r.ring.part, r.sends) for r in first.rings[:8]] == [
        *(("/news/best", 1, "", True), ("/news/best", 2, "", True)),
        *(("/news/sure", 1, "", True), ("/news/sure", 2, "", True)),
        *(("/sum", 1, "Request", False), ("/sum", 1, "Response", True)),
        *(("/sum", 2, "Request", False), ("/sum", 2, "Response", True)),
    ]
    assert first.ring_of[:2] == ("0", "2")
    assert "4" in first.ring_of
    sends = {r.ring.at: r.sends for board in GROUP for r in part(tmp_path, board).rings}
    assert len(sends) == len(first.chip_rings)


def test_what_a_build_says(tmp_path: Path) -> None:
    project = planned(write_group(tmp_path), "third").project
    rows = [(name, text) for name, text, _ in report_rows(project) if name == "shared"]
    bytes_ = part(tmp_path, "third").shared_bytes
    assert rows == [
        (
            "shared",
            f"{bytes_} bytes of 4096: first-second 880 at 24, first-third 880 at 904, second-third 180 at 1784",
        )
    ]
    assert manifest_entries(project)["local_delivery"]["values"]["shared_memory"] == bytes_ == 1964


def test_the_size_of_the_memory(tmp_path: Path) -> None:
    """What the hint says fits, and one byte less does not."""
    small = GROUP_SYSTEM.replace("memory: 4 KiB", "memory: 1 KiB")
    for board in GROUP:
        assert refused(write_group(tmp_path, small), board) == (
            "system.yaml:7:46: error: the rings of the chip need 1964 bytes of shared memory, which has 1024. Write "
            "`memory: 1964`, or lower depths, queues or limits of what has `local: chip`"
        )
    write_group(tmp_path, GROUP_SYSTEM.replace("4 KiB", "1964"))
    assert part(tmp_path, "first").memory_limit == 1964
    assert "which has 1963" in refused(write_group(tmp_path, GROUP_SYSTEM.replace("4 KiB", "1963")))


def test_a_list_is_a_chip_of_unknown_size(tmp_path: Path) -> None:
    listed = GROUP_SYSTEM.replace("{images: [first, second, third], memory: 4 KiB}", "[first, second, third]")
    found = part(write_group(tmp_path, listed), "first")
    assert found.shared_shown.startswith("1964 bytes: first-second")


def test_the_order_of_images_is_that_of_the_layout(tmp_path: Path) -> None:
    """Two builds that do not agree about it exchange nothing."""
    key = part(write_group(tmp_path), "first").shared_key
    other = write_group(tmp_path, GROUP_SYSTEM.replace("[first, second, third]", "[second, first, third]"))
    assert part(other, "first").shared_key != key
    assert part(other, "first").shared_image == 1


@pytest.mark.parametrize(
    ("board", "old", "new"), [("second", "/side", "/slide"), ("third", "depth: 3", "depth: 4")]
)
def test_what_two_others_exchange_is_in_the_key(tmp_path: Path, board: str, old: str, new: str) -> None:
    """An image that takes no part in a topic has its rings after those of this topic."""
    key = part(write_group(tmp_path), "first").shared_key
    texts = {name: text.replace(old, new) for name, text in TEXTS.items()}
    assert part(write_group(tmp_path, **texts), "first").shared_key != key


def test_two_others_have_other_interfaces(tmp_path: Path) -> None:
    """Hash and size are those of the files that they name; this image has no such type."""
    side = "/side, type: std_msgs/msg/String"
    folder = tmp_path / "more" / "own_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "Side.msg").write_text("string data\n")
    texts = {
        board: TEXTS[board]
        .replace("version: 1\n", "version: 1\ninterface_paths: [../more]\n")
        .replace(side, "/side, type: own_msgs/msg/Side")
        for board in ("second", "third")
    }
    keys = {part(write_group(tmp_path, **texts), board).shared_key for board in GROUP}
    assert len(keys) == 1
    (folder / "Side.msg").write_text("string data\nuint64 number\n")
    again = {part(tmp_path, board).shared_key for board in GROUP}
    assert len(again) == 1
    assert again != keys
    read = {path.resolve() for path in compiler.read_paths(planned(tmp_path, "first"))}
    assert {
        folder / "Side.msg",
        tmp_path / "second" / "microros.yaml",
        tmp_path / "third" / "microros.yaml",
    } <= read
    (folder / "Side.msg").unlink()
    assert "has no type 'Side'" in refused(tmp_path, "first")


def changed(board: str, old: str, new: str) -> dict[str, str]:
    assert old in TEXTS[board]
    return {board: TEXTS[board].replace(old, new)}


@pytest.mark.parametrize(
    ("board", "texts", "words"),
    [
        (
            "first",
            changed("second", "/news/sure", "/olds/sure"),
            [
                "second/microros.yaml:14:9: error: '/olds/sure' has no publisher in any other image of the chip. "
                "Declare its other end there"
            ],
        ),
        (
            "third",
            changed("third", "/side", "/slide"),
            [
                "second/microros.yaml:11:9: error: '/side' has no subscription in any other image of the chip",
                "third/microros.yaml:14:9: error: '/slide' has no publisher in any other image of the chip. Write "
                "`local: chip` at the other end",
            ],
        ),
        (
            "first",
            changed("third", "depth: 3}, queue", "depth: 5}, queue"),
            ["the ring of '/news/sure' has 3 slots here and 5 for the subscription of the board 'third' ("],
        ),
        (
            "first",
            changed("third", "clients:", "services:"),
            [
                "first/microros.yaml:15:9: error: a service has one server on a chip: '/sum' is served by 'first' and "
                "'third'. Rename it in one of them"
            ],
        ),
        (
            "second",
            changed("third", "clients:", "services:"),
            [
                "second/microros.yaml:16:9: error: a service has one server on a chip: '/sum' is served by 'first'"
            ],
        ),
        (
            "first",
            changed(
                "third",
                "{topic: /talk/sure, type: std_msgs/msg/String, local: chip, qos: {depth: 3}",
                "{topic: /talk/sure, type: std_msgs/msg/String, local: chip, qos: {depth: 3, reliability: best_effort}",
            ),
            ["'/talk/sure' is reliable here and never matches the publisher of the board 'third' ("],
        ),
    ],
)
def test_images_that_do_not_agree(
    tmp_path: Path, board: str, texts: dict[str, str], words: Sequence[str]
) -> None:
    shown = refused(write_group(tmp_path, **texts), board)
    for each in words:
        assert each in shown
    assert shown.count("error:") == len(words)


@pytest.mark.parametrize(
    ("chip", "words"),
    [
        (
            "{images: [first], memory: 4 KiB}",
            "system.yaml:7:14: error: a chip has 2 to 16 images; this one has 1",
        ),
        ("{images: [first, second, first]}", "the board 'first' is named twice in `chips`, first in line 7"),
        ("{memory: 4 KiB}", "missing key 'images' in 'chips[0]'"),
        (
            "{images: [first, second], memory: much}",
            "'chips[0].memory' must be a size in bytes such as 4096, 4 KiB",
        ),
        ("{images: [first, second], memory: 0}", "'chips[0].memory'"),
        (
            "first",
            "'chips[0]' must be a list of two or more boards, or {images: [first, second], memory: 4 KiB}",
        ),
        ("{images: [first, forth, third]}", "system.yaml:7:22: error: the system has no board 'forth'"),
    ],
)
def test_chips_that_cannot_be(tmp_path: Path, chip: str, words: str) -> None:
    system = GROUP_SYSTEM.replace("{images: [first, second, third], memory: 4 KiB}", chip)
    assert words in refused(write_group(tmp_path, system))


def test_the_most_rings(tmp_path: Path) -> None:
    """C counts them in a byte."""
    head, _, _ = TEXTS["second"].partition("    publishers:")
    names = [f"/topic{number}" for number in range(128)]
    ends = ("publishers", "subscriptions", "subscriptions")
    texts = {
        board: head.replace("second", board)
        + f"    {key}:\n"
        + "".join(
            f"      - {{topic: {n}, type: std_msgs/msg/UInt8, local: chip, qos: {{depth: 1}}}}\n"
            for n in names
        )
        for board, key in zip(GROUP, ends, strict=True)
    }
    folder = write_group(tmp_path, GROUP_SYSTEM.replace("4 KiB", "64 KiB"), **texts)
    assert refused(folder).startswith(
        "first/microros.yaml:108:9: error: the image has 256 rings in the shared memory, and 255 is the most"
    )
    assert len(part(folder, "second").rings) == 128
