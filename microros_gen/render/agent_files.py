# SPDX-License-Identifier: Apache-2.0
"""Renders OUT/agent/: references.xml for every agent, entities.json for this project's."""

from __future__ import annotations

import json
from html import escape
from typing import Any

from microros_gen.plan.agent_files import (
    ENTITIES,
    REFERENCES,
    AgentFiles,
    AgentWriter,
    object_id,
    plan_agent_files,
)
from microros_gen.plan.project import Project


def render_agent_files(project: Project) -> dict[str, bytes]:
    """Return the files that an agent must hold for `project`, by path; none where the client describes all."""
    if project.selection.entities == "reference":
        return {REFERENCES: references_xml(plan_agent_files(project)).encode()}
    if project.selection.entities == "preconfigured":
        return {ENTITIES: entities_json(plan_agent_files(project)).encode()}
    return {}


def references_xml(files: AgentFiles) -> str:
    """Return the profiles that the client names, as the public agent reads them with `-r`."""
    blocks = {n.reference: _participant(n.reference, n.name) for n in files.nodes}
    blocks |= {w.topic_reference: _topic(w) for w in files.writers}
    blocks |= {w.writer_reference: _data_writer(w) for w in files.writers}
    return '<?xml version="1.0" encoding="UTF-8"?>\n<profiles>\n' + "".join(blocks.values()) + "</profiles>\n"


def entities_json(files: AgentFiles) -> str:
    """Return the objects that the agent makes when a client with this key opens its session."""
    objects: list[dict[str, Any]] = []
    for node in files.nodes:
        participant = _id(node.index, "participant")
        objects.append(
            {"id": participant, "kind": "participant", "name": node.name, "domain": node.domain_id}
        )
        for writer in files.writers:
            if writer.node == node.index:
                objects += _writer_objects(writer, participant)
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


def _topic(writer: AgentWriter) -> str:
    return (
        f'  <topic profile_name="{escape(writer.topic_reference)}">\n'
        f"    <kind>NO_KEY</kind>\n    <name>{escape(writer.topic)}</name>\n"
        f"    <dataType>{escape(writer.dds_type)}</dataType>\n  </topic>\n"
    )


def _data_writer(writer: AgentWriter) -> str:
    qos = writer.qos
    depth = f"        <depth>{qos.depth}</depth>\n" if qos.depth else ""
    return (
        f'  <data_writer profile_name="{escape(writer.writer_reference)}">\n'
        f"    <topic>\n      <kind>NO_KEY</kind>\n      <name>{escape(writer.topic)}</name>\n"
        f"      <dataType>{escape(writer.dds_type)}</dataType>\n"
        f"      <historyQos>\n        <kind>{qos.history.upper()}</kind>\n{depth}      </historyQos>\n    </topic>\n"
        f"    <qos>\n      <durability>\n        <kind>{qos.durability.upper()}</kind>\n      </durability>\n"
        f"      <reliability>\n        <kind>{qos.reliability.upper()}</kind>\n      </reliability>\n    </qos>\n"
        f"  </data_writer>\n"
    )


def _writer_objects(writer: AgentWriter, participant: str) -> list[dict[str, Any]]:
    topic, publisher = _id(writer.index, "topic"), _id(writer.index, "publisher")
    return [
        {"id": topic, "kind": "topic", "parent": participant, "name": writer.topic, "type": writer.dds_type},
        {"id": publisher, "kind": "publisher", "parent": participant},
        {
            "id": _id(writer.index, "data_writer"),
            "kind": "data_writer",
            "parent": publisher,
            "topic": topic,
            "reliability": writer.qos.reliability,
            "durability": writer.qos.durability,
            "history": writer.qos.history,
            "depth": writer.qos.depth,
        },
    ]


def _id(index: int, kind: str) -> str:
    return f"0x{object_id(index, kind):04X}"
