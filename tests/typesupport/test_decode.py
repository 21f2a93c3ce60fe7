# SPDX-License-Identifier: Apache-2.0
"""Decoders against Fast CDR through rclpy, for every message type of the wheels, whatever the bytes."""

from __future__ import annotations

import ctypes
import importlib
import mmap
import os
import random
from collections.abc import Iterator
from typing import Any

import pytest

from microros_gen.interfaces.types import NamedType, TypeName, element_of
from microros_gen.typesupport.plan.types import TypePlan
from tests.support.examples import examples
from tests.support.typesupport import cdr
from tests.support.typesupport.build import Generated
from tests.support.typesupport.decoder import BOUND, CAPACITY, END, VALUE, Decoder, Refused
from tests.support.typesupport.encoder import names_member, with_python
from tests.support.typesupport.values import Randomizer, from_ros, ros_class, to_ros

pytestmark = [pytest.mark.ros, pytest.mark.builds]

rclpy_serialization = pytest.importorskip("rclpy.serialization")
RMWError = importlib.import_module("rclpy.impl.implementation_singleton").rclpy_implementation.RMWError

LITTLE = b"\0\1\0\0"
SAMPLES = ("empty", "full", *("random",) * 4)
LONG_SAMPLES = ("empty", "full", *("random",) * 200)
SHORT_BODY = 48


def check_samples(generated: Generated, library: ctypes.CDLL, samples: tuple[str, ...]) -> int:
    """Decode what rclpy wrote, and the same in the other byte order; return how many messages."""
    compared = 0
    for seed, plan in enumerate(with_python(generated)):
        source = Randomizer(generated.messages, 7000 + seed)
        decoder = Decoder(library, generated, plan)
        for mode in samples:
            tree = source.tree(plan.name, plan.limits, mode)
            message = to_ros(generated.messages, plan.name, tree)
            little = rclpy_serialization.serialize_message(message)[4:]
            assert decoder.decode(little) == tree, (plan.name, mode)
            big = cdr.encode(generated.messages, plan.name, tree, True)
            assert decoder.decode(big, swap=True) == tree, (plan.name, mode)
            compared += 1
    return compared


@pytest.mark.examples
def test_what_ros_writes_is_read(limits_case: Generated, library: ctypes.CDLL) -> None:
    samples = SAMPLES[: examples(len(SAMPLES), least=3)]
    assert check_samples(limits_case, library, samples) > 150 * len(samples)


@pytest.mark.long
def test_what_ros_writes_is_read_200_times(limits_case: Generated, library: ctypes.CDLL) -> None:
    assert check_samples(limits_case, library, LONG_SAMPLES) > 150 * len(LONG_SAMPLES)


def test_the_big_endian_oracle_is_read_by_ros(limits_case: Generated) -> None:
    """What the tests' own encoder writes means the same to Fast CDR, in both byte orders."""
    for seed, plan in enumerate(with_python(limits_case)):
        tree = Randomizer(limits_case.messages, seed).tree(plan.name, plan.limits, "random")
        for big in (False, True):
            body = cdr.encode(limits_case.messages, plan.name, tree, big)
            header = b"\0\0\0\0" if big else LITTLE
            message = rclpy_serialization.deserialize_message(header + body, ros_class(plan.name))
            assert from_ros(limits_case.messages, plan.name, message) == tree, (plan.name, big)


def ros_reads(generated: Generated, name: TypeName, body: bytes) -> dict[str, Any] | str:
    """Return the contents that rclpy reads, or `refused`, or `no text` where Python cannot show it."""
    try:
        message = rclpy_serialization.deserialize_message(LITTLE + body, ros_class(name))
    except TypeError:
        return "no text"  # a lone surrogate in a wide string
    except RMWError:
        return "refused"
    return from_ros(generated.messages, name, message)


def strictly(generated: Generated, name: TypeName, body: bytes, big: bool) -> dict[str, Any] | str:
    """Return the contents that the tests' own decoder reads, or `refused`."""
    try:
        return cdr.decode(generated.messages, name, body, big)
    except cdr.RefusedError:
        return "refused"


def compare(generated: Generated, decoder: Decoder, body: bytes) -> str:
    """Decode as the tests' own decoder does in both byte orders, and as rclpy; but for capacities.

    Fast CDR through C has a flaw that rclpy shows: a sequence that is longer than the bytes that are left, in a
    nested message, ends that message only; what was read so far comes as success. Here it is refused.
    """
    name = decoder.plan.name
    outcome = ""
    for big in (True, False):
        ours, expected = decoder.decode(body, swap=big), strictly(generated, name, body, big)
        if isinstance(ours, Refused):
            assert ours.path
            assert ours.found > ours.fits, (name, ours)
            full = ours.kind in (BOUND, CAPACITY)
            assert full or expected == "refused", (name, body.hex(), ours)
            outcome = "above a capacity" if full else "refused"
        else:
            assert not isinstance(expected, str), (name, body.hex(), ours)
            same = cdr.encode(generated.messages, name, ours, False)
            assert same == cdr.encode(generated.messages, name, expected, False), (name, body.hex())
            theirs = ros_reads(generated, name, body) if not big else "no text"
            assert theirs != "refused", (name, body.hex(), ours)
            if not isinstance(theirs, str):
                assert same == cdr.encode(generated.messages, name, theirs, False), (name, body.hex())
            outcome = "read"
    if outcome == "refused" and not isinstance(ros_reads(generated, name, body), str):
        assert any(isinstance(element_of(f.type), NamedType) for f in generated.messages[name].fields), name
        return "read in part by ROS"
    return outcome


def bodies(generated: Generated, seed: int) -> Iterator[tuple[TypePlan, bytes]]:
    """Yield a valid body of each type."""
    for index, plan in enumerate(with_python(generated)):
        tree = Randomizer(generated.messages, seed + index).tree(plan.name, plan.limits, "random")
        yield plan, cdr.encode(generated.messages, plan.name, tree, False)


def check_prefixes(generated: Generated, library: ctypes.CDLL, most: int) -> None:
    """Compare at most `most` prefixes of a body of each type, each one of a short body."""
    chance = random.Random(3)
    refused = 0
    for plan, body in bodies(generated, 9000):
        decoder = Decoder(library, generated, plan)
        lengths = range(len(body))
        for length in lengths if len(body) <= most else sorted(chance.sample(lengths, most)):
            outcome = compare(generated, decoder, body[:length])
            assert outcome in ("refused", "read in part by ROS"), (plan.name, length, len(body), outcome)
            refused += outcome == "refused"
    assert refused > 1000


@pytest.mark.examples
def test_a_body_that_ends_early_is_refused(limits_case: Generated, library: ctypes.CDLL) -> None:
    check_prefixes(limits_case, library, examples(SHORT_BODY, least=12))


@pytest.mark.long
def test_every_prefix_is_refused(limits_case: Generated, library: ctypes.CDLL) -> None:
    check_prefixes(limits_case, library, 100_000)


def check_mutations(generated: Generated, library: ctypes.CDLL, rounds: int, seed: int) -> dict[str, int]:
    """Compare bodies with some bytes changed; return how often each outcome was seen."""
    chance = random.Random(seed)
    seen: dict[str, int] = {}
    for plan, body in bodies(generated, seed):
        decoder = Decoder(library, generated, plan)
        for _ in range(rounds):
            changed = bytearray(body)
            for _ in range(chance.randint(1, 3)):
                value = chance.choice([0, 1, 2, 0x41, 0x7F, 0x80, 0xFF, chance.randrange(256)])
                changed[chance.randrange(len(changed))] = value
            outcome = compare(generated, decoder, bytes(changed))
            seen[outcome] = seen.get(outcome, 0) + 1
    return seen


@pytest.mark.examples
def test_changed_bytes_are_read_as_ros_reads_them(limits_case: Generated, library: ctypes.CDLL) -> None:
    rounds = examples(12, least=4)
    seen = check_mutations(limits_case, library, rounds, 11)
    assert {"read", "refused", "above a capacity"} <= set(seen)
    assert min(seen[outcome] for outcome in ("read", "refused", "above a capacity")) > rounds * 5 / 6, seen


@pytest.mark.long
def test_many_changed_bytes_are_read_as_ros_reads_them(limits_case: Generated, library: ctypes.CDLL) -> None:
    for seed in range(20):
        check_mutations(limits_case, library, 50, 100 + seed)


def test_what_does_not_fit_is_refused_with_its_field(limits_case: Generated, library: ctypes.CDLL) -> None:
    """Each string and sequence of a full message with one place less: name, what it has, what fits."""
    checked = 0
    for seed, plan in enumerate(limits_case.plans):
        tree = Randomizer(limits_case.messages, seed).tree(plan.name, plan.limits, "full")
        body = cdr.encode(limits_case.messages, plan.name, tree, False)
        decoder = Decoder(library, limits_case, plan)
        assert decoder.decode(body) == tree, plan.name
        seen = set()
        for path, member, is_string in decoder.structs.strings(plan.name, decoder.message):
            if path in seen or not member.size:
                continue
            seen.add(path)
            size, capacity = member.size, member.capacity
            member.capacity = capacity - 1
            refused = decoder.into(decoder.message, body)
            assert refused, (plan.name, path)
            assert names_member(refused.path, path), (plan.name, path, refused)
            assert (refused.found, refused.fits, refused.kind) == (size, size - 1, CAPACITY), (
                path,
                is_string,
            )
            member.capacity, member.size = capacity, size
            assert decoder.into(decoder.message, body) is None, (plan.name, path)
            checked += 1
    assert checked > 500


def one(limits_case: Generated, library: ctypes.CDLL, name: str) -> Decoder:
    return Decoder(library, limits_case, limits_case.plan(name))


@pytest.mark.parametrize(
    ("body", "text"),
    [
        (b"\0\0\0\0", ""),
        (b"\1\0\0\0\0", ""),
        (b"\1\0\0\0A", "A"),
        (b"\3\0\0\0ABC", "ABC"),
        (b"\4\0\0\0AB\0\0", "AB"),
        (b"\4\0\0\0A\0B\0", "A"),
        (b"\3\0\0\0AB\0behind", "AB"),
        (b"\3\0\0\0\xff\xfe\0", "\N{REPLACEMENT CHARACTER}" * 2),
    ],
)
def test_ends_of_strings(
    everything: Generated, functions_library: ctypes.CDLL, body: bytes, text: str
) -> None:
    """A string ends at its first NUL; Fast CDR through C says the same."""
    decoder = one(everything, functions_library, "std_msgs/msg/String")
    assert decoder.decode(body) == {"data": text}
    assert ros_reads(everything, decoder.plan.name, body) == {"data": text}
    data = decoder.message.data
    assert ctypes.string_at(data.data + data.size, 1) == b"\0"


@pytest.mark.parametrize("byte", [0, 1, 2, 255])
def test_any_byte_but_0_is_true(everything: Generated, functions_library: ctypes.CDLL, byte: int) -> None:
    decoder = one(everything, functions_library, "std_msgs/msg/Bool")
    assert decoder.decode(bytes([byte])) == {"data": byte != 0}
    assert ctypes.string_at(ctypes.addressof(decoder.message), 1) == bytes([byte != 0])
    assert ros_reads(everything, decoder.plan.name, bytes([byte])) == {"data": byte != 0}


def test_a_wide_character_above_16_bits_is_refused(
    everything: Generated, functions_library: ctypes.CDLL
) -> None:
    decoder = one(everything, functions_library, "test_msgs/msg/WStrings")
    body = b"\2\0\0\0" + b"A\0\0\0" + b"\0\0\1\0" + bytes(200)
    assert decoder.decode(body) == Refused("wstring_value", 0x10000, 0xFFFF, VALUE)
    assert ros_reads(everything, decoder.plan.name, body) == "refused"


def test_bounds_of_the_interface_hold_for_larger_capacities(
    everything: Generated, functions_library: ctypes.CDLL
) -> None:
    """The application may give more room than the bound; the message is not a valid one all the same."""
    decoder = one(everything, functions_library, "test_msgs/msg/BoundedSequences")
    message = decoder.bind()
    room = (ctypes.c_bool * 8)()
    message.bool_values.data, message.bool_values.capacity = ctypes.addressof(room), 8
    refused = decoder.into(message, b"\4\0\0\0\1\1\1\1" + bytes(2000))
    assert refused == Refused("bool_values", 4, 3, BOUND)


def test_a_message_without_storage_takes_what_is_empty(
    everything: Generated, functions_library: ctypes.CDLL
) -> None:
    decoder = one(everything, functions_library, "sensor_msgs/msg/JointState")
    decoder.bind()
    empty = decoder.structs.structure(decoder.plan.name)()
    assert decoder.into(empty, bytes(8) + b"\1\0\0\0" + bytes(20)) is None
    assert decoder.into(empty, bytes(8) + b"\2\0\0\0a\0" + bytes(22)) == Refused(
        "header.frame_id", 1, 0, CAPACITY
    )
    assert decoder.into(empty, bytes(8) + b"\1\0\0\0" + bytes(4) + b"\1\0\0\0" + bytes(96)) == Refused(
        "name", 1, 0, CAPACITY
    )


@pytest.mark.parametrize("wide", [False, True])
def test_the_nul_that_empty_strings_share_is_not_written_to(
    everything: Generated, functions_library: ctypes.CDLL, wide: bool
) -> None:
    """Threads share it. Here it is on a page that nobody can write to; a child process reads into it."""
    decoder = one(everything, functions_library, "test_msgs/msg/WStrings" if wide else "std_msgs/msg/String")
    message = decoder.bind()
    map_page = ctypes.CDLL(None).mmap
    map_page.restype = ctypes.c_void_p
    page = map_page(None, ctypes.c_size_t(4096), mmap.PROT_READ, mmap.MAP_PRIVATE | mmap.MAP_ANON, -1, 0)
    text = message.wstring_value if wide else message.data
    text.data, text.size, text.capacity = page, 0, 1
    child = os.fork()
    if child == 0:
        decoder.into(message, bytes(1000))
        os._exit(0)
    assert os.waitpid(child, 0)[1] == 0
    owned = ctypes.create_string_buffer(b"xx")
    text.data = ctypes.addressof(owned)
    decoder.into(message, bytes(1000))
    assert owned.raw[0] == 0, "an empty string of one's own gets its NUL"


@pytest.mark.parametrize("length", [2**16, 2**29, 2**30 + 1, 2**31, 2**32 - 1])
def test_forged_lengths_end_at_once(
    everything: Generated, functions_library: ctypes.CDLL, length: int
) -> None:
    """A length that the bytes cannot hold is refused before anything is done with it."""
    forged = length.to_bytes(4, "little")
    joints = one(everything, functions_library, "sensor_msgs/msg/JointState")
    head = bytes(8) + b"\1\0\0\0" + bytes(4)
    refused = joints.decode(head + forged + bytes(64))
    assert refused == Refused("name", length, 64, END)
    refused = joints.decode(head + bytes(4) + forged + bytes(64))
    assert refused == Refused("position", min(length * 8, 2**32 - 1), 64, END)
    text = one(everything, functions_library, "std_msgs/msg/String")
    assert text.decode(forged + bytes(8)) == Refused("data", length, 8, END)
    assert text.decode(b"") == Refused("data", 4, 0, END)


def test_the_callers_buffer_may_lie_anywhere(everything: Generated, functions_library: ctypes.CDLL) -> None:
    """Alignment counts from the first byte of the body, not from its address."""
    plan = everything.plan("sensor_msgs/msg/Imu")
    tree = Randomizer(everything.messages, 1).tree(plan.name, plan.limits, "random")
    body = cdr.encode(everything.messages, plan.name, tree, False)
    decoder = Decoder(functions_library, everything, plan)
    for shift in range(8):
        room = ctypes.create_string_buffer(bytes(shift) + body)
        message = decoder.bind()
        assert decoder.at(message, ctypes.addressof(room) + shift, len(body)) is None
        assert decoder.structs.read(plan.name, message) == tree
