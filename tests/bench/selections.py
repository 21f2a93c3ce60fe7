# SPDX-License-Identifier: Apache-2.0
"""What each profile takes as it comes, and what each component and choice adds to pure_sender, on three processors."""

from __future__ import annotations

import subprocess
from dataclasses import dataclass

from tests.support.firmware.board import Builds, Built
from tests.support.firmware.footprint import Sections, bounded_stack, sections

PROFILES = ("pure_sender", "pure_reader", "static_configured_sender", "simulation_node")
"""The built-in ones with a serial line: ad_hoc_discoverable_sender needs UDP, whose port on a board is the user's."""
COMPONENTS = (
    "subscribe",
    "services",
    "executor",
    "timers",
    "clock",
    "clock_ros",
    "time_sync",
    "session_state",
    "sleep_cycles",
    "liveliness_hard",
    "micro_ros_utilities",
)
CHOICES = (
    "liveliness: acknack",
    "liveliness: none",
    "entities: xml",
    "entities: reference",
    "on_full: drop_oldest",
    "on_full: block 10 ms",
    "errors: text",
)


@dataclass(frozen=True)
class Selected:
    """A selection as built: its example, linked, with the proven stack; and the whole library, before a linker drops
    what the example does not use.
    """

    image: Sections
    stack: int
    library: Sections


def bench_selections(builds: Builds, boards: dict[str, str]) -> None:
    """Print a table of profiles, and one of what components and choices add."""
    print("  generated example of each profile, std_msgs/msg/Int32: text + data / RAM / proven stack")
    for profile in PROFILES:
        cells = []
        for board in boards:
            found = selected(builds, board, profile)
            cells.append(f"{found.image.text + found.image.data:,} / {found.image.ram:,} / {found.stack:,}")
        print(f"  {profile:30}" + "".join(f"{cell:>24}" for cell in cells))
    print(
        "  added to pure_sender: image text / RAM / stack; library text / RAM, all functions, before linking"
    )
    for more in (*(f"components: [+{name}]" for name in COMPONENTS), *CHOICES):
        cells = []
        for board in boards:
            without, found = (
                selected(builds, board, "pure_sender"),
                selected(builds, board, "pure_sender", more),
            )
            image, library = (
                difference(found.image, without.image),
                difference(found.library, without.library),
            )
            cells.append(f"{image} / {found.stack - without.stack:+,}; {library}")
        print(f"  {more.removeprefix('components: '):30}" + "".join(f"{cell:>44}" for cell in cells))


def selected(builds: Builds, board: str, profile: str, more: str = "") -> Selected:
    """Build and measure a profile with a line more in its application file; `errors: code` unless it says otherwise."""
    errors = "" if more.startswith("errors") else "errors: code\n"
    types = "std_msgs/msg/Int32" + (", std_srvs/srv/Empty" if "services" in more else "")
    built = builds.build(board, f"version: 1\nprofiles: [{profile}]\ninterfaces: [{types}]\n{errors}{more}\n")
    return Selected(sections(built), bounded_stack(built), library_sections(built))


def library_sections(built: Built) -> Sections:
    """Return what the tool chain's own `size` counts of the library."""
    command = [built.tool("size"), "-t", str(built.out / "lib" / "libmicroros.a")]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    text, data, bss = (int(word) for word in lines[-1].split()[:3])
    return Sections(text, data, bss)


def difference(found: Sections, without: Sections) -> str:
    """Return what is added: `+120 / -8`."""
    text = found.text + found.data - without.text - without.data
    return f"{text:+,} / {found.ram - without.ram:+,}"
