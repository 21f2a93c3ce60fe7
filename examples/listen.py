# SPDX-License-Identifier: Apache-2.0
"""An rclpy subscriber of any topic: prints each sample on a line."""

from __future__ import annotations

import argparse
import importlib
import sys
import time
from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.qos import qos_profile_sensor_data


def message_class(name: str) -> Any:
    """Return the Python class of pkg/msg/Type."""
    package, kind, type_name = name.split("/")
    return getattr(importlib.import_module(f"{package}.{kind}"), type_name)


def main() -> int:
    """Listen until Ctrl-C, or until enough samples came; 1 when they do not come in time."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("topic", help="/count")
    parser.add_argument("type", help="std_msgs/msg/Int32")
    parser.add_argument("--samples", type=int, help="end after so many")
    parser.add_argument("--timeout", type=float, default=60.0, help="seconds to wait for each sample")
    options = parser.parse_args()
    rclpy.init()
    node = rclpy.create_node("listener")
    samples: list[Any] = []
    node.create_subscription(
        message_class(options.type), options.topic, samples.append, qos_profile_sensor_data
    )
    end = time.monotonic() + options.timeout
    try:
        while options.samples is None or options.samples > 0:
            rclpy.spin_once(node, timeout_sec=0.1)
            if samples:
                print(f"{options.topic} {samples.pop()}", flush=True)
                options.samples = None if options.samples is None else options.samples - 1
                end = time.monotonic() + options.timeout
            elif time.monotonic() > end:
                print(f"nothing on {options.topic} in {options.timeout:g} s", file=sys.stderr)
                return 1
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    return 0


if __name__ == "__main__":
    sys.exit(main())
