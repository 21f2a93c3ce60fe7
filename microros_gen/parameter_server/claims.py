# SPDX-License-Identifier: Apache-2.0
"""Which one of several parameter servers of a domain serves: the first one in the order of their claims."""

from __future__ import annotations

import random
from collections.abc import Callable

from microros_gen.records import dataclass
from microros_gen.ros.endpoints import Value
from microros_gen.ros.peer import Peer
from microros_gen.ros.qos import Qos
from microros_gen.ros.serving import Serving

CLAIMS_TOPIC = "/microros_parameters/claims"
CLAIM_TYPE = "microros_parameter_msgs/msg/Claim"
CLAIM_QOS = Qos(transient_local=True, depth=1)
STANDALONE, AGENT = range(2)
"""Ranks: who starts a separate server wants that one."""
REPEAT_S, LIFE_S = 1.0, 5.0
"""Between two messages of a server; a claim without a message for so long is void."""
_OTHERS = 100


@dataclass(frozen=True)
class Claim:
    """What one server says."""

    rank: int
    server: int
    serving: bool

    @property
    def order(self) -> tuple[int, int]:
        """Return what decides between two of them: the lower one serves."""
        return self.rank, self.server

    def __str__(self) -> str:
        """Return how a log names the server."""
        return f"{'an agent' if self.rank == AGENT else 'a separate server'}, 0x{self.server:016X}"


class Claims:
    """The claims of a domain, as far as they are known. Not thread-safe."""

    def __init__(self, rank: int, clock: Callable[[], float], server: int | None = None) -> None:
        """`clock` gives seconds and never goes back; `server` None: a random number."""
        self._clock = clock
        self.own = Claim(rank, random.getrandbits(64) if server is None else server, False)
        self._others: dict[int, tuple[Claim, float]] = {}

    def set_serving(self, serving: bool) -> None:
        """Change the own claim."""
        self.own = Claim(self.own.rank, self.own.server, serving)

    def hear(self, message: Value) -> None:
        """Take a message; the own ones come back."""
        claim = Claim(message["rank"], message["server"], message["serving"])
        if claim.server != self.own.server:
            self._others[claim.server] = (claim, self._clock())

    def others(self) -> list[Claim]:
        """Return the claims of others that are not void, in their order."""
        oldest = self._clock() - LIFE_S
        self._others = {key: known for key, known in self._others.items() if known[1] >= oldest}
        return sorted((claim for claim, _ in self._others.values()), key=lambda claim: claim.order)

    def leader(self) -> Claim | None:
        """Return the claim because of which this server must not serve, if any.

        Another one that serves goes on; if two do, or a server of a lower rank waits, the order decides.
        """
        for claim in self.others():
            before = claim.order < self.own.order
            yields = before and (claim.serving or claim.rank < self.own.rank)
            waits = before or claim.serving
            if yields if self.own.serving else waits:
                return claim
        return None


class Candidate(Serving):
    """Claims to serve, on the node of a peer, in the thread that calls `turn`."""

    def __init__(
        self, peer: Peer, claims: Claims, clock: Callable[[], float], report: Callable[[str], object]
    ) -> None:
        """`report` gets a line about each message that cannot be read."""
        super().__init__(peer, report)
        self.claims = claims
        self._clock = clock
        self._due = clock()
        self._publisher = peer.publisher(CLAIMS_TOPIC, CLAIM_TYPE, CLAIM_QOS)
        peer.subscribe(CLAIMS_TOPIC, CLAIM_TYPE, claims.hear, Qos(transient_local=True, depth=_OTHERS))

    def set_serving(self, serving: bool) -> None:
        """Change the claim, and say so."""
        self.claims.set_serving(serving)
        self._due = self._clock()
        self.turn(0)

    def turn(self, timeout_s: float = 0.0) -> None:
        """Say and hear what is due; wait for a message of another one at most `timeout_s`."""
        if self._clock() >= self._due:
            own = self.claims.own
            self._due = self._clock() + REPEAT_S
            claim = {"server": own.server, "rank": own.rank, "serving": own.serving}
            self._attempt(lambda: self._publisher.publish(claim))
        self._spin(timeout_s)
