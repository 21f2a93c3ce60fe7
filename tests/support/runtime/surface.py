# SPDX-License-Identifier: Apache-2.0
"""The application whose headers have the whole API."""

from __future__ import annotations

from pathlib import Path

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from microros_gen.selection.find_components import load_catalogue
from tests.support.runtime.harness import Tree

EVERYTHING = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+timers, +executor, +clock, +time_sync, +micro_ros_utilities, +cdr_decode, +discovery,
  +new_data_callbacks, +qos_events, +continuous_serialization, +loaned_messages{more}]
logging: console
interfaces: [std_msgs/msg/Int32, std_msgs/msg/String{types}]
limits: {{'*': {{string: 16, sequence: 4}}}}
transport: {{type: {transport}}}
"""
PLANNED = {h for c in load_catalogue().values() if not c.ready for h in c.headers} - {
    h for c in load_catalogue().values() if c.ready for h in c.headers
}
SERVICES = "rcl/service.h" not in PLANNED


def generate(folder: Path, transport: str) -> Tree:
    """Write an application that has every component that is ready, over one transport."""
    more = (", +services", ", example_interfaces/srv/AddTwoInts") if SERVICES else ("", "")
    text = EVERYTHING.format(more=more[0], types=more[1], transport=transport)
    if transport != "udp":
        text = text.replace(", +discovery", "")
    return write_application(folder, text)


def write_application(folder: Path, text: str) -> Tree:
    """Write what an application file selects."""
    folder.mkdir()
    (folder / "microros.yaml").write_text(text, encoding="utf-8")
    options = compiler.Options(config=folder / "microros.yaml", interface_paths=(shipped_folder(),))
    out = compiler.generate(options, folder / "out").out
    return Tree(out, tuple(sorted((out / "src").rglob("*.c"))))
