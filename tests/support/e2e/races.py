# SPDX-License-Identifier: Apache-2.0
"""Programs that together have all components but those in ELSEWHERE, driven by several tasks (tests/e2e/c/races.c).

A program is the generated example of an application. What a new component adds to examples is in it when the component
is named below.
"""

from __future__ import annotations

import re
import socket
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from tests.support.components.rendered import planned
from tests.support.runtime.harness import SANITIZER, Tree, compile_merged, link

UNIT = Path(__file__).parents[2] / "e2e" / "c" / "races.c"
THREADS = ("-std=gnu99", "-g", "-O1", "-fsanitize=thread")
MEMORY = ("-std=gnu99", "-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")

_HEAD = """\
version: 1
profiles: [pure_sender, pure_reader, managed_service, simulation_node]
components: [{components}]
memory: {{arena: 16384}}
pools: {{guard_conditions: 4, wait_sets: 2, history: 16}}
limits: {{"*": {{string: 20, sequence: 4}}}}
clock: ros
logging:
  - {{to: console, level: debug}}
  - {{to: callback, level: debug}}
  - {{to: rosout, level: info}}
  - {{to: ring, level: warn}}
tasks:
  - {{name: control, executor: fast, rate: 100 Hz, overrun: call}}
  - {{name: worker, executor: slow, interval: 1 ms}}
watchdog: {{margin: 500 ms}}
diagnosis:
  checks: [{{name: battery, below: {{error: 11000}}, mode: SLOW}}]
  callbacks: [{{name: beat, limit: 2 ms}}, {{name: other}}]
"""
_NODE = """\
nodes:
  - name: own
    publishers:
      - {topic: count, type: std_msgs/msg/Int32, local: also}
      - {topic: fast, type: std_msgs/msg/Int32, qos: {deadline: 200 ms, reliability: best_effort}}
      - {topic: large, type: std_msgs/msg/String, limits: {string: 3000}}
      - {topic: huge, type: std_msgs/msg/String}
      - {topic: state, type: std_msgs/msg/UInt8, managed: true}
PEER_PUBLISHERS
    subscriptions:
      - {topic: count, type: std_msgs/msg/Int32, local: only, queue: 8, qos: {depth: 8}}
      - {topic: target, type: std_msgs/msg/Int32, on_silence: {after: 300 ms, call: stop_motors}}
      - {topic: plain, type: std_msgs/msg/String, queue: 4}
      - {topic: text, type: std_msgs/msg/String, queue: 4, limits: {string: 2000}}
PEER_SUBSCRIPTIONS
    services:
      - {name: add, type: example_interfaces/srv/AddTwoInts, queue: 2}
      - {name: inside, type: std_srvs/srv/Trigger, local: only, queue: 2}
PEER_SERVICES
    clients:
      - {name: /ros/add, type: example_interfaces/srv/AddTwoInts}
      - {name: /ros/sum, type: example_interfaces/srv/AddTwoInts, queue: 8}
      - {name: inside, type: std_srvs/srv/Trigger, local: only}
PEER_CLIENTS
    timers:
      - {name: beat, period: 20 ms}
      - {name: kernel, period: 30 ms, kind: rtos}
      - {name: managed, period: 25 ms, managed: true}
    parameters:
PARAMETERS
    modes: {__DEFAULT__: {on: $(parent on)}, SLOW: {speed: 0.25}, FAST: {speed: 2.0, on: true}}
    actions: [{name: walk, type: test_msgs/action/Fibonacci, goals: 2, waiting: 2}]
    action_clients: [{name: /ros/walk, type: test_msgs/action/Fibonacci, goals: 2}]
    parameter_clients:
      - node: /motor
        elements: 3
        operations: [get, set, set_atomically, list, describe, get_types, watch]
    executors:
      - {name: fast, handles: [beat]}
      - {name: slow}
"""
_PEER = {
    "PEER_PUBLISHERS": "      - {topic: /peer/out, type: std_msgs/msg/Int32, peer: only}",
    "PEER_SUBSCRIPTIONS": "      - {topic: /peer/in, type: std_msgs/msg/Int32, peer: only, queue: 4, qos: {depth: 4}}",
    "PEER_SERVICES": "      - {name: /peer/count, type: std_srvs/srv/Trigger, peer: only, queue: 4}",
    "PEER_CLIENTS": "      - {name: /peer/reset, type: std_srvs/srv/Trigger, peer: only}",
}
_PARAMETERS = (
    "{name: speed, type: double}",
    "{name: on, type: bool}",
    "{name: label, type: string, default: left}",
)
_COMMON = (
    "action_client",
    "action_server",
    "clock_stamp",
    "continuous_serialization",
    "diagnosis",
    "executor_nodes",
    "lifecycle",
    "logger_services",
    "logging_float",
    "logging_wide",
    "micro_ros_utilities",
    "multithread",
    "name_substitutions",
    "new_data_callbacks",
    "node_modes",
    "parameter_client",
    "publish_statistics",
    "qos_events",
    "service_call",
    "session_state",
    "tf_broadcaster",
    "time_source",
    "timers",
)
_SYSTEM = """\
version: 1
boards: {{own: {{application: microros.yaml}}, other: {{application: other.yaml}}}}
links:
  - {{type: udp, ends: {{own: "127.0.0.1:{own}", other: "127.0.0.1:{other}"}}}}
"""
_OTHER = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+services, +executor]
system: {file: system.yaml, board: other}
limits: {"*": {string: 20, sequence: 4}}
nodes:
  - name: other
    publishers: [{topic: /peer/in, type: std_msgs/msg/Int32, peer: only}]
    subscriptions: [{topic: /peer/out, type: std_msgs/msg/Int32, peer: only, queue: 4, qos: {depth: 4}}]
    services: [{name: /peer/reset, type: std_srvs/srv/Trigger, peer: only, queue: 4}]
    clients: [{name: /peer/count, type: std_srvs/srv/Trigger, peer: only}]
"""


def _head(*more: str) -> str:
    return _HEAD.format(components=", ".join(f"+{name}" for name in (*_COMMON, *more)))


def _node(texts: Mapping[str, str], parameters: str) -> str:
    text = _NODE.replace("PARAMETERS", parameters)
    for name in _PEER:
        text = text.replace(f"{name}\n", f"{texts[name]}\n" if texts else "")
    return text


_ON_DEVICE = "\n".join(f"      - {line}" for line in _PARAMETERS)
_AT_AGENT = "\n".join(["      at: agent", "      declare:", *(f"        - {line}" for line in _PARAMETERS)])
APPLICATIONS: Mapping[str, str] = MappingProxyType(
    {
        "udp": _head("graph_events", "loaned_messages", "parameter_storage", "ping")
        + "system: {file: system.yaml, board: own}\nsession: {key: 7, hard_liveliness: 10 s}\n"
        + "transport: {agents: ['127.0.0.1:FIRST', '127.0.0.1:SECOND']}\n"
        + _node(_PEER, _ON_DEVICE),
        "tcp": _head("graph_topic")
        + "session: {key: 7}\nliveliness: acknack\nentities: xml\n"
        + "transport: {type: tcp, agent: '127.0.0.1:FIRST'}\n"
        + _node({}, _AT_AGENT).replace("deadline: 200 ms, ", ""),
    }
)
"""Applications by name; FIRST and SECOND are ports of agents."""

ELSEWHERE: Mapping[str, str] = MappingProxyType(
    {
        "seal": "needs Mbed TLS; called with the lock of the library, as every transport is: tests/e2e/test_seal.py",
        "discovery": "in place of addresses of agents; not run under ThreadSanitizer",
        "entities_preconfigured": "in place of entities_xml and _binary; not run under ThreadSanitizer",
        "entities_reference": "in place of entities_xml and _binary; not run under ThreadSanitizer",
        "framing": "of serial lines and custom transports; tests/runtime/test_threads.py",
        "sleep_cycles": "no task runs while the device sleeps",
        "transport_canfd": "needs a CAN bus of the system; not run under ThreadSanitizer",
        "transport_custom": "its functions are the application's; tests/runtime/test_threads.py",
        "transport_serial": "needs a line; not run under ThreadSanitizer",
    }
)
"""Components in none of them, and why."""


def free_ports(count: int, kind: socket.SocketKind = socket.SOCK_DGRAM) -> list[int]:
    """Return ports that nobody uses now."""
    sockets = [socket.socket(socket.AF_INET, kind) for _ in range(count)]
    for port in sockets:
        port.bind(("127.0.0.1", 0))
    ports = [port.getsockname()[1] for port in sockets]
    for port in sockets:
        port.close()
    return ports


def selected(folder: Path, name: str) -> frozenset[str]:
    """Return the components of the program `name`."""
    _write(folder, name, [1, 2])
    found = planned(folder, (folder / "microros.yaml").read_text())
    return frozenset(chosen.component.name for chosen in found.project.selection.components)


def _write(folder: Path, name: str, agents: Sequence[int]) -> None:
    """Write the application `name`, and what it refers to."""
    text = APPLICATIONS[name].replace("FIRST", str(agents[0])).replace("SECOND", str(agents[-1]))
    own, other = free_ports(2)
    (folder / "microros.yaml").write_text(text)
    (folder / "system.yaml").write_text(_SYSTEM.format(own=own, other=other))
    (folder / "other.yaml").write_text(_OTHER)


def _generate(config: Path, out: Path) -> Path:
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),))
    return compiler.generate(options, out).out


def _definitions(out: Path, main: Path) -> tuple[str, ...]:
    """Return macros for the components of an output, and for the variables of the example's entities."""
    init = re.compile(
        r"rclc_(publisher|subscription|client|service)_init\w*\(\s*&(\w+), &\w+,[^;]*?\"([^\"]+)\""
    )
    entities = (
        (kind.upper(), re.sub(r"\W+", "_", topic).strip("_"), variable)
        for kind, variable, topic in init.findall(main.read_text())
    )
    return (
        f'-DRACES_EXAMPLE="{main}"',
        *(f"-DRACES_{folder.name.upper()}" for folder in sorted((out / "src").iterdir())),
        *(f"-D{kind}_{topic}={variable}" for kind, topic, variable in entities),
    )


def build_program(folder: Path, name: str, agents: Sequence[int], flags: tuple[str, ...]) -> Path:
    """Build the program `name` for agents at these ports."""
    _write(folder, name, agents)
    out = _generate(folder / "microros.yaml", folder / "out")
    (main,) = out.glob("examples/*/main.c")
    tree, sources = Tree(out, ()), sorted((out / "src").rglob("*.c"))
    objects = compile_merged(tree, sources, (), SANITIZER, flags)
    own = (*flags, *_definitions(out, main), f"-I{main.parent}")
    objects += compile_merged(tree, (), [UNIT], SANITIZER, own)
    return link(objects, SANITIZER, (*flags, "-pthread"), folder / "program")


def build_other(folder: Path, by: str, flags: tuple[str, ...]) -> Path:
    """Build the example of the other board of the link."""
    out = _generate(folder / "other.yaml", folder / "out_of_other")
    (main,) = out.glob("examples/*/main.c")
    sources = sorted((out / "src").rglob("*.c"))
    objects = compile_merged(Tree(out, ()), sources, [main], by, ("-std=gnu99", *flags))
    return link(objects, by, (*flags, "-pthread"), folder / "other")
