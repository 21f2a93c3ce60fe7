# SPDX-License-Identifier: Apache-2.0
"""Names of ROS 2 nodes, namespaces, topics and services: their rules, and how they expand.

Sources: the ROS 2 design page "Topic and Service name mapping to DDS"; the behavior of
rcl/validate_topic_name.h, rcl/expand_topic_name.h and rmw/validate_{full_topic_name,namespace,node_name}.h of
ROS 2 Jazzy.
"""

from __future__ import annotations

import re

from microros_gen.documents.named import NameFault

LONGEST_NODE_NAME = 255
"""Bytes of a node's name (RMW_NODE_NAME_MAX_NAME_LENGTH)."""

LONGEST_TOPIC_NAME = 247
"""Bytes of a fully qualified name.

255 of DDS less eight for prefix and suffix (RMW_TOPIC_MAX_NAME_LENGTH).
"""

LONGEST_NAMESPACE = 245
"""Bytes of a namespace: a slash and one character of a name must follow (RMW_NAMESPACE_MAX_LENGTH)."""

SUBSTITUTIONS = ("node", "ns", "namespace")
"""What may stand in braces in a topic's name."""

_SUBSTITUTION = re.compile(r"\{([^{}]*)\}")


def expand_topic_name(topic: str, node: str, namespace: str) -> str:
    """Return the fully qualified name of a valid `topic` in a node.

    `imu` → `/ns/imu`, `~/x` → `/ns/node/x`.
    """
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


def topic_fault(name: str) -> NameFault | None:
    """Return what is wrong with the name of a topic or service as a user writes it, or None.

    Stricter than rcl in one point: `~x` is refused (rcl joins it to the node's name); `~` needs a slash
    after it.
    """
    if not name:
        return NameFault("is empty", 0, "Write a name such as imu/data", id="MG-1015")
    return _braces_fault(name) or _shape_fault(name, "/~{}")


def expanded_fault(name: str, longest: int = LONGEST_TOPIC_NAME) -> NameFault | None:
    """Return what is wrong with a fully qualified name, or None."""
    if len(name) > longest:
        message = f"is {len(name)} characters long as '{name[:40]}…'; at most {longest} are allowed"
        return NameFault(message, 0, f"Shorten it by {len(name) - longest}", id="MG-3040")
    return _shape_fault(name, "/")


def namespace_fault(name: str) -> NameFault | None:
    """Return what is wrong with a namespace, or None.

    `""` is `/`, and a missing slash is put before it.
    """
    if name in ("", "/"):
        return None
    return expanded_fault(absolute(name), LONGEST_NAMESPACE)


def absolute(namespace: str) -> str:
    """Return `namespace` with the slash that it begins with."""
    return namespace if namespace.startswith("/") else f"/{namespace}"


def node_name_fault(name: str) -> NameFault | None:
    """Return what is wrong with the name of a node, or None."""
    if not name:
        return NameFault("is empty", 0, "Write a name such as imu", id="MG-3041")
    if len(name) > LONGEST_NODE_NAME:
        message = f"is {len(name)} characters long; at most {LONGEST_NODE_NAME} are allowed"
        return NameFault(message, LONGEST_NODE_NAME, "Shorten it", id="MG-3042")
    return _character_fault(name, "") or _digit_fault(name, 0)


def _braces_fault(name: str) -> NameFault | None:
    rest = _SUBSTITUTION.sub(lambda m: "_" * len(m.group()), name)
    for match in _SUBSTITUTION.finditer(name):
        if match.group(1) not in SUBSTITUTIONS:
            message = f"has the substitution '{match.group()}', which ROS 2 does not define"
            return NameFault(message, match.start(), "Available: {node}, {ns} and {namespace}", id="MG-3043")
    index = next((i for i, c in enumerate(rest) if c in "{}"), None)
    return (
        None
        if index is None
        else NameFault("has an unmatched brace", index, "Write {node} or {ns}", id="MG-3044")
    )


def _shape_fault(name: str, allowed: str) -> NameFault | None:
    fault = _character_fault(name, allowed)
    if fault:
        return fault
    tilde = name.rfind("~")
    if tilde > 0:
        return NameFault(
            "has '~' after its first character",
            tilde,
            "'~' means the node, and only at the beginning",
            id="MG-3045",
        )
    if tilde == 0 and name[1:2] not in ("", "/"):
        return NameFault("needs a slash after '~'", 1, f"Write ~/{name[1:]}", id="MG-3046")
    if "//" in name:
        return NameFault("has two slashes in a row", name.index("//") + 1, "Remove one of them", id="MG-3047")
    if name.endswith("/"):
        return NameFault("ends with a slash", len(name) - 1, "Remove it", id="MG-3048")
    starts = (0, *(m.end() for m in re.finditer("/", name)))
    return next((fault for start in starts if (fault := _digit_fault(name, start))), None)


def _character_fault(name: str, allowed: str) -> NameFault | None:
    for index, character in enumerate(name):
        if not (character.isascii() and character.isalnum()) and character not in f"_{allowed}":
            corrected = re.sub(r"[-. ]", "_", name)
            hint = f"Write {corrected}. " if re.fullmatch(rf"[A-Za-z0-9_{allowed}]+", corrected) else ""
            hint += (
                "Letters a to z, digits, _"
                + (f" and {' '.join(allowed)}" if allowed else "")
                + " are allowed"
            )
            return NameFault(f"has the character '{character}'", index, hint, id="MG-3049")
    return None


def _digit_fault(name: str, start: int) -> NameFault | None:
    if name[start : start + 1].isdigit():
        return NameFault("has a part that begins with a digit", start, "Begin it with a letter", id="MG-3050")
    return None
