# SPDX-License-Identifier: Apache-2.0
"""The policy file of the agent: read at the start, and again on SIGHUP."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Protocol

from microros_gen.agent.log import EventLog, Level
from microros_gen.agent.policy.checks import check_domain
from microros_gen.agent.policy.model import Policy
from microros_gen.agent.policy.parser import parse_policy
from microros_gen.cli.agent.options import AgentOptions, read_sources
from microros_gen.diagnostics import Diagnostics


def read_policy(options: AgentOptions, diagnostics: Diagnostics) -> Policy | None:
    """Return the policy of the options, None if they name no file; faults go to `diagnostics`."""
    if options.policy is None:
        return None
    sources = read_sources([options.policy], diagnostics, options.places)
    if not sources:
        return None
    policy = parse_policy(sources[0], diagnostics)
    check_domain(policy, options.domain, diagnostics)
    if options.domain is None:
        return policy
    # All clients are put into that domain, whichever they request.
    return Policy(tuple(replace(rule, domains=None) for rule in policy.rules))


def report_policy(path: Path, policy: Policy, log: EventLog) -> None:
    """Report that a policy is in force."""
    text = "policy: {rules} rules of {file}; other clients are refused"
    log.emit(Level.INFO, "policy", text, rules=len(policy.rules), file=str(path))


class Ruled(Protocol):
    """An agent, or the front of its workers."""

    def apply_policy(self, policy: Policy | None) -> None:
        """Replace the policy."""


def reloading(options: AgentOptions, agent: Ruled, log: EventLog) -> Callable[[], None] | None:
    """Return the function that reads the file again and applies it; None without a file."""
    path = options.policy
    if path is None:
        return None

    def reload() -> None:
        diagnostics = Diagnostics()
        policy = read_policy(options, diagnostics)
        for diagnostic in diagnostics:
            text = "policy: {reason}"
            log.emit(Level.WARNING, "policy_fault", text, reason=diagnostic.headline())
        if policy is None or diagnostics.has_errors():
            log.emit(Level.WARNING, "policy_kept", "the new policy has faults; the one before stays in force")
            return
        report_policy(path, policy, log)
        agent.apply_policy(policy)

    return reload
