# SPDX-License-Identifier: Apache-2.0
"""The profiles that are ready."""

from __future__ import annotations

READY = (
    "pure_sender",
    "pure_reader",
    "configurable_sender_with_diagnostics",
    "ad_hoc_discoverable_sender",
    "static_configured_sender",
    "managed_service",
    "simulation_node",
)
