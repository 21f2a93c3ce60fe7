# SPDX-License-Identifier: Apache-2.0
"""What a sender of one Int32 takes on each board in QEMU: flash, RAM, stack, instructions."""

from __future__ import annotations

from pathlib import Path

from tests.support.firmware.board import BOARDS, Builds
from tests.support.firmware.footprint import (
    LIKE_FOR_LIKE,
    MODES,
    RELIABILITIES,
    SERVES,
    Sender,
    bounded_stack,
    buffers,
    image_sections,
    measured_stack,
    sections,
    work,
)

CORTEX_M4 = "qemu-mps2-an386"
HEAD = f"{'':46} {'text':>6} {'data':>5} {'bss':>6} {'stack':>6} {'bound':>6} {'ready':>6} {'first':>6} {'publish':>8}"
EXISTING = (
    # Recorded (docs/verification/figures.md): Cortex-M4, -Os, tightest settings.
    ("existing stack: sender of Int32, heap 632 besides", 48164, 700, 9160, 1848, 40800, 3175),
    ("existing bare XRCE client, no ROS API", 18072, 0, 4968, 1544, 19800, 2930),
    ("goal, planned", 9000, 0, 1500, 700, 12000, 600),
)


SERVICES = (("server of SetBool, executor, errors: code", SERVES, "setbool.c"),)
"""Label, application file, C source below tests/firmware/c; the goal is 15,000 and 3,000."""


def bench_footprint(folder: Path) -> None:
    """Print one table for the Cortex-M4 with its peers, and one for each board."""
    builds = Builds(folder)
    print("footprint: a sender of std_msgs/msg/Int32, linked image that publishes in QEMU, serial line")
    print(
        "  bytes; stack: measured, and proven by `microros-gen size`; instructions: of the client alone, with an"
    )
    print(
        "  agent that answers at once; publish: with room in the stream, the last answer of the agent taken in"
    )
    print(HEAD)
    for name, text, data, bss, stack, ready, publish in EXISTING:
        print(f"{name:<46} {text:6} {data:5} {bss:6} {stack:6} {'':6} {ready:6} {'':6} {publish:8}")
    print("  (the rows above are recorded figures, not of this run)")
    for sender in (Sender(), Sender(errors="text"), LIKE_FOR_LIKE):
        row(builds, CORTEX_M4, sender)
    print(
        f"  like for like: of its RAM {buffers(builds.build(CORTEX_M4, LIKE_FOR_LIKE.application))} are buffers"
    )
    for label, application, source in SERVICES:
        size = image_sections(builds.build(CORTEX_M4, application), _image(builds, application, source))
        print(f"  {label:<44} {size.text:6} {size.data:5} {size.bss:6}")
    print("  static_configured_sender with the same `entities:` is the same image: shown for the Cortex-M4")
    for name in BOARDS:
        print(name)
        for profile in ("pure_sender", "static_configured_sender") if name == CORTEX_M4 else ("pure_sender",):
            for mode in MODES:
                for reliability in RELIABILITIES:
                    row(builds, name, Sender(mode, reliability, profile=profile))
    print()


def _image(builds: Builds, application: str, source: str) -> Path:
    return builds.application(builds.build(CORTEX_M4, application), source)


def row(builds: Builds, name: str, sender: Sender) -> None:
    """Print a line of the table."""
    built = builds.build(name, sender.application)
    size, done = sections(built), work(builds, name, sender)
    print(
        f"  {sender.label:<44} {size.text:6} {size.data:5} {size.bss:6} {measured_stack(built):6}"
        f" {bounded_stack(built):6} {done.ready:6} {done.first_publish:6} {done.publish:8}"
    )
