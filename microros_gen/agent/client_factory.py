# SPDX-License-Identifier: Apache-2.0
"""Makes clients: the parts of each, with the limits and the permissions that the policy gives it."""

from __future__ import annotations

from collections.abc import Hashable
from functools import partial

from microros_gen.agent.budgets import Budgets
from microros_gen.agent.clients import Client
from microros_gen.agent.entities import Home
from microros_gen.agent.fairness import Accounts
from microros_gen.agent.input_pool import Holder, InputPool
from microros_gen.agent.limits import Limits
from microros_gen.agent.log import EventLog
from microros_gen.agent.manifests import Manifests
from microros_gen.agent.objects import ObjectTree
from microros_gen.agent.policy.access import Access
from microros_gen.agent.rates import Rates, WorkRate
from microros_gen.agent.representation import References
from microros_gen.agent.ros.bridge import Bridge
from microros_gen.agent.services import Calls
from microros_gen.agent.session import Session
from microros_gen.agent.streams_out import Link
from microros_gen.agent.transport.base import Transport
from microros_gen.agent.turns import Turns


class ClientFactory:
    """Makes clients, and changes their limits when the policy has changed."""

    def __init__(
        self,
        bridge: Bridge,
        log: EventLog,
        limits: Limits,
        references: References,
        manifests: Manifests,
        pool: InputPool,
        budgets: Budgets,
        turns: Turns,
    ) -> None:
        self._bridge = bridge
        self._log = log
        self._limits = limits
        self._references = references
        self._manifests = manifests
        self._pool = pool
        self._budgets = budgets
        self._accounts = Accounts(limits.clients, turns.clock)
        self._rates = Rates(limits.operations_per_second, limits.clients)

    def make(
        self,
        link: Link,
        address: Hashable,
        transport: Transport,
        timeout_s: float,
        now: float,
        access: Access,
    ) -> Client:
        """Return a new client without objects."""
        limits, key = self._limits_of(access), link.key
        shares = self._budgets.of_client(limits)
        name = f"xrce_client_{key.hex().upper()}"
        home = Home(self._bridge, name, partial(self._manifests.hash_of, key), shares, access)
        client = Client(
            Session(link, limits, Holder(self._pool), shares.output),
            ObjectTree(home, self._references, limits.objects),
            transport,
            address,
            timeout_s,
            now,
            Calls(self._log, limits.requests, key.hex().upper(), shares.calls),
            self._rates.of(key, limits.operations_per_second),
            self._accounts.of(key),
            opened=now,
            shares=shares,
            access=access,
            limits=limits,
        )
        self.limit(client)
        return client

    def fits(self, client: Client, access: Access) -> bool:
        """Return whether a client has the rule of `access`, and was made with its limits."""
        return client.access.rule == access.rule and client.limits == self._limits_of(access)

    def limit(self, client: Client) -> None:
        """Give a client the limits of its rule that can change during a session."""
        limits, rule = self._limits_of(client.access), client.access.rule
        client.messages_per_second = limits.messages_per_second
        client.rate = self._rates.of(client.session.link.key, limits.operations_per_second)
        work_ms = rule.work_ms if rule is not None else None
        if work_ms is None:
            client.account.work = None
        elif client.account.work is None or client.account.work.ms_per_second != work_ms:
            client.account.work = WorkRate(work_ms)

    def _limits_of(self, access: Access) -> Limits:
        return self._limits if access.rule is None else access.rule.limited(self._limits)
