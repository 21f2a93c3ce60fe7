# SPDX-License-Identifier: Apache-2.0
"""The stream on which entities are created, where the application does not say."""

from __future__ import annotations

from dataclasses import replace

from microros_gen.application.model import Application
from microros_gen.documents.named import Named

_SMALL_MESSAGES = ("canfd",)
"""Transports whose messages are smaller than most requests to create, which a reliable stream sends in fragments."""
_LONG_REQUESTS = ("binary", "xml")


def with_creation(application: Application, transport: str, entities: str) -> Application:
    """Return the application with `creation: reliable`, where it has none and its requests need fragments.

    `transport` and `entities` are the chosen values. A reference is short: it stays on the best-effort stream.
    """
    if application.creation is None and transport in _SMALL_MESSAGES and entities in _LONG_REQUESTS:
        return replace(application, creation=Named("reliable", application.transport.type_span))
    return application
