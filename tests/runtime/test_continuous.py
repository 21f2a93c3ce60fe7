# SPDX-License-Identifier: Apache-2.0
"""Continuous serialization with a scripted agent: bytes, refusals, lost fragments and sessions, clock wrap."""

from __future__ import annotations

import struct
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from microros_gen.selection.find_components import load_catalogue
from tests.support.patience import seconds
from tests.support.runtime.continuous_agent import CONTINUOUS, ContinuousAgent
from tests.support.runtime.driver import Client
from tests.support.runtime.harness import SANITIZE, SANITIZER, build
from tests.support.runtime.surface import write_application
from tests.support.runtime.tcp import TcpAgent, serving

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [+continuous_serialization]
interfaces: [std_msgs/msg/UInt8MultiArray]
pools: {publishers: 2}
limits: {"*": {string: 4, sequence: 1}}
transport: {mtu: 400}
session: {key: 1}
"""
MTU = 400
ROOM = MTU - 8
HEAD = 8
BASE = struct.pack("<III", 0, 0, 0)
"""An empty UInt8MultiArray: no dimensions, offset, no data."""
NEARLY_WRAPPED = 2**32 - 2700
LIMIT_MS = 5000
LARGEST = 65_527


def rest(count: int) -> bytes:
    """Return what the callback writes."""
    return bytes((i + i // 251) & 0xFF for i in range(count))


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    tree = write_application(tmp_path_factory.mktemp("continuous") / "tree", APPLICATION)
    return build(
        tree.without_port(), ["port_fake.c", "client_continuous.c"], "continuous", SANITIZER, SANITIZE
    )


@pytest.fixture(params=[0, NEARLY_WRAPPED], ids=["zero", "wraps"])
def client(program: Path, request: pytest.FixtureRequest) -> Iterator[Client]:
    """A client with an open publisher and its callbacks, whose clock wraps during the test or not."""
    with Client(program, ContinuousAgent()) as connected:
        connected.wait(request.param)
        connected.ok("init")
        connected.ok("set")
        connected.sent.clear()
        yield connected


def agent_of(client: Client) -> ContinuousAgent:
    assert isinstance(client.agent, ContinuousAgent)
    return client.agent


def bodies(client: Client) -> list[bytes]:
    return [body for _, body in client.agent.written]


def dropped(client: Client) -> int:
    return int(client.ok("dropped").lines[0].split()[1])


@pytest.mark.parametrize(
    "count", [0, 1, ROOM - HEAD - 12, ROOM - HEAD - 11, 2 * ROOM - HEAD - 12, 2 * ROOM - HEAD - 11, 5000]
)
def test_fragments_join_to_one_sample(client: Client, count: int) -> None:
    client.ok(f"publish bytes {count} {count} 0")
    assert bodies(client) == [BASE + rest(count)]
    sent = [d for d in client.sent if d[1] == CONTINUOUS]
    whole = HEAD + 12 + count
    assert len(sent) == max(1, -(-whole // ROOM))
    assert all(len(d) == MTU for d in sent[:-1])
    assert [struct.unpack_from("<H", d, 2)[0] for d in sent] == list(range(len(sent)))
    assert all(d[4] == (0x0D if len(sent) > 1 else 0x07) for d in sent)


def test_values_are_encoded_as_in_cdr(client: Client) -> None:
    """Each is aligned to its size from the first byte of the body; the byte order is that of the buffer."""
    body = BASE[:8]

    def add(form: str, *values: object) -> None:
        nonlocal body
        size = struct.calcsize("<" + form[-1])
        body += b"\0" * (-len(body) % size) + struct.pack(form, *values)

    for form, value in (("<?", True), ("<h", -2), ("<c", b"x"), ("<Q", 0x0102030405060708), ("<b", -1)):
        add(form, value)
    add("<f", 1.5)
    add("<B", 7)
    add("<I", 3)
    for word in (0x0102, 0x0304, 0x0506):
        add("<H", word)
    add("<q", -3)
    add("<I", 4)
    body += b"abc\0"
    add("<d", 0.5)
    add("<d", -2.0)
    for word in (0x0102, 0x0304, 0x0506):
        add(">H", word)
    add(">i", 0x01020304)
    body += b"\0" * (-len(body) % 8)
    client.ok(f"publish values {len(body) - 12} 0 4")
    assert bodies(client) == [body]


def test_a_buffer_without_a_callback_writes_whole_values_or_nothing(client: Client) -> None:
    """And nothing after an error."""
    assert client.ok("buffer").lines == ("1 0 0 1 0100",)


def test_too_large_is_refused_and_the_largest_is_sent(client: Client) -> None:
    result = client.call(f"publish bytes {LARGEST - 11} 0 0")
    assert (result.code, result.error) == (
        1,
        "publisher /frames: a message of 65528 bytes, and XRCE carries 65527",
    )
    assert (client.sent, dropped(client)) == ([], 1)
    client.ok(f"publish bytes {LARGEST - 12} {LARGEST - 12} 0")
    assert [len(body) for body in bodies(client)] == [LARGEST]


@pytest.mark.parametrize(("promised", "written"), [(3000, 2999), (3000, 3001), (20, 19), (20, 21), (0, 1)])
def test_a_wrong_promise_reaches_no_subscriber(client: Client, promised: int, written: int) -> None:
    result = client.call(f"publish bytes {promised} {written} 0")
    assert result.code == 1
    assert "promised by the callbacks" in result.error
    client.ok("publish bytes 100 100 0")
    client.ok("publish bytes 2000 2000 0")
    assert bodies(client) == [BASE + rest(100), BASE + rest(2000)]
    assert agent_of(client).joined == b""
    assert dropped(client) == 1


@pytest.mark.parametrize("back", [12, 13, 500])
def test_an_iterator_before_the_message_is_refused(client: Client, back: int) -> None:
    """As far as the first byte of the body it may go."""
    result = client.call(f"publish bytes 0 0 {back}")
    assert result.code == 1
    assert "promised by the callbacks" in result.error
    client.ok("publish bytes 12 24 12")
    assert bodies(client) == [rest(24)]


def test_lost_fragments_and_acknowledgements_are_repeated(client: Client) -> None:
    count = {"fragments": 0, "answers": 0}

    def drop(datagram: bytes) -> bool:
        count["fragments"] += datagram[1] == CONTINUOUS
        return datagram[1] == CONTINUOUS and count["fragments"] % 2 == 1

    def drop_answer(answer: bytes) -> bool:
        count["answers"] += answer[4] == 0x0A and answer[-1] == CONTINUOUS
        return answer[4] == 0x0A and answer[-1] == CONTINUOUS and count["answers"] % 3 == 1

    client.agent.drop, client.agent.drop_answer = drop, drop_answer
    client.ok("publish bytes 5000 5000 0")
    assert bodies(client) == [BASE + rest(5000)]
    first: dict[bytes, bytes] = {}
    for datagram in (d for d in client.sent if d[1] == CONTINUOUS):
        assert first.setdefault(datagram[2:4], datagram) == datagram, "a repetition has the same bytes"
    assert len(first) == len(agent_of(client).fragments)


def test_a_deaf_agent_ends_the_call(client: Client) -> None:
    """The message is abandoned; an empty last fragment ends it later, and the next one arrives."""
    agent = agent_of(client)
    client.ok("publish bytes 1000 1000 0")
    before = len(agent.fragments)
    client.agent.drop = lambda datagram: datagram[1] == CONTINUOUS and len(agent.fragments) == before + 2
    result = client.call("publish bytes 5000 5000 0")
    assert (result.code, result.error) == (
        1,
        "publisher /frames: the agent has 776 of 5012 bytes and acknowledges no more: publish it again",
    )
    assert LIMIT_MS <= result.slept <= LIMIT_MS + 100
    result = client.call("publish bytes 10 10 0")
    assert (result.code, result.error) == (
        1,
        "publisher /frames: other messages are not acknowledged after 5000 ms",
    )
    client.agent.drop = lambda datagram: False
    client.ok("publish bytes 2000 2000 0")
    assert bodies(client) == [BASE + rest(1000), BASE + rest(2000)]
    assert agent.spoiled == 1
    assert dropped(client) == 2


def test_a_new_session_in_the_middle(client: Client) -> None:
    """The public agent joins over sessions: the fragments of the old one are ended before anything else."""
    agent = agent_of(client)

    def restart(datagram: bytes) -> bool:
        if datagram[1] == CONTINUOUS and len(agent.fragments) == 3 and agent.connected:
            agent.restart()
        return False

    client.agent.drop = restart
    result = client.call("publish bytes 5000 5000 0")
    assert result.code == 1
    assert "publish it again" in result.error
    client.agent.drop = lambda datagram: False
    client.spin(60, 100)
    client.ok("publish bytes 2000 2000 0")
    assert bodies(client) == [BASE + rest(2000)]
    assert agent.spoiled == 1


def test_without_a_session(client: Client) -> None:
    client.agent.silent = True
    client.spin(60, 100)
    result = client.call("publish bytes 10 10 0")
    assert (result.code, result.error) == (1, "publisher /frames: no session with the agent")
    assert dropped(client) == 1


def test_callbacks_are_those_of_the_open_publisher(client: Client) -> None:
    client.ok("unset")
    client.ok("publish bytes 50 50 0")
    client.ok("set")
    client.ok("again")
    client.ok("publish bytes 50 50 0")
    client.ok("spin")
    assert bodies(client) == [BASE, BASE]
    assert [d for d in client.sent if d[1] == CONTINUOUS] == []


def test_a_publish_with_callbacks_within_a_callback_is_refused(client: Client) -> None:
    """It waits for the message that it is within, and that one arrives."""
    result = client.ok("publish inside 3000 3000 0")
    assert result.lines == ("inside 1",)
    assert bodies(client) == [BASE + rest(3000)]


def test_numbers_of_errors_have_three_digits_above_99(tmp_path: Path) -> None:
    """With `errors: code`; those up to 99 keep two."""
    tree = write_application(tmp_path / "tree", APPLICATION + "errors: code\n")
    program = build(tree.without_port(), ["port_fake.c", "client_continuous.c"], "continuous")
    errors = {e.name: e.code for c in load_catalogue().values() for e in c.contributes.errors}
    with Client(program, ContinuousAgent()) as connected:
        connected.ok("init")
        connected.ok("set")
        assert connected.call("publish bytes 70000 0 0").error == f"E{errors['continuous_size']:02}"
        connected.ok("unset")
        connected.agent.silent = True
        connected.spin(60, 100)
        assert connected.call("publish bytes 0 0 0").error == f"E{errors['no_session']:02}"


def test_over_tcp_a_fragment_is_larger_than_every_other_message(tmp_path: Path) -> None:
    """The output of a connection has room for it: nobody wrote `transport.mtu`, and the declared message is small."""
    joins = ContinuousAgent()
    with serving(TcpAgent()) as agent:
        agent.agent = joins
        over = f"transport: {{type: tcp, agent: 127.0.0.1:{agent.port}}}\n"
        tree = write_application(tmp_path / "tree", APPLICATION.replace("transport: {mtu: 400}\n", over))
        program = build(tree, ["parts.c"], "parts")
        done = subprocess.run([program], capture_output=True, text=True, timeout=seconds(60), check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert [body for _, body in joins.written] == [BASE + rest(5000)]
