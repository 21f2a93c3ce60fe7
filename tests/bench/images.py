# SPDX-License-Identifier: Apache-2.0
"""What whole firmware images take, by what they do, on three processors; and each component's part of the largest."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from firmware.board import Builds, Built
from firmware.footprint import SERVES, Sections, Sender, image_sections
from firmware.test_everything import APPLICATION as EVERYTHING
from firmware.test_executor import APPLICATION as TICKS
from firmware.test_executor import LISTENS

PROCESSORS = {"qemu-microbit": "Cortex-M0", "qemu-mps2-an386": "Cortex-M4", "qemu-mps2-an505": "Cortex-M33"}
READER = """\
version: 1
profiles: [pure_reader]
errors: code
nodes: [{name: listener, subscriptions: [{topic: numbers, type: std_msgs/msg/Int32}]}]
"""
ASKS = (
    SERVES.replace("[pure_reader]", "[pure_sender]")
    .replace("-subscribe", "-publish")
    .replace("services: [", "clients: [")
)
JOINTS = """\
version: 1
profiles: [pure_sender]
errors: code
nodes: [{name: arm, publishers: [{topic: joint_states, type: sensor_msgs/msg/JointState}]}]
limits:
  sensor_msgs/msg/JointState:
    {header: {frame_id: 16}, name: {sequence: 6, string: 16}, position: 6, velocity: 6, effort: 6}
"""
BOTH = TICKS.replace("[pure_sender]", "[pure_sender, pure_reader]") % "" + LISTENS
IMAGES = (
    ("1 publisher of Int32", Sender().application, "", "48,164 + 700 / 9,860"),
    ("subscription of Int32", READER, "", ""),
    ("publisher, timer, executor", TICKS % "", "ticker.c", ""),
    ("2 publisher, subscription, timer, executor", BOTH, "ticker.c", "64,600 + 700 / 10,240"),
    ("3 server of SetBool, executor", SERVES, "setbool.c", "66,624 + 4,616 / 14,464"),
    ("client of SetBool", ASKS, "", ""),
    ("6 publisher of JointState, 6 joints", JOINTS, "", "54,340 + 3,604 / 13,048"),
    (
        "two publishers, subscription, server, client, timer",
        f"{EVERYTHING}errors: code\n",
        "everything.c",
        "",
    ),
)
"""Label, application file, source below tests/firmware/c (none: the example), figures of the existing stack."""


def bench_images(folder: Path) -> None:
    """Print one line an image, and the components of the last one's library on the Cortex-M4."""
    builds = Builds(folder)
    print(
        "images: linked, serial line, storage, start-up and driver included, `errors: code`; text + data / RAM, bytes"
    )
    print(
        f"  {'':52}"
        + "".join(f"{name:>16}" for name in PROCESSORS.values())
        + "   existing stack, M4 (recorded)"
    )
    for label, application, source, existing in IMAGES:
        cells = []
        for board in PROCESSORS:
            built = builds.build(board, application)
            size = sections_of(builds, built, source, application)
            cells.append(f"{size.text + size.data:,} / {size.ram:,}")
        print(f"  {label:52}" + "".join(f"{cell:>16}" for cell in cells) + f"   {existing}")
    print("  components of the generated example of the last image: flash / RAM")
    columns = [dict(components(builds.build(board, IMAGES[-1][1]))) for board in PROCESSORS]
    for name in sorted(set().union(*columns)):
        print(f"  {name:52}" + "".join(f"{column.get(name, ''):>16}" for column in columns))
    print()


def sections_of(builds: Builds, built: Built, source: str, application: str) -> Sections:
    """Return the sizes of the example, or of a source of tests/firmware/c linked with the library."""
    if not source:
        return image_sections(built, built.image)
    flags = ["-DTICKER_LISTENS"] if source == "ticker.c" and application == BOTH else []
    return image_sections(built, builds.application(built, source, *flags))


def components(built: Built) -> Iterator[tuple[str, str]]:
    """Yield each component of the linked example with its bytes."""
    command = [sys.executable, "-m", "microros_gen", "size", str(built.out), "--format", "json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    for entry in json.loads(done.stdout)["owners"]:
        if entry["group"] == "component":
            yield entry["name"], f"{entry['flash']:,} / {entry['ram']:,}"
