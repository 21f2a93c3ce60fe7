# SPDX-License-Identifier: Apache-2.0
"""Frames captured on a serial line of the public client and agent."""

from __future__ import annotations

CREATE_CLIENT_FRAME = (
    "7e 01 00 18 00 80 00 00 00 00 01 10 00 58 52 43 45 01 00 01 0f a1 7d 5e c3 7d 5d 81 00 fc 01 6a d6"
)
STATUS_AGENT_FRAME = "7e 00 01 13 00 81 00 00 00 04 01 0b 00 00 00 58 52 43 45 01 00 01 0f 00 00 ec"
