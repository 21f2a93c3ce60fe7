# SPDX-License-Identifier: Apache-2.0
"""The type hashes that clients were generated with, from their manifests."""

from __future__ import annotations

from collections.abc import Mapping

from microros_gen.agent.ros.bridge import HashOf


class Manifests:
    """Type hashes by client: its key (`0xA1B2C3D4`) or the full name of its node (`/ns/node`)."""

    def __init__(self, hashes: Mapping[str, Mapping[str, str]] | None = None) -> None:
        """Take the types of each client as `pkg/msg/Type`, with their hashes (RIHS01_…, REP-2011)."""
        self._hashes = {_client(name): types for name, types in (hashes or {}).items()}

    def hash_of(self, key: bytes, node: str) -> HashOf | None:
        """Return a function from types to hashes for a client; None if it has no manifest.

        `node` is the name of its node, `node` or `namespace/node`. A manifest for the key precedes one for the node.
        """
        types = self._hashes.get(key.hex())
        if types is None:
            types = self._hashes.get("/" + node.strip("/"))
        return None if types is None else types.get


def _client(name: str) -> str:
    if name[:2] in ("0x", "0X"):
        return f"{int(name, 16):08x}"
    return "/" + name.strip("/")
