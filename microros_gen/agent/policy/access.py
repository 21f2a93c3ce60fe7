# SPDX-License-Identifier: Apache-2.0
"""What one client may use: the check of each object, in whatever form the client or a file describes it."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from microros_gen.agent.checks import RefusedError
from microros_gen.agent.policy.model import ClientRule, NameRule, QosRule
from microros_gen.agent.representation import Description, Endpoint, Participant, Qos, Service, Topic
from microros_gen.agent.ros.client_graph import GRAPH_TOPIC
from microros_gen.agent.ros.domains import DOMAIN_OF_AGENT, own_domain
from microros_gen.agent.ros.names import ros_node, ros_service, ros_topic
from microros_gen.agent.wire.constants import ObjectKind, Status

_ACTION = re.compile(r"(.+)/_action/(?:send_goal|cancel_goal|get_result|feedback|status)")
"""Services and topics of an action (design article "Actions")."""
_DOES = {
    "publish": "publish on",
    "subscribe": "subscribe to",
    "call": "call",
    "serve": "provide",
    "call_actions": "send goals to",
    "serve_actions": "provide the action",
}
_OF_ACTION = {
    "publish": "serve_actions",
    "serve": "serve_actions",
    "subscribe": "call_actions",
    "call": "call_actions",
}


@dataclass(eq=False)
class Access:
    """The permissions of one client; a reload of the policy replaces the rule. Without one everything is permitted."""

    rule: ClientRule | None = None

    def adapted(self, description: Description) -> Description:
        """Return a description as the rule wants it: a participant in the domain of the rule."""
        domain = self.rule.domain if self.rule is not None else None
        if domain is None or not isinstance(description, Participant):
            return description
        return replace(description, domain=domain)

    def check(self, kind: int, description: Description, topic: Description | None, fallback: str) -> None:
        """Check an object of a kind, whose `topic` is described elsewhere if it is an endpoint without one.

        `fallback` is the name of nodes without one. Raises RefusedError, or BridgeError for a name that is invalid in
        ROS 2.
        """
        if self.rule is None:
            return
        if isinstance(description, Participant):
            self._check_node(self.rule, description, fallback)
        elif isinstance(description, Service):
            self._check_name(
                self.rule, "call" if kind == ObjectKind.REQUESTER else "serve", ros_service(description).name
            )
        elif isinstance(description, Endpoint):
            self._check_endpoint(self.rule, kind, description.topic or topic, description.qos)

    def _check_node(self, rule: ClientRule, node: Participant, fallback: str) -> None:
        domain = own_domain() if node.domain == DOMAIN_OF_AGENT else node.domain
        if rule.domains is not None and domain not in rule.domains:
            raise _denied(rule, f"use domain {domain}")
        name, namespace = ros_node(node.name.strip("/") or fallback)
        full = f"{namespace.rstrip('/')}/{name}"
        if not rule.permits_node(full):
            raise _denied(rule, f"have a node {full}")

    def _check_endpoint(self, rule: ClientRule, kind: int, topic: Description | None, qos: Qos) -> None:
        if not isinstance(topic, Topic):
            return  # it cannot be created
        writes = kind == ObjectKind.DATAWRITER
        if topic.name == GRAPH_TOPIC and not writes:
            if not rule.graph:
                raise _denied(rule, "observe the ROS graph")
            return
        name = ros_topic(topic.name)
        entry = self._check_name(rule, "publish" if writes else "subscribe", name)
        fault = None if _ACTION.fullmatch(name) else _qos_fault(entry.qos, qos)
        if fault:
            does = _DOES["publish" if writes else "subscribe"]
            raise _denied(rule, f"{does} {name} with {fault}")

    def _check_name(self, rule: ClientRule, key: str, name: str) -> NameRule:
        action = _ACTION.fullmatch(name)
        if action:
            key, name = _OF_ACTION[key], action[1]
        entry = rule.find(key, name)
        if entry is None or entry.refuse:
            raise _denied(rule, f"{_DOES[key]} {name}")
        return entry


def _denied(rule: ClientRule, what: str) -> RefusedError:
    return RefusedError(Status.DENIED, f"the rule {rule.label} does not let it {what}")


def _qos_fault(permitted: QosRule, qos: Qos) -> str:
    """Return the QoS of an endpoint that is not permitted, empty if all is."""
    reliability = "reliable" if qos.reliable else "best_effort"
    history = "keep_last" if qos.keep_last else "keep_all"
    for value, choices in (
        (reliability, permitted.reliability),
        (qos.durability.value, permitted.durability),
        (history, permitted.history),
    ):
        if choices is not None and value not in choices:
            return value
    if permitted.depth is None:
        return ""
    if not qos.keep_last:
        return history
    return f"depth {qos.depth}" if (qos.depth or 1) > permitted.depth else ""
