# SPDX-License-Identifier: Apache-2.0
"""The messages of declared services and clients as roots of limits: each entity is two, one for each direction."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.application.kinds import KIND
from microros_gen.application.model import Application, LimitRule
from microros_gen.client.plan.declared import declarations, full_name, node_name, type_name
from microros_gen.interfaces.derived import derived_name
from microros_gen.interfaces.types import Message, TypeName
from microros_gen.typesupport.plan.capacity import Entity, Root


def service_roots(application: Application, messages: Mapping[TypeName, Message], room: int) -> list[Root]:
    """Return request and response of every declared service and client, with the limits that are theirs.

    `room` as of Root. A limit of an entity names a member of its request or of its response; one that is in neither is
    left to the request, where it is an error.
    """
    return [
        Root(
            derived_name(service, part),
            part_rules(endpoint.limits, service, part, messages),
            endpoint.type_span or endpoint.span,
            room,
            Entity(kind, index, full_name(node, endpoint), node_name(node), sends),
            part_rules(endpoint.usual_limits, service, part, messages),
        )
        for kind in ("service", "client")
        for index, (_, node, endpoint) in enumerate(declarations(application, kind))
        for service in [type_name(endpoint.type, "srv")]
        for part, sends in KIND[kind].parts
    ]


def part_rules(
    rules: tuple[LimitRule, ...], service: TypeName, part: str, messages: Mapping[TypeName, Message]
) -> tuple[LimitRule, ...]:
    """Return the rules for `part` (`Request` or `Response`) of a service, their paths below that message."""
    request, response = (derived_name(service, name) for name in ("Request", "Response"))
    members = {name: {f.name for f in messages[name].fields} for name in (request, response)}
    own, other = (request, response) if part == "Request" else (response, request)
    found = []
    for rule in rules:
        member = rule.path[1] if len(rule.path) > 1 else ""
        theirs = member in members[other] and member not in members[own]
        unknown = member not in members[other] and member not in members[own] and part == "Response"
        if not member:
            found.append(rule)
        elif not theirs and not unknown:
            found.append(_below(rule, own))
    return tuple(found)


def _below(rule: LimitRule, message: TypeName) -> LimitRule:
    return LimitRule((str(message), *rule.path[1:]), rule.string, rule.sequence, rule.span, rule.single)
