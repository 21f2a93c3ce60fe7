# SPDX-License-Identifier: Apache-2.0
"""An ordinary rclpy process: what comes on /honest_up it says on /honest_down, both reliable, none of it forgotten."""

from __future__ import annotations


def main() -> None:
    """Echo until somebody ends the process."""
    import rclpy
    from rclpy.qos import HistoryPolicy, QoSProfile
    from std_msgs.msg import Int32

    rclpy.init()
    node = rclpy.create_node("honest_peer")
    everything = QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=1)
    answers = node.create_publisher(Int32, "honest_down", everything)
    node.create_subscription(Int32, "honest_up", answers.publish, everything, raw=True)
    print("echoing", flush=True)
    rclpy.spin(node)


if __name__ == "__main__":
    main()
