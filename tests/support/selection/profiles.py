# SPDX-License-Identifier: Apache-2.0
"""The profiles of D1.4, 4.10.3.1: what the files of `profiles/` are compared with."""

from __future__ import annotations

BUILTIN_PROFILES = (
    "pure_sender",
    "pure_reader",
    "configurable_sender_with_diagnostics",
    "ad_hoc_discoverable_sender",
    "static_configured_sender",
    "managed_service",
    "simulation_node",
)
"""The seven profiles, in its order."""

ALL_PROFILES = (*BUILTIN_PROFILES, "pure_action_server")
"""Those of the tool: D1.4 has no profile for actions."""
