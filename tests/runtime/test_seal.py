# SPDX-License-Identifier: Apache-2.0
"""Sealed messages: the device over Mbed TLS, the agent, and an independent implementation of Noise."""

from __future__ import annotations

import re
import shutil
import struct
import subprocess
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest
from cryptography.hazmat.primitives.asymmetric.x25519 import X25519PrivateKey
from noise.connection import NoiseConnection

from microros_gen.agent.seal.handshakes import HANDSHAKES_PER_SECOND, UNCONFIRMED, Handshakes
from microros_gen.agent.seal.layout import FIRST, LABEL, RECORD, REFUSAL, Kind, Reason
from microros_gen.agent.seal.noise import NAME, HandshakeError, _State, respond
from microros_gen.agent.seal.session import LAST_RECORD, WINDOW, RecordError
from tests.support.paths import ROOT
from tests.support.runtime.sealed import CLIENT_KEY, Device, build_device

pytestmark = pytest.mark.builds
PSK = bytes(range(1, 33))
PEER = ("agent", ("192.0.2.1", 4000))
LARGEST_OF_PLAN = 74
"""The larger one of MTU and input buffer in the application of `tests/support/runtime/sealed.py`."""
NO_KEY, SILENT, REFUSED, FORGED = 1, 3, 4, 5
"""Values of xrce_seal_fault_t."""


@pytest.fixture(
    scope="module",
    params=[
        "udp",
        pytest.param("tcp", marks=pytest.mark.variant),
        pytest.param("serial", marks=pytest.mark.variant),
    ],
)
def transport(request: pytest.FixtureRequest) -> str:
    found: str = request.param
    return found


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory, transport: str) -> Path:
    return build_device(tmp_path_factory.mktemp(f"seal_{transport}"), transport)


@pytest.fixture
def device(library: Path, transport: str) -> Iterator[Device]:
    found = Device(library, PSK, transport)
    yield found
    assert found.faults == []


def independent(initiator: bool, prologue: bytes) -> NoiseConnection:
    """Return one side of a session of the package noiseprotocol."""
    found = NoiseConnection.from_name(NAME)
    found.set_psks(PSK)
    found.set_prologue(prologue)
    (found.set_as_initiator if initiator else found.set_as_responder)()
    found.start_handshake()
    return found


def first_of(device: Device) -> bytes:
    """Let a device open its transport and send; return the first message of its handshake."""
    assert device.open()
    assert device.send(b"waiting")
    (first,) = device.sent()
    return first


def connect(device: Device, agent: Handshakes) -> None:
    """Bring a device into a session with an agent."""
    answer, fault = agent.answer(first_of(device), PEER, 0.0)
    assert (fault, device.arrives(answer), device.is_ready) == ("", 0, 1)
    (waiting,) = device.sent()
    assert agent.open(waiting, PEER)[0] == b"waiting"


def connected(device: Device) -> Handshakes:
    """Return an agent that a device has a session with."""
    agent = Handshakes({CLIENT_KEY: PSK})
    connect(device, agent)
    return agent


def from_agent(agent: Handshakes, message: bytes) -> bytes:
    record = agent.seal(message, CLIENT_KEY, PEER)
    assert record is not None
    return record


def from_device(device: Device, message: bytes) -> bytes:
    assert device.send(message)
    (record,) = device.sent()
    return record


def test_device_agrees_with_an_independent_responder(device: Device) -> None:
    first = first_of(device)
    other = independent(False, LABEL + first[: FIRST.size])
    assert other.read_message(first[FIRST.size :]) == b""
    head = FIRST.pack(Kind.SECOND, 1, 0, 77, FIRST.unpack_from(first)[3])
    assert device.arrives(head + bytes(other.write_message())) == 0
    (waiting,) = device.sent()
    assert RECORD.unpack_from(waiting) == (Kind.RECORD, 1, 0, 77, 0)
    assert other.decrypt(waiting[RECORD.size :]) == b"waiting"
    index = FIRST.unpack_from(first)[3]
    for counter in range(3):
        record = from_device(device, b"up" * counter + b"!")
        assert other.decrypt(record[RECORD.size :]) == b"up" * counter + b"!"
        sealed = bytes(other.encrypt(b"down%d" % counter))
        assert device.arrives(RECORD.pack(Kind.RECORD, 1, 0, index, counter) + sealed) == b"down%d" % counter


def test_agent_agrees_with_an_independent_initiator() -> None:
    agent = Handshakes({CLIENT_KEY: PSK})
    head = FIRST.pack(Kind.FIRST, 1, 0, 5, CLIENT_KEY)
    other = independent(True, LABEL + head)
    second, fault = agent.answer(head + bytes(other.write_message()), PEER, 0.0)
    kind, _, _, index, own = FIRST.unpack_from(second)
    assert (kind, own, fault) == (Kind.SECOND, 5, "")
    assert other.read_message(second[FIRST.size :]) == b""
    for counter in range(3):
        record = RECORD.pack(Kind.RECORD, 1, 0, index, counter) + bytes(other.encrypt(b"up%d" % counter))
        assert agent.open(record, PEER)[0] == b"up%d" % counter
        assert other.decrypt(from_agent(agent, b"down")[RECORD.size :]) == b"down"


def test_messages_pass_in_both_directions(device: Device) -> None:
    agent = connected(device)
    for size in (1, 15, 16, 17, 64):
        message = bytes(range(size))
        assert agent.open(from_device(device, message), PEER)[0] == message
        assert device.arrives(from_agent(agent, message)) == message
    assert not device.send(bytes(LARGEST_OF_PLAN + 1))


def test_no_bit_of_a_datagram_can_change(device: Device) -> None:
    agent = connected(device)
    up, down = from_device(device, b"message"), from_agent(agent, b"message")
    for bit in range(8 * len(up)):
        changed = bytearray(up)
        changed[bit // 8] ^= 1 << bit % 8
        if changed[0] == Kind.RECORD:
            with pytest.raises(RecordError):
                agent.open(bytes(changed), PEER)
        changed = bytearray(down)
        changed[bit // 8] ^= 1 << bit % 8
        assert device.arrives(bytes(changed)) == -1
    assert agent.open(up, PEER)[0] == device.arrives(down) == b"message"


def test_no_bit_of_a_handshake_can_change(device: Device) -> None:
    agent = Handshakes({CLIENT_KEY: PSK})
    first = first_of(device)
    for bit in range(8, 8 * len(first)):
        changed = bytearray(first)
        changed[bit // 8] ^= 1 << bit % 8
        assert agent.answer(bytes(changed), PEER, float(bit))[1].startswith("seal_")
    second, _ = agent.answer(first, PEER, 1000.0)
    for bit in (*range(32), *range(64, 8 * len(second))):  # between these: the agent's own index
        changed = bytearray(second)
        changed[bit // 8] ^= 1 << bit % 8
        assert device.arrives(bytes(changed)) == -1
        assert not device.is_ready
    assert device.arrives(second) == 0
    assert device.is_ready


def test_records_arrive_once_and_in_any_order_within_the_window(device: Device) -> None:
    agent = connected(device)
    up = [from_device(device, b"%d" % i) for i in range(WINDOW + 8)]
    down = [from_agent(agent, b"%d" % i) for i in range(40)]
    for i in (3, 0, 2, 1, 39, 8):
        assert device.arrives(down[i]) == b"%d" % i
        assert device.arrives(down[i]) == -1
    assert device.arrives(down[7]) == -1  # older than the device's window of 32
    assert device.replayed == 7
    for i in (1, 0, WINDOW + 7, 8):
        assert agent.open(up[i], PEER)[0] == b"%d" % i
        with pytest.raises(RecordError, match="replayed"):
            agent.open(up[i], PEER)
    with pytest.raises(RecordError, match="replayed"):
        agent.open(up[7], PEER)


def test_forged_record_does_not_move_the_window(device: Device) -> None:
    agent = connected(device)
    down = from_agent(agent, b"message")
    ahead = down[:8] + struct.pack("<Q", LAST_RECORD - 1) + down[16:]
    assert device.arrives(ahead) == -1
    assert device.arrives(down) == b"message"


def test_first_message_that_is_sent_again_ends_no_session(device: Device) -> None:
    agent = Handshakes({CLIENT_KEY: PSK})
    first = first_of(device)
    device.arrives(agent.answer(first, PEER, 0.0)[0])
    agent.open(device.sent()[0], PEER)
    for _ in range(3 * UNCONFIRMED):
        agent.answer(first, PEER, 0.0)
    assert agent.open(from_device(device, b"up"), PEER)[0] == b"up"
    assert device.arrives(from_agent(agent, b"down")) == b"down"
    assert len(agent._by_index) == 2, "a repeated message gets the same answer"
    for port in range(3 * UNCONFIRMED):
        agent.answer(first, ("agent", ("192.0.2.2", port)), 0.0)
    assert len(agent._by_index) == len(agent._answers) + 1 == 1 + UNCONFIRMED
    assert agent.open(from_device(device, b"up"), PEER)[0] == b"up"


def test_too_many_handshakes_get_no_answer(device: Device) -> None:
    agent = Handshakes({CLIENT_KEY: PSK})
    first = first_of(device)
    for port in range(10 * HANDSHAKES_PER_SECOND):
        agent.answer(first, ("agent", ("192.0.2.2", port)), 0.0)
    with pytest.raises(RecordError, match="too_many"):
        agent.answer(first, PEER, 0.0)
    assert agent.answer(first, PEER, 1.0)[1] == ""


def test_handshakes_of_strangers_take_nothing_from_the_rate(device: Device) -> None:
    agent = Handshakes({CLIENT_KEY: PSK})
    first = first_of(device)
    forged = first[: FIRST.size] + bytes(range(1, 49))
    for _ in range(20 * HANDSHAKES_PER_SECOND):
        assert agent.answer(forged, PEER, 0.0)[1] == "seal_other_key"
    assert agent.answer(first, PEER, 0.0)[1] == ""


@pytest.mark.parametrize("start", [0, 0xFFFF_F000])
def test_agent_that_restarts_within_the_handshake(device: Device, start: int) -> None:
    """The device has the answer, and the agent that restarted does not know the session."""
    device.clock(start)
    (first,) = (first_of(device),)
    device.arrives(Handshakes({CLIENT_KEY: PSK}).answer(first, PEER, 0.0)[0])
    restarted = Handshakes({CLIENT_KEY: PSK})
    for ms in range(0, 60_000, 1_000):
        device.clock((start + ms) % 2**32)
        device.send(b"CREATE_CLIENT")
        for datagram in device.sent():
            if datagram[0] == Kind.FIRST:
                device.arrives(restarted.answer(datagram, PEER, ms / 1000)[0])
                device.send(b"CREATE_CLIENT")
                assert restarted.open(device.sent()[-1], PEER)[0] == b"CREATE_CLIENT"
                return
    pytest.fail("no new handshake within a minute")


@pytest.mark.parametrize("delay_ms", [600, 2_000])
def test_slow_line(device: Device, delay_ms: int) -> None:
    """The device repeats its first message before the answer arrives, and uses the first answer."""
    agent, up, down = Handshakes({CLIENT_KEY: PSK}), [], []
    assert device.open()
    for ms in range(0, 20_000, 20):
        device.clock(ms)
        if ms % 200 == 0:
            device.send(b"CREATE_CLIENT")
        up += [(ms + delay_ms, datagram) for datagram in device.sent()]
        while up and up[0][0] <= ms:
            datagram = up.pop(0)[1]
            if datagram[0] == Kind.FIRST:
                down.append((ms + delay_ms, agent.answer(datagram, PEER, ms / 1000)[0]))
            else:
                assert agent.open(datagram, PEER)[0] == b"CREATE_CLIENT"
                assert device.refused == 0, "the answer to a repetition is no fault"
                return
        while down and down[0][0] <= ms:
            device.arrives(down.pop(0)[1])
    pytest.fail("no session within 20 s")


def test_record_of_an_earlier_session_is_refused(device: Device) -> None:
    agent = connected(device)
    old_up, old_down = from_device(device, b"old"), from_agent(agent, b"old")
    device.close()
    connect(device, agent)
    with pytest.raises(RecordError, match="no_session"):
        agent.open(old_up, PEER)
    assert device.arrives(old_down) == -1
    assert device.arrives(from_agent(agent, b"new")) == b"new"


def test_record_from_another_address_is_refused(device: Device) -> None:
    agent = connected(device)
    record = from_device(device, b"up")
    with pytest.raises(RecordError, match="no_session"):
        agent.open(record, ("agent", ("192.0.2.1", 4001)))
    assert agent.seal(b"down", CLIENT_KEY, ("agent", ("192.0.2.1", 4001))) is None


def test_agent_that_restarted_has_no_session(device: Device) -> None:
    connected(device)
    record = from_device(device, b"up")
    restarted = Handshakes({CLIENT_KEY: PSK})
    with pytest.raises(RecordError, match="no_session"):
        restarted.open(record, PEER)
    device.close()
    connect(device, restarted)


@pytest.mark.parametrize(
    ("keys", "kind"), [({CLIENT_KEY: bytes(32)}, "seal_other_key"), ({1: PSK}, "seal_unknown_key")]
)
def test_device_sees_that_its_key_is_refused(device: Device, keys: dict[int, bytes], kind: str) -> None:
    agent = Handshakes(keys)
    refusal, fault = agent.answer(first_of(device), PEER, 0.0)
    assert (fault, len(refusal)) == (kind, 8)
    assert device.fault == SILENT
    assert device.arrives(refusal) == -1
    assert device.fault == REFUSED
    # Whoever sent it: the true agent can still answer.
    assert device.arrives(Handshakes({CLIENT_KEY: PSK}).answer(first_of(device), PEER, 0.0)[0]) == 0
    assert device.is_ready


def test_other_version_is_refused_and_not_spoken(device: Device) -> None:
    first = bytearray(first_of(device))
    first[1] = 0
    refusal, fault = Handshakes({CLIENT_KEY: PSK}).answer(bytes(first), PEER, 0.0)
    assert (fault, refusal[0], refusal[2]) == ("seal_other_version", Kind.REFUSAL, 3)


def test_answer_without_the_key_is_refused(device: Device) -> None:
    first = first_of(device)
    head = FIRST.pack(Kind.SECOND, 1, 0, 9, FIRST.unpack_from(first)[3])
    assert device.arrives(head + bytes(range(48))) == -1
    assert (device.fault, device.is_ready) == (FORGED, 0)


@pytest.mark.parametrize("point", [bytes(32), bytes([1]) + bytes(31)])
def test_points_of_small_order_are_refused(device: Device, point: bytes) -> None:
    first = first_of(device)
    head = FIRST.pack(Kind.SECOND, 1, 0, 9, FIRST.unpack_from(first)[3])
    assert device.arrives(head + point + bytes(16)) == -1
    assert not device.is_ready
    with pytest.raises(HandshakeError):
        respond(PSK, b"", point + bytes(16), lambda: None)


def answer_to_zeros() -> bytes:
    """Return what answers a first message whose secret, chaining key and hash are zeros: no key is needed for it."""
    state, secret = object.__new__(_State), X25519PrivateKey.generate()
    state._hash = state._chain = bytes(32)
    local = secret.public_key().public_bytes_raw()
    state.mix_ephemeral(local)
    state.mix_key(secret.exchange(X25519PrivateKey.from_private_bytes(bytes(32)).public_key()))
    return local + state.seal()


def test_nothing_is_an_answer_without_a_handshake(device: Device) -> None:
    """The next one could not begin, because the key was not there for a moment: the wiped secrets begin no session."""
    first = first_of(device)
    own = FIRST.unpack_from(first)[3]
    assert device.arrives(Handshakes({CLIENT_KEY: PSK}).answer(first, PEER, 0.0)[0]) == 0
    device.set_next(LAST_RECORD)
    device.set_key(None)
    assert not device.send(b"up")
    assert (device.fault, len(device.sent())) == (NO_KEY, 1)
    assert device.arrives(FIRST.pack(Kind.SECOND, 1, 0, 9, own) + answer_to_zeros()) == -1
    assert device.arrives(REFUSAL.pack(Kind.REFUSAL, 1, Reason.UNKNOWN_KEY, 0, own)) == -1
    assert (device.fault, device.is_ready, device.refused) == (NO_KEY, 0, 2)
    device.set_key(PSK)
    assert device.send(b"up")
    (again,) = device.sent()
    assert again != first
    assert device.arrives(Handshakes({CLIENT_KEY: PSK}).answer(again, PEER, 0.0)[0]) == 0
    assert device.is_ready


def test_plain_message_is_refused(device: Device) -> None:
    connected(device)
    assert device.arrives(b"\x81\x00\x00\x00" + bytes(40)) == -1
    assert device.refused == 1


@pytest.mark.parametrize("start", [0, 0xFFFF_FF00])
def test_first_message_is_repeated_at_growing_intervals(device: Device, start: int) -> None:
    times = []
    device.clock(start)
    assert device.open()
    firsts = set()
    for ms in range(0, 20_000, 10):
        device.clock(start + ms)
        assert device.send(b"waiting")
        for datagram in device.sent():
            firsts.add(datagram)
            times.append(ms)
    pauses = [b - a for a, b in pairwise(times)]
    assert len(firsts) == 1
    assert pauses == sorted(pauses)
    assert pauses[0] == 50
    assert pauses[-1] == 2000
    assert not device.send(bytes(65))  # larger than what waits
    answer, _ = Handshakes({CLIENT_KEY: PSK}).answer(firsts.pop(), PEER, 0.0)
    assert device.arrives(answer) == 0
    assert len(device.sent()) == 1


def test_session_ends_before_its_counter_does(device: Device) -> None:
    agent = connected(device)
    device.set_next(LAST_RECORD - 1)
    assert agent.open(from_device(device, b"last"), PEER)[0] == b"last"
    assert device.send(b"next")
    (first,) = device.sent()
    assert first[0] == Kind.FIRST
    assert device.arrives(agent.answer(first, PEER, 0.0)[0]) == 0
    (record,) = device.sent()
    assert RECORD.unpack_from(record)[4] == 0
    assert agent.open(record, PEER)[0] == b"next"


def test_agent_never_uses_a_counter_twice(device: Device) -> None:
    agent = connected(device)
    session = agent._current[CLIENT_KEY][0]
    session._sent = LAST_RECORD
    record = agent.seal(b"last", CLIENT_KEY, PEER)
    assert record is not None
    assert agent.seal(b"more", CLIENT_KEY, PEER) is None
    assert device.arrives(record) == b"last"
    assert device.send(b"up")
    (first,) = device.sent()  # the device begins another session
    assert first[0] == Kind.FIRST


def test_keys_are_wiped(device: Device) -> None:
    connected(device)
    assert not device.is_wiped
    device.close()
    assert device.is_wiped
    first_of(device)
    assert not device.is_wiped
    device.close()
    assert device.is_wiped


def test_without_a_key_nothing_is_sent(library: Path, transport: str) -> None:
    device = Device(library, None, transport)
    assert not device.open()
    assert (device.fault, device.sent()) == (1, [])


def test_message_larger_than_the_buffer_is_refused(device: Device) -> None:
    agent = connected(device)
    assert device.arrives(from_agent(agent, bytes(40)), capacity=39) == -1
    assert device.arrives(from_agent(agent, bytes(40)), capacity=40) == bytes(40)


@pytest.mark.skipif(not shutil.which("arm-none-eabi-gcc"), reason="no arm-none-eabi-gcc")
def test_sizes_of_the_page(library: Path, tmp_path: Path) -> None:
    """Each figure is right to a tenth; compilers differ."""
    headers = tmp_path / "system"
    headers.mkdir()
    for name in ("psa", "mbedtls"):  # not those of the C library of this machine
        (headers / name).symlink_to(Path("/usr/include") / name)
    page = (ROOT / "docs/howto/seal.md").read_text(encoding="utf-8")
    rows = re.findall(r"(?m)^\| .* \((`\w+\.c`.*)\) \| (\d+) \| (\d+) \|$", page)
    assert len(rows) == 3
    for column, cpu in enumerate(("cortex-m4", "cortex-m0plus"), 1):
        for row in rows:
            total = 0
            for name in re.findall(r"\w+\.c", row[0]):
                source, built = library.parent / "out" / "src" / "seal" / name, tmp_path / "unit.o"
                flags = [
                    f"-mcpu={cpu}",
                    "-mthumb",
                    "-Os",
                    "-std=c99",
                    f"-I{library.parent / 'out' / 'include'}",
                ]
                command = [
                    "arm-none-eabi-gcc",
                    *flags,
                    "-isystem",
                    str(headers),
                    "-c",
                    str(source),
                    "-o",
                    str(built),
                ]
                subprocess.run(command, check=True)
                sizes = subprocess.run(
                    ["arm-none-eabi-size", str(built)], check=True, capture_output=True, text=True
                )
                total += int(sizes.stdout.splitlines()[1].split()[0])
            assert total == pytest.approx(int(row[column]), rel=0.1), row[0]
