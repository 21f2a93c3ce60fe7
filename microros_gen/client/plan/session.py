# SPDX-License-Identifier: Apache-2.0
"""The client's session: its key and what it takes part in."""

from __future__ import annotations

import hashlib

from microros_gen.application.model import Application
from microros_gen.client.plan.slices import SessionPlan
from microros_gen.interfaces.dds_names import participant_name
from microros_gen.platform.target import Target
from microros_gen.selection.model import Selection

SESSION_ID = 0x81
DEFAULT_SILENCE_MS = 10_000
"""Of the component liveliness_hard without `session.hard_liveliness`; the public client has the same."""


def plan_session(application: Application, selection: Selection, target: Target, name: str) -> SessionPlan:
    """Plan the session of the image `name`."""
    return SessionPlan(
        id=SESSION_ID,
        client_key=_client_key(application, selection, target, name),
        multithread=selection.has("multithread"),
        hard_liveliness_ms=_hard_liveliness(application, selection),
        has_state=selection.has("session_state"),
        has_sleep=selection.has("sleep_cycles"),
        has_time_sync=selection.has("time_sync"),
    )


def _client_key(application: Application, selection: Selection, target: Target, name: str) -> int | None:
    """Return the fixed key, or None where the port supplies it: no two devices share that one.

    The key is fixed where the file names it, where the agent knows the client by it (`entities: preconfigured`), and
    where the target has no unique id (`plan_board` warns). Then it follows from the application, so that
    different applications do not take each other's session.
    """
    if isinstance(application.session_key, str):
        return None
    if application.session_key is not None:
        return application.session_key
    if target.has_unique_id and selection.entities != "preconfigured":
        return None
    text = "/".join([name, *(participant_name(n.name, n.namespace) for n in application.nodes)])
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "big") or 1


def _hard_liveliness(application: Application, selection: Selection) -> int:
    requested = application.hard_liveliness_ms
    return requested or (DEFAULT_SILENCE_MS if selection.has("liveliness_hard") else 0)
