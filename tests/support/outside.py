# SPDX-License-Identifier: Apache-2.0
"""Components, profiles and parts of platforms from outside the package, as folders that tests write."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

COMPONENT = """\
component: beacon
summary: "Counts what the application shows"
layer: middleware
status: ready
needs: [publish]
asks: [time]
headers: [beacon/beacon.h]
sources: [beacon.c, beacon_text.c.j2]
"""
BEACON = {
    "component.yaml": COMPONENT,
    "include/beacon/beacon.h": (
        "#ifndef BEACON__BEACON_H_\n#define BEACON__BEACON_H_\n\n#include <stdint.h>\n\n"
        "uint32_t beacon_shown(void);\nconst char * beacon_text(void);\n\n#endif\n"
    ),
    "src/beacon.c": (
        '#include "beacon/beacon.h"\n\n#include "microros/port.h"\n\n'
        "uint32_t beacon_shown(void)\n{\n  return port_time_ms();\n}\n"
    ),
    "src/beacon_text.c.j2": (
        '#include "beacon/beacon.h"\n\n'
        'const char * beacon_text(void)\n{\n  return "{{ selection.name }}";\n}\n'
    ),
}
PROFILE = (
    'profile: lighthouse\nsummary: "Sends, and shows it"\nextends: [pure_sender]\ncomponents: [beacon]\n'
)
PART = """\
component: port_rock
summary: "A made-up system"
layer: port
status: ready
needs: [support]
provides:
  time: {sources: [port_rock_time.c], always: true}
"""
TARGETS = {
    "targets/crag.yaml": "target: crag\nsummary: Made up\nextends: _family\n",
    "targets/_family.yaml": "target: family\nsummary: Made up\nextends: cortex-m4\nc_flags: [-DCRAG=1]\n",
}
PACKAGE = {
    **TARGETS,
    **{f"components/beacon/{name}": text for name, text in BEACON.items()},
    "profiles/lighthouse.yaml": PROFILE,
    "platform/os/rock/component.yaml": PART,
    "platform/os/rock/src/port_rock_time.c": (
        '#include "microros/port.h"\n\nuint32_t port_time_ms(void)\n{\n  return 0;\n}\n'
    ),
}


def write_files(folder: Path, files: Mapping[str, str]) -> Path:
    """Write `files` below `folder`, and return that."""
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


def install_with_pip(site: Path, package: str = "robot_parts") -> None:
    """Write to `site`, a folder of sys.path, what pip installs of a package that brings PACKAGE."""
    write_files(site / package, {"__init__.py": 'raise AssertionError("nobody imports it")\n', **PACKAGE})
    entry = f"[microros_gen.components]\nparts = {package}\n"
    metadata = f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n"
    write_files(site / f"{package}-1.0.dist-info", {"entry_points.txt": entry, "METADATA": metadata})


def install_with_ament(prefix: Path, package: str = "robot_parts", below: str = "") -> None:
    """Write to `prefix` what ament installs of a package that brings PACKAGE."""
    index = prefix / "share" / "ament_index" / "resource_index" / "microros_gen_components"
    write_files(index, {package: f"{below}\n" if below else ""})
    write_files(prefix / (below or f"share/{package}"), PACKAGE)
