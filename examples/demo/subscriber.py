# SPDX-License-Identifier: Apache-2.0
"""An ordinary rclpy subscriber: prints what arrives from the firmware, then rate and latency."""

from __future__ import annotations

import argparse
import statistics
import sys
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Imu
from std_msgs.msg import Int32


class Listener(Node):
    """Counts and prints the samples of both topics."""

    def __init__(self, wanted: int) -> None:
        super().__init__("demo_listener")
        self.wanted = wanted
        self.arrivals: list[float] = []
        self.latencies: list[float] = []
        self.counts: list[int] = []
        self.create_subscription(Imu, "imu/data", self.on_imu, qos_profile_sensor_data)
        self.create_subscription(Int32, "count", self.on_count, 10)

    def on_imu(self, message: Imu) -> None:
        """Print the fields; take arrival time and, from the stamp, latency."""
        now = time.time()
        stamp = message.header.stamp
        self.arrivals.append(time.monotonic())
        self.latencies.append(now - (stamp.sec + stamp.nanosec * 1e-9))
        turn, rate, acceleration = message.orientation, message.angular_velocity, message.linear_acceleration
        print(
            f"received /imu/data  stamp={stamp.sec}.{stamp.nanosec:09d} frame_id='{message.header.frame_id}'"
            f" orientation=({turn.x:.2f}, {turn.y:.2f}, {turn.z:.2f}, {turn.w:.2f})"
            f" angular_velocity=({rate.x:.2f}, {rate.y:.2f}, {rate.z:.2f})"
            f" linear_acceleration=({acceleration.x:.2f}, {acceleration.y:.2f}, {acceleration.z:.2f})",
            flush=True,
        )

    def on_count(self, message: Int32) -> None:
        """Print the counter."""
        self.counts.append(message.data)
        print(f"received /count     data={message.data}", flush=True)

    def done(self) -> bool:
        """Return whether enough samples of both topics came."""
        return min(len(self.arrivals), len(self.counts)) >= self.wanted


def main() -> int:
    """Listen until enough samples came; 1 when they do not come in time."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=20)
    parser.add_argument("--timeout", type=float, default=20.0, help="seconds")
    options = parser.parse_args()
    rclpy.init()
    listener = Listener(options.samples)
    print("listener ready", flush=True)
    end = time.monotonic() + options.timeout
    try:
        while not listener.done() and time.monotonic() < end:
            rclpy.spin_once(listener, timeout_sec=0.1)
    except (KeyboardInterrupt, ExternalShutdownException):
        return 130
    if not listener.done():
        print(
            f"listener: {len(listener.arrivals)} samples on /imu/data and {len(listener.counts)} on /count came"
            f" within {options.timeout:.0f} s, {options.samples} of each were expected",
            file=sys.stderr,
        )
        return 1
    span = listener.arrivals[-1] - listener.arrivals[0]
    lost = listener.counts[-1] - listener.counts[0] + 1 - len(listener.counts)
    latency_ms = [1e3 * value for value in sorted(listener.latencies)]
    print(f"rate     {(len(listener.arrivals) - 1) / span:.1f} samples/s on /imu/data, {lost} lost on /count")
    print(
        f"latency  median {statistics.median(latency_ms):.2f} ms, worst {latency_ms[-1]:.2f} ms"
        " from the stamp in the firmware to the rclpy callback",
        flush=True,
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
