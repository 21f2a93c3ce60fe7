# SPDX-License-Identifier: Apache-2.0
"""What whole firmware images take, by what they do, on three processors; and each component's part of the largest."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.bench.selections import bench_selections
from tests.support.firmware.actions import CLIENT, SERVER
from tests.support.firmware.board import Builds, Built
from tests.support.firmware.diagnosis import APPLICATION as DIAGNOSED
from tests.support.firmware.everything import APPLICATION as EVERYTHING
from tests.support.firmware.footprint import SERVES, Sender, bounded_stack, image_sections
from tests.support.firmware.lifecycle import APPLICATION as LIFE_CYCLE
from tests.support.firmware.observed import APPLICATION as OBSERVED
from tests.support.firmware.parameters import ADDED
from tests.support.firmware.parameters import APPLICATION as PARAMETERS
from tests.support.firmware.ticker import APPLICATION as TICKS
from tests.support.firmware.ticker import LISTENS

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


@dataclass(frozen=True)
class Image:
    """An application file with a source below tests/firmware/c (none: the example), its flags, and what the existing
    stack takes for the same: flash, static RAM with heap, measured stack (recorded).
    """

    label: str
    application: str
    source: str = ""
    flags: tuple[str, ...] = ()
    existing: str = ""

    def linked(self, builds: Builds, built: Built) -> Path:
        """Return the example, or the source linked with the library of `built`."""
        return builds.application(built, self.source, *self.flags) if self.source else built.image


IMAGES = (
    Image("1 publisher of Int32", Sender().application, existing="48,164 + 700 / 9,860, 1,848"),
    Image("subscription of Int32", READER),
    Image("publisher, timer, executor", TICKS % "", "ticker.c"),
    Image(
        "2 publisher, subscription, timer, executor",
        BOTH,
        "ticker.c",
        ("-DTICKER_LISTENS",),
        "64,600 + 700 / 10,240, 2,024",
    ),
    Image("3 server of SetBool, executor", SERVES, "setbool.c", (), "66,624 + 4,616 / 14,464, 1,560"),
    Image("client of SetBool", ASKS),
    Image(
        "4 parameter server: four parameters, six services, executor",
        PARAMETERS,
        "parameters.c",
        (),
        "112,304 + 30,376 / 16,120 + 8,545 of heap, 1,808",
    ),
    Image("the same, the program adds them as sources for rclc do", PARAMETERS, "parameters.c", ADDED),
    Image(
        "5 node with a life cycle: five services, events, executor",
        LIFE_CYCLE,
        "lifecycle.c",
        (),
        "89,776 / 34,640",
    ),
    Image("6 publisher of JointState, 6 joints", JOINTS, existing="54,340 + 3,604 / 13,048"),
    Image("the same with a history of two", f"{JOINTS}pools: {{history: 2}}\n"),
    Image("action server of Fibonacci, two goals, executor", SERVER, "actions.c"),
    Image("action client of Fibonacci, two goals, executor", CLIENT, "action_client.c"),
    Image("diagnosis with a check and a callback, timer, executor", DIAGNOSED, "diagnosis.c"),
    Image("publisher with events, transforms, time of the agent", OBSERVED, "observed.c"),
    Image(
        "two publishers, subscription, server, client, timer on ROS time",
        f"{EVERYTHING}errors: code\n",
        "everything.c",
    ),
)


def bench_images(folder: Path) -> None:
    """Print one line an image, the components of the last one's library, and what profiles and components take."""
    builds = Builds(folder)
    print("images: linked, serial line, start-up, driver and all storage included, `errors: code`; bytes:")
    print("  text + data / RAM without the stack / worst stack that `size` proves, every interrupt on top")
    head = "".join(f"{name:>24}" for name in PROCESSORS.values())
    print(f"  {'':52}{head}   existing stack, M4 (recorded; stack measured)")
    for image in IMAGES:
        cells = []
        for board in PROCESSORS:
            built = builds.build(board, image.application)
            linked = image.linked(builds, built)
            size = image_sections(built, linked)
            cells.append(f"{size.text + size.data:,} / {size.ram:,} / {bounded_stack(built, linked):,}")
        print(f"  {image.label:52}" + "".join(f"{cell:>24}" for cell in cells) + f"   {image.existing}")
    print("  components of the generated example of the last image: flash / RAM")
    columns = [dict(components(builds.build(board, IMAGES[-1].application))) for board in PROCESSORS]
    for name in sorted(set().union(*columns)):
        print(f"  {name:52}" + "".join(f"{column.get(name, ''):>24}" for column in columns))
    bench_selections(builds, PROCESSORS)
    print()


def components(built: Built) -> Iterator[tuple[str, str]]:
    """Yield each component of the linked example with its bytes."""
    command = [sys.executable, "-m", "microros_gen", "size", str(built.out), "--format", "json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    for entry in json.loads(done.stdout)["owners"]:
        if entry["group"] == "component":
            yield entry["name"], f"{entry['flash']:,} / {entry['ram']:,}"
