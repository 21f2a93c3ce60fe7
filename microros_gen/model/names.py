# SPDX-License-Identifier: Apache-2.0
"""Names of ROS 2 nodes, namespaces, topics and services: their rules, and how they expand.

Sources: the ROS 2 design page "Topic and Service name mapping to DDS"; the behaviour of rcl/validate_topic_name.h,
rcl/expand_topic_name.h and rmw/validate_{full_topic_name,namespace,node_name}.h of ROS 2 Jazzy.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

LONGEST_NODE_NAME = 255
"""Bytes of a node's name (RMW_NODE_NAME_MAX_NAME_LENGTH)."""

LONGEST_TOPIC_NAME = 247
"""Bytes of a fully qualified name: 255 of DDS less eight for prefix and suffix (RMW_TOPIC_MAX_NAME_LENGTH)."""

LONGEST_NAMESPACE = 245
"""Bytes of a namespace: a slash and one character of a name must follow (RMW_NAMESPACE_MAX_LENGTH)."""

SUBSTITUTIONS = ("node", "ns", "namespace")
"""What may stand in braces in a topic's name."""

_SUBSTITUTION = re.compile(r"\{([^{}]*)\}")


@dataclass(frozen=True)
class NameFault:
    """What is wrong with a name, at which character (from 0), and what to do."""

    message: str
    index: int
    hint: str


def expand_topic_name(topic: str, node: str, namespace: str) -> str:
    """Return the fully qualified name of a valid `topic` in a node: `imu` → `/ns/imu`, `~/x` → `/ns/node/x`."""
    text = substitute(topic, node, namespace)
    base = namespace.rstrip("/")
    if text.startswith("/"):
        return text
    if text.startswith("~"):
        return f"{base}/{node}{text[1:]}"
    return f"{base}/{text}"


def substitute(topic: str, node: str, namespace: str) -> str:
    """Return `topic` with {node}, {ns} and {namespace} replaced; others stay."""
    values = {"node": node, "ns": namespace, "namespace": namespace}
    return _SUBSTITUTION.sub(lambda m: values.get(m.group(1), m.group()), topic)
