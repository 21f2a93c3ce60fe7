# SPDX-License-Identifier: Apache-2.0
"""ROS domains in which clients may be."""

from __future__ import annotations

import os

DOMAIN_OF_AGENT = 255
"""Clients that request this domain (a convention of the public client) get the agent's own, ROS_DOMAIN_ID."""


def own_domain() -> int:
    """Return the domain of this process: ROS_DOMAIN_ID, otherwise 0."""
    text = os.environ.get("ROS_DOMAIN_ID", "0").strip() or "0"
    return int(text) if text.isascii() and text.isdigit() else 0
