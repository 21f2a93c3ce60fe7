# SPDX-License-Identifier: Apache-2.0
"""The file of entities that the agent makes by itself."""

from __future__ import annotations

from typing import Any

KEY = "0xA1B2C3D4"


def objects() -> list[dict[str, Any]]:
    return [
        {"id": "0x0001", "kind": "participant", "name": "imu", "domain": 7},
        {
            "id": "0x0002",
            "kind": "topic",
            "parent": "0x0001",
            "name": "rt/count",
            "type": "std_msgs::msg::dds_::Int32_",
        },
        {"id": "0x0003", "kind": "publisher", "parent": "0x0001"},
        {
            "id": "0x0005",
            "kind": "data_writer",
            "parent": "0x0003",
            "topic": "0x0002",
            "reliability": "best_effort",
            "durability": "transient_local",
            "history": "keep_last",
            "depth": 3,
        },
    ]


def content(key: str = KEY, **more: Any) -> dict[str, Any]:
    return {"version": 1, "clients": [{"key": key, "objects": objects(), **more}]}
