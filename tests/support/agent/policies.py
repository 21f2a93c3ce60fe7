# SPDX-License-Identifier: Apache-2.0
"""Policies for tests, and clients of a bench that ask for what those permit or not."""

from __future__ import annotations

from collections.abc import Hashable

from microros_gen.agent.policy.model import Policy
from microros_gen.agent.policy.parser import parse_policy
from microros_gen.agent.wire.constants import Format, Status
from microros_gen.agent.wire.entity_messages import Create
from microros_gen.agent.wire.message import Header, join
from microros_gen.agent.wire.submessages import encode
from microros_gen.diagnostics import Diagnostics, Source
from tests.support.agent.client import (
    dds_type,
    participant_blob,
    reader_blob,
    service_blob,
    topic_blob,
    writer_blob,
)
from tests.support.agent.fakes import Bench
from tests.support.agent.newcomers import hello

OK, MATCHED, DENIED = Status.OK, Status.OK_MATCHED, Status.DENIED
INT32 = "std_msgs/msg/Int32"


def policy_of(*rules: str) -> Policy:
    """Return the policy with these rules, each the inside of a mapping."""
    text = "".join(f"  - {{{rule}}}\n" for rule in rules)
    diagnostics = Diagnostics()
    policy = parse_policy(
        Source("policy.yaml", f"version: 1\nclients:\n{text}" if text else "version: 1\nclients: []\n"),
        diagnostics,
    )
    diagnostics.check()
    return policy


class Guest:
    """A client of a bench, at one address."""

    def __init__(
        self, bench: Bench, key: int = 1, address: Hashable = "10.0.0.1", session: int = 0x81
    ) -> None:
        self.bench = bench
        self.key = key
        self.address = address
        self.session = session

    def connect(self) -> int:
        """Open a session; return the status."""
        (answer,) = self.bench.say(hello(self.key, self.session), self.address)
        return bytes.fromhex(answer)[4 + 4 + (0 if self.session >= 0x80 else 4)]

    def say(self, *submessages: bytes) -> list[str]:
        """Send a message in the session, without a stream; return the answers."""
        key = b"" if self.session >= 0x80 else self.key.to_bytes(4, "big")
        return self.bench.say(join(Header(self.session, 0, 0, key), list(submessages)), self.address)

    def create(
        self,
        object_id: int,
        body: bytes | str,
        parent: int = 0,
        domain: int = 0,
        mode: str = "reuse replace",
        form: int = 0,
    ) -> int:
        """Create an object; return the status."""
        raw = body if isinstance(body, bytes) else body.encode()
        chosen = form or (Format.BINARY if isinstance(body, bytes) else Format.XML)
        create = Create(
            10, object_id, object_id & 0x0F, chosen, raw, parent, domain, "reuse" in mode, "replace" in mode
        )
        (answer,) = self.say(encode(create))
        return bytes.fromhex(answer)[-2]

    def node(self, name: str = "node", domain: int = 0, number: int = 0) -> int:
        """Create a participant, a publisher and a subscriber; return the status of the participant."""
        status = self.create(number << 4 | 1, participant_blob(name), domain=domain)
        for kind in (3, 4) if status <= MATCHED else ():
            assert self.create(number << 4 | kind, b"\0\0", number << 4 | 1) <= MATCHED
        return status

    def writer(self, topic: str, flags: int = 3, depth: int = 10, number: int = 1) -> int:
        """Create a topic and a writer of it; return the status of the writer."""
        assert self.create(number << 4 | 2, topic_blob(f"rt{topic}", dds_type(INT32)), 0x01) <= MATCHED
        return self.create(number << 4 | 5, writer_blob(number << 4 | 2, flags, depth), 0x03)

    def reader(self, topic: str, flags: int = 3, depth: int = 10, number: int = 2) -> int:
        """Create a topic and a reader of it; return the status of the reader."""
        assert self.create(number << 4 | 2, topic_blob(f"rt{topic}", dds_type(INT32)), 0x01) <= MATCHED
        return self.create(number << 4 | 6, reader_blob(number << 4 | 2, flags, depth), 0x04)

    def service(self, name: str, kind: int, number: int = 3) -> int:
        """Create a requester (kind 7) or a replier (8); return the status."""
        return self.create(number << 4 | kind, service_blob(name, "std_srvs/srv/SetBool"), 0x01)
