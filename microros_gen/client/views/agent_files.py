# SPDX-License-Identifier: Apache-2.0
"""Renders OUT/agent/: references.xml for every agent, entities.json for this project's."""

from __future__ import annotations

import json
from html import escape
from typing import Any

from microros_gen.client.plan.agent_files import (
    ENTITIES,
    REFERENCES,
    AgentEndpoint,
    AgentFiles,
    AgentService,
    object_id,
    plan_agent_files,
)
from microros_gen.client.plan.project import Project


def render_agent_files(project: Project) -> dict[str, bytes]:
    """Return the files that an agent must hold for `project`, by path; none where the client describes all."""
    if project.selection.entities == "reference":
        return {REFERENCES: references_xml(plan_agent_files(project)).encode()}
    if project.selection.entities == "preconfigured":
        return {ENTITIES: entities_json(plan_agent_files(project)).encode()}
    return {}


# That of ROS 2's services; the public agent's own is 1, which leaves the last of several requests or replies at once.
_SERVICE_DEPTH = "<topic><historyQos><depth>10</depth></historyQos></topic>"


def references_xml(files: AgentFiles) -> str:
    """Return the profiles that the client names, as the public agent reads them with `-r`."""
    blocks = {n.reference: _participant(n.reference, n.name) for n in files.nodes}
    blocks |= {e.topic_reference: _topic(e) for e in files.endpoints}
    blocks |= {e.reference: _data(e) for e in files.endpoints}
    blocks |= {s.reference: _service(s) for s in files.services}
    return '<?xml version="1.0" encoding="UTF-8"?>\n<profiles>\n' + "".join(blocks.values()) + "</profiles>\n"


def entities_json(files: AgentFiles) -> str:
    """Return the objects that the agent makes when a client with this key opens its session."""
    objects: list[dict[str, Any]] = []
    for node in files.nodes:
        participant = _id(node.index, "participant")
        objects.append(
            {"id": participant, "kind": "participant", "name": node.name, "domain": node.domain_id}
        )
        for endpoint in files.endpoints:
            if endpoint.node == node.index:
                objects += _objects(endpoint, participant)
        objects += [_service_object(s, participant) for s in files.services if s.node == node.index]
    key = "*" if files.key is None else f"0x{files.key:08X}"
    lines = ",\n".join(f"        {json.dumps(entry, ensure_ascii=False)}" for entry in objects)
    adopt = '"adopt": true, ' if files.adopt else ""
    client = f'    {{"key": "{key}", {adopt}"objects": [\n{lines}\n    ]}}'
    return f'{{"version": 1, "clients": [\n{client}\n]}}\n'


def _participant(reference: str, name: str) -> str:
    return (
        f'  <participant profile_name="{escape(reference)}">\n'
        f"    <rtps>\n      <name>{escape(name)}</name>\n    </rtps>\n  </participant>\n"
    )


def _topic(endpoint: AgentEndpoint) -> str:
    return (
        f'  <topic profile_name="{escape(endpoint.topic_reference)}">\n'
        f"    <kind>NO_KEY</kind>\n    <name>{escape(endpoint.topic)}</name>\n"
        f"    <dataType>{escape(endpoint.dds_type)}</dataType>\n  </topic>\n"
    )


def _data(endpoint: AgentEndpoint) -> str:
    qos = endpoint.qos
    depth = f"        <depth>{qos.depth}</depth>\n" if qos.depth else ""
    return (
        f'  <{endpoint.kind} profile_name="{escape(endpoint.reference)}">\n'
        f"    <topic>\n      <kind>NO_KEY</kind>\n      <name>{escape(endpoint.topic)}</name>\n"
        f"      <dataType>{escape(endpoint.dds_type)}</dataType>\n"
        f"      <historyQos>\n        <kind>{qos.history.upper()}</kind>\n{depth}      </historyQos>\n    </topic>\n"
        f"    <qos>\n      <durability>\n        <kind>{qos.durability.upper()}</kind>\n      </durability>\n"
        f"      <reliability>\n        <kind>{qos.reliability.upper()}</kind>\n      </reliability>\n    </qos>\n"
        f"  </{endpoint.kind}>\n"
    )


def _service(service: AgentService) -> str:
    (request, reply), (requests, replies) = service.types, service.topics
    return (
        f'  <{service.kind} profile_name="{escape(service.reference)}" service_name="{escape(service.name)}"'
        f' request_type="{escape(request)}" reply_type="{escape(reply)}">\n'
        f"    <request_topic_name>{escape(requests)}</request_topic_name>\n"
        f"    <reply_topic_name>{escape(replies)}</reply_topic_name>\n"
        f"    <publisher>{_SERVICE_DEPTH}</publisher>\n    <subscriber>{_SERVICE_DEPTH}</subscriber>\n"
        f"  </{service.kind}>\n"
    )


def _service_object(service: AgentService, participant: str) -> dict[str, Any]:
    (request, reply), (requests, replies) = service.types, service.topics
    return {
        "id": _id(service.index, service.kind),
        "kind": service.kind,
        "parent": participant,
        "name": service.name,
        "request_type": request,
        "reply_type": reply,
        "request_topic": requests,
        "reply_topic": replies,
    }


def _objects(endpoint: AgentEndpoint, participant: str) -> list[dict[str, Any]]:
    topic, group = _id(endpoint.index, "topic"), _id(endpoint.index, endpoint.group)
    return [
        {
            "id": topic,
            "kind": "topic",
            "parent": participant,
            "name": endpoint.topic,
            "type": endpoint.dds_type,
        },
        {"id": group, "kind": endpoint.group, "parent": participant},
        {
            "id": _id(endpoint.index, endpoint.kind),
            "kind": endpoint.kind,
            "parent": group,
            "topic": topic,
            "reliability": endpoint.qos.reliability,
            "durability": endpoint.qos.durability,
            "history": endpoint.qos.history,
            "depth": endpoint.qos.depth,
        },
    ]


def _id(index: int, kind: str) -> str:
    return f"0x{object_id(index, kind):04X}"
