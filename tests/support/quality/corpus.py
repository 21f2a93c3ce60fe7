# SPDX-License-Identifier: Apache-2.0
"""What the checks of this folder read: generated trees that together hold every C file and every template.

A tree is the output folder of one application. A file that is the same in several trees, with all that it includes,
is analyzed once.
"""

from __future__ import annotations

import hashlib
import shutil
import subprocess
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from microros_gen.selection.find_components import load_catalogue
from tests.support.paths import ROOT, TESTS

EXAMPLES = ROOT / "examples"
INTERFACES = TESTS / "quality" / "interfaces"
CACHE = ROOT / "build" / "quality"
WORKERS = 2
_POOL = "version: 1\nprofiles: [pure_sender]\n"
_INT32 = _POOL + "interfaces: [std_msgs/msg/Int32]\n"
EVERY_PARAMETER = """\
    parameters:
      - {name: on, type: bool, default: true}
      - {name: gain, type: double, default: 0.5, range: {min: 0, max: 1, step: 0.1}, unit: 1/s}
      - {name: label, type: string, default: left, one_of: [left, right]}
      - {name: mode, type: integer, one_of: [0, 1, 5], description: How}
      - {name: rate, type: double, default: 2.5, one_of: [0.5, 2.5]}
      - {name: bytes, type: "byte[]", size: 4, default: [1, 255]}
      - {name: bools, type: "bool[]", size: 4, default: [true]}
      - {name: integers, type: "integer[]", size: 4, default: [-9223372036854775808, 7]}
      - {name: doubles, type: "double[]", size: 4, default: [1, 0.5]}
      - {name: strings, type: "string[]", size: 4, default: [a, ""]}
"""
PARAMETER_FILE = """\
probe:
  label: {type: string_fixed_8, default_value: left, validation: {not_empty<>: [], size_lt<>: [7]}}
  mode: {type: string, default_value: slow, validation: {one_of<>: [["slow", "fast"]]}}
  speed: {type: double, default_value: 16.0, validation: {gt<>: [15.0]}}
  ports: {type: int_array_fixed_4, default_value: [1], validation: {unique<>: [], element_bounds<>: [-5, 9]}}
  flags: {type: bool_array_fixed_3, default_value: [true], validation: {subset_of<>: [[true]]}}
  names: {type: string_array_fixed_3, default_value: [a], validation: {subset_of<>: [[a, "50%"]]}}
  __map_axes: {gains: {type: double_array_fixed_2, default_value: [1, 2], validation: {fixed_size<>: 2}}}
  axes: {type: string_array, default_value: [x, y]}
"""
_NODES = _POOL + "nodes:\n  - name: probe\n    publishers:\n"
_BEST = "      - {topic: fast, type: std_msgs/msg/Int32, qos: {reliability: best_effort}}\n"
_SURE = "      - {topic: sure, type: std_msgs/msg/UInt8}\n"
_LARGE = "      - {topic: large, type: std_msgs/msg/String}\nlimits: {'*': {string: 2000}}\n"
_BOTH = _NODES + _BEST + _SURE
_READER = "version: 1\nprofiles: [pure_reader]\nnodes:\n  - name: probe\n    subscriptions:\n"
_HEARD = "      - {topic: heard, type: std_msgs/msg/Int32, qos: {reliability: best_effort}}\n"
_ALONE = (
    "      - {topic: heard, type: std_msgs/msg/String, qos: {reliability: best_effort}, queue: 1}\n"
    "limits: {'*': {string: 400}}\n"
)
_QUEUED = (
    "      - {topic: said, type: std_msgs/msg/String, limits: {string: 3000}, queue: 2}\n"
    "      - {topic: word, type: std_msgs/msg/String, limits: {string: 8}}\n"
)
_SERVED = (
    "version: 1\nprofiles: [pure_reader]\ncomponents: [-subscribe, +services, +executor]\nnodes:\n  - name: probe\n"
    "    services: [{name: set, type: std_srvs/srv/SetBool, limits: {message: 20}}]\n"
)
_ASKED = "    clients: [{name: ask, type: std_srvs/srv/SetBool, queue: 2, limits: {message: 9}}]\n"
_EXECUTOR = "+publish, +service_call, +executor_nodes, +new_data_callbacks, +qos_events"
_MODES = (
    "    parameters:\n      - {name: speed, type: double}\n      - {name: on, type: bool}\n"
    "    modes: {__DEFAULT__: {on: $(parent on)}, SLOW: {speed: 0.25}, FAST: {speed: 2.0, on: true}}\n"
)
_LOCAL = (
    "version: 1\nprofiles: [pure_sender, pure_reader]\nlimits: {'*': {string: 12, sequence: 3}}\n"
    "nodes:\n  - name: probe\n    publishers:\n"
    "      - {topic: tree, type: quality_msgs/msg/Tree, local: only}\n"
    "      - {topic: count, type: std_msgs/msg/Int32, local: only}\n"
    "    subscriptions:\n"
    "      - {topic: tree, type: quality_msgs/msg/Tree, local: only, queue: 2}\n"
    "      - {topic: count, type: std_msgs/msg/Int32, local: only}\n"
)
_LOCAL_SERVICES = (
    "version: 1\nprofiles: [pure_sender, pure_reader]\ncomponents: [+services, +executor, +graph]\n"
    "limits: {'*': {string: 12, sequence: 3}}\n"
    "nodes:\n  - name: probe\n"
    "    services: [{name: count, type: std_srvs/srv/Trigger, local: also, queue: 2}]\n"
    "    clients: [{name: count, type: std_srvs/srv/Trigger, local: only}]\n"
)
_SERIAL = "transport: {type: serial, device: /dev/ttyACM0, baud: 115200}\n"
_PEER = (
    "version: 1\nprofiles: [pure_sender, pure_reader]\nsystem: {file: system.yaml, board: own}\n"
    "nodes:\n  - name: probe\n    publishers:\n"
    "      - {topic: /sure, type: std_msgs/msg/UInt8, peer: only}\n"
    "      - {topic: /best, type: std_msgs/msg/UInt8, peer: only, qos: {reliability: best_effort}}\n"
    "    subscriptions:\n"
    "      - {topic: /answer, type: std_msgs/msg/UInt8, peer: only, qos: {reliability: best_effort}, queue: 1}\n"
)
_PEER_SERVICES = (
    _PEER
    + "    services:\n      - {name: /count, type: std_srvs/srv/Trigger, peer: also, queue: 5}\n"
    + "    clients: [{name: /reset, type: std_srvs/srv/Trigger, peer: only}]\n"
    + "components: [+services, +executor]\nlimits: {'*': {string: 12}}\n"
)
_PEER_LARGE = _PEER_SERVICES.replace("string: 12", "string: 200")
_PEER_JOINED = (
    _PEER.replace(
        "UInt8, peer: only, qos: {reliability: best_effort}, queue: 1", "String, peer: only"
    ).replace("/sure, type: std_msgs/msg/UInt8", "/sure, type: std_msgs/msg/String")
    + "limits: {'*': {string: 200}}\n"
)
_CHIP = (
    "version: 1\nprofiles: [pure_sender, pure_reader]\nsystem: {file: system.yaml, board: own}\n"
    "limits: {'*': {string: 12, sequence: 3}}\nnodes:\n  - name: probe\n    publishers:\n"
    "      - {topic: to, type: quality_msgs/msg/Tree, local: chip}\n"
    "      - {topic: best, type: std_msgs/msg/UInt8, local: chip, qos: {reliability: best_effort}}\n"
    "    subscriptions:\n"
    "      - {topic: fro, type: quality_msgs/msg/Tree, local: chip, queue: 2}\n"
)
_CHIP_CALLS = (
    "".join(line for line in _CHIP.splitlines(keepends=True) if "best" not in line)
    + "    services: [{name: sum, type: std_srvs/srv/Trigger, local: chip, queue: 3}]\n"
    "    clients: [{name: ask, type: std_srvs/srv/Trigger, local: chip}]\n"
)
_CHIP_SERVES = "".join(line for line in _CHIP_CALLS.splitlines(keepends=True) if "ask" not in line)
SYSTEM = "version: 1\nboards: {own: {application: microros.yaml}, other: {application: other.yaml}}\nlinks:\n"


def _other(text: str) -> str:
    """Return the application of the other board, which has the other ends."""
    return (
        text.replace("own", "other")
        .replace("publishers", "subscriptions_")
        .replace("subscriptions:", "publishers:")
        .replace("subscriptions_", "subscriptions")
        .replace("services:", "clients_:")
        .replace("clients:", "services:")
        .replace("clients_:", "clients:")
        .replace("peer: also, queue: 5", "peer: only, queue: 4")
        .replace(", queue: 1", "")
        .replace(", queue: 2", "")
    )


def _third(text: str) -> str:
    """Return the application of a third image of a chip, which serves nothing: a service has one server."""
    lines = _other(text).replace("other", "third").splitlines(keepends=True)
    return "".join(line for line in lines if "name: ask" not in line)


_GROUP_SYSTEM = (
    SYSTEM.removesuffix("links:\n").replace("}}", "}, third: {application: third.yaml}}")
    + "chips: [{images: [own, other, third], memory: 64 KiB}]\n"
)


SYSTEMS: Mapping[str, str] = MappingProxyType(
    {
        "peer": SYSTEM + '  - {type: udp, ends: {own: "10.0.0.1:7500", other: "10.0.0.2:7500"}}\n',
        "peer_also": SYSTEM + '  - {type: udp, ends: {other: "10.0.0.1:7500", own: "10.0.0.2:7500"}}\n',
        "peer_serial": SYSTEM + "  - {type: serial, ends: {own: /dev/ttyS1, other: uart}}\n",
        "peer_canfd": SYSTEM + "  - {type: canfd, ends: {own: can0, other: can0}}\n",
        "peer_network": SYSTEM + '  - {type: udp, ends: {own: "10.0.0.1:7500", other: "10.0.0.2:7500"}}\n',
        "peer_board": SYSTEM + "  - {type: serial, ends: {own: uart, other: uart}}\n",
        "peer_services": SYSTEM + '  - {type: udp, ends: {own: "10.0.0.1:7500", other: "10.0.0.2:7500"}}\n',
        "peer_serving": SYSTEM + "  - {type: serial, ends: {own: uart, other: uart}}\n",
        "peer_fragments": SYSTEM
        + '  - {type: udp, mtu: 64, ends: {own: "10.0.0.1:7500", other: "10.0.0.2:7500"}}\n',
        "peer_fragments_joined": SYSTEM
        + '  - {type: udp, mtu: 64, ends: {other: "10.0.0.1:7500", own: "10.0.0.2:7500"}}\n',
        "peer_fragments_serving": SYSTEM + "  - {type: serial, mtu: 64, ends: {own: uart, other: uart}}\n",
        "local_chip": SYSTEM.replace("links:", "chips: [[own, other]]"),
        "local_chip_tasks": SYSTEM.replace("links:", "chips: [[other, own]]"),
        "local_chip_serving": SYSTEM.replace("links:", "chips: [[own, other]]"),
        "local_group": _GROUP_SYSTEM,
        "local_group_tasks": _GROUP_SYSTEM.replace("own, other, third", "other, third, own"),
    }
)
"""The system files of applications that have one."""

OTHERS: Mapping[str, str] = MappingProxyType(
    {
        **{
            name: _other(_PEER_SERVICES if "serv" in name else _PEER)
            for name in SYSTEMS
            if name.startswith("peer")
        },
        "peer_fragments": _other(_PEER_LARGE),
        "peer_fragments_joined": _other(_PEER_JOINED),
        "peer_fragments_serving": _other(_PEER_LARGE),
        "local_chip": _other(_CHIP),
        "local_chip_tasks": _other(_CHIP_CALLS),
        "local_chip_serving": _other(_CHIP_SERVES),
        "local_group": _other(_CHIP),
        "local_group_tasks": _other(_CHIP_CALLS),
    }
)
"""The applications of their other boards."""

THIRDS: Mapping[str, str] = MappingProxyType(
    {
        "local_group": _third(_CHIP),
        "local_group_tasks": _third(_CHIP_CALLS),
    }
)
"""The applications of their third boards, where they have one."""

APPLICATIONS: Mapping[str, str] = MappingProxyType(
    {
        "types": _POOL + "interfaces: [quality_msgs]\nlimits: {'*': {string: 12, sequence: 3}}\n",
        "types_nodes": _NODES
        + "      - {topic: tree, type: quality_msgs/msg/Tree}\n"
        + "      - {topic: shrub, type: quality_msgs/msg/Tree, limits: {leaf: {string: 2}, durations: 1}}\n"
        + "limits:\n  '*': {string: 12, sequence: 3}\n  quality_msgs/msg/Tree: {leaf: {string: 5}, runs: 2}\n",
        "types_decode": _POOL
        + "components: [+cdr_decode]\ninterfaces: [quality_msgs]\nlimits: {'*': {string: 12, sequence: 3}}\n",
        "decode_codes": _INT32 + "components: [+cdr_decode]\nerrors: code\n",
        "utilities": _POOL
        + "components: [+micro_ros_utilities]\ninterfaces: [quality_msgs]\nlimits: {'*': {string: 12, sequence: 3}}\n",
        "pool": _INT32,
        "pool_block": _INT32 + "on_full: block 20 ms\n",
        "substitutions": _POOL + "components: [+name_substitutions, +subscribe, +services]\n"
        "interfaces: [std_msgs/msg/Int32, std_srvs/srv/Empty]\n",
        "declared": _BOTH
        + "liveliness: acknack\non_full: drop_oldest\nerrors: code\nmemory: {arena: 1024}\nsession: {key: device}\n",
        "best_effort": _NODES + _BEST + "liveliness: none\n",
        "session_states": _INT32 + "components: [+session_state, +sleep_cycles, +publish_statistics]\n",
        "threads": _BOTH
        + "    subscriptions:\n"
        + _HEARD
        + "components: [+subscribe, +multithread, +time_sync]\nmemory: {arena: 512}\n",
        "threads_custom": _INT32
        + "components: [+executor, +multithread]\nerrors: code\ntransport: {type: custom}\n",
        "hard_liveliness": _READER
        + _HEARD
        + "session: {hard_liveliness: 10 s}\ncomponents: [+executor, +sleep_cycles]\n",
        "sleep_reader": _READER + _HEARD + _SERIAL + "components: [+sleep_cycles]\n",
        "sleep_custom": _INT32
        + "components: [+sleep_cycles, +time_sync]\nliveliness: acknack\ntransport: {type: custom}\n",
        "reliable_creation": _BOTH + "creation: reliable\npools: {input_history: 2}\n",
        "ordered_input": _BOTH + "creation: reliable\n",
        "large": _NODES + _LARGE,
        "reader": _READER + _HEARD + _QUEUED + "pools: {input_history: 2}\n",
        "reader_shared": _READER
        + "      - {topic: said, type: std_msgs/msg/String, limits: {string: 3000}, queue: 8, queue_bytes: 3100}\n"
        + "target: {name: qemu-mps2-an386}\n",
        "pool_shared": "version: 1\nprofiles: [pure_reader]\ncomponents: [+services]\n"
        + "pools: {queue: 8, queue_bytes: 60}\ninterfaces: [std_msgs/msg/Int32, std_srvs/srv/SetBool]\n"
        + "limits: {'*': {string: 20}}\n"
        + "target: {name: qemu-mps2-an386}\n",
        "reader_pool": "version: 1\nprofiles: [pure_reader]\ninterfaces: [std_msgs/msg/Int32]\n",
        "reader_xml": _READER + _QUEUED + "entities: xml\nerrors: code\nlimits: {'*': {string: 12}}\n",
        "reader_reference": _READER + _HEARD + "entities: reference\n",
        "reader_preconfigured": _READER + _HEARD + "entities: preconfigured\nliveliness: none\n",
        "reader_and_sender": _BOTH + "    subscriptions:\n" + _HEARD + "components: [+subscribe]\n",
        "remapped": _BOTH.replace("best_effort}", "best_effort, lifespan: 1 s}").replace(
            "name: probe", "name: probe\n    remap: {fast: quick, __ns: /left}"
        )
        + "    subscriptions:\n"
        + _HEARD
        + "components: [+subscribe]\n",
        "services": _SERVED + _ASKED,
        "services_xml": _SERVED + "entities: xml\n",
        "services_reference": _SERVED.replace("services: [{", "clients: [{") + "entities: reference\n",
        "services_pool": "version: 1\nprofiles: [pure_reader]\ncomponents: [+services, +executor]\n"
        + "interfaces: [std_srvs/srv/SetBool, std_msgs/msg/String]\nlimits: {'*': {string: 9, sequence: 2}}\n",
        "timers": _BOTH + "    timers: [{name: tick, period: 1 s}]\ncomponents: [+timers]\n",
        "timers_ticked": _BOTH
        + "    timers: [{name: a, period: 1 s, kind: rtos}, {name: b, period: 2 s, kind: hardware}]\n"
        + "components: [+timers, +subscribe]\nerrors: code\npools: {guard_conditions: 1}\n",
        "simulation": "version: 1\nprofiles: [simulation_node]\n",
        "simulation_timers": _READER
        + _HEARD
        + "    timers: [{name: a, period: 1 s}]\ncomponents: [+timers]\nclock: ros\n",
        "executor_custom": _INT32 + "components: [+executor]\ntransport: {type: custom}\n",
        "executor_board": _BOTH
        + "    timers: [{name: a, period: 1 s, kind: rtos}]\n"
        + "target: {name: qemu-mps2-an386}\ncomponents: [+timers]\n",
        "executor_other_line": _BOTH + "target: {name: cortex-m4}\ncomponents: [+timers]\n",
        "xml": _BOTH + "entities: xml\nliveliness: none\n",
        "xml_pool": _INT32 + "entities: xml\n",
        "reference": _BOTH + "entities: reference\n",
        "preconfigured": _BOTH + "entities: preconfigured\nliveliness: ping\n",
        "serial": _INT32 + _SERIAL,
        "tcp": _INT32
        + "transport: {type: tcp, agent: '[::1]:8888'}\ncomponents: [+time_sync, +clock, +session_state]\n",
        "agents": _INT32
        + "transport: {agents: ['10.0.0.1:8888', '10.0.0.2:8888']}\ncomponents: [+executor, +time_sync]\n",
        "agents_of_lines": _INT32
        + "transport: {type: serial, agents: [/dev/ttyS0, /dev/ttyS1]}\ncomponents: [+ping]\n",
        "discovery": "version: 1\nprofiles: [ad_hoc_discoverable_sender]\ninterfaces: [std_msgs/msg/Int32]\n",
        "canfd": _BOTH + "transport: {type: canfd, id: 0x7f}\ncomponents: [+executor, +sleep_cycles]\n",
        "custom": _INT32 + "transport: {type: custom}\n",
        "cortex_m": _BOTH + "target: {name: qemu-microbit}\nsession: {key: device}\n",
        "cortex_m_cmsdk": _BOTH + "target: {name: qemu-mps2-an385}\n",
        "riscv": _BOTH + "target: {name: qemu-riscv32-virt}\n",
        "any_processor": "version: 1\nprofiles: [pure_sender, pure_reader]\ntarget: {name: own.yaml}\n"
        "interfaces: [geometry_msgs/msg/Twist, std_msgs/msg/Float64MultiArray]\n"
        "limits: {'*': {string: 9, sequence: 3}}\n",
        "prints_uart": _BOTH + "target: {name: own.yaml}\n",
        "prints_uart_riscv": _BOTH + "target: {name: own.yaml}\n",
        "prints_semihosting": _BOTH + "target: {name: own.yaml}\nlogging: console\n",
        "console": _BOTH + "target: {name: own.yaml}\nlogging: console\n",
        "console_riscv": _BOTH + "target: {name: own.yaml}\nlogging: console\n",
        "prints_nowhere": _BOTH + "target: {name: own.yaml}\n",
        "continuous": _BOTH + "components: [+continuous_serialization, +multithread]\n",
        "loaned": _READER + _ALONE + "components: [+loaned_messages, +multithread]\n",
        "kept_output": _NODES
        + "      - {topic: large, type: std_msgs/msg/String}\nlimits: {'*': {string: 300}}\n"
        + "target: {name: qemu-mps2-an386}\n",
        "lent_serial": _READER + _ALONE + _SERIAL,
        "lent_custom": _READER + _ALONE + "transport: {type: custom}\n",
        "lent_custom_framed": _READER + _ALONE + "transport: {type: custom, framing: true}\n",
        "lent_custom_packets": _READER + _ALONE + "transport: {type: custom, framing: false}\n",
        "logging": _INT32 + "components: [+multithread]\nlogging: [{to: console, level: debug}, callback]\n",
        "log_float": _INT32 + "components: [+logging_float, +logging_wide]\nlogging: callback\n",
        "rosout": _BOTH + "components: [+multithread]\nlogging: rosout\n",
        "logger_services": _BOTH + "components: [+logger_services, +multithread]\nlogging: callback\n",
        "ring_board": _BOTH
        + "target: {name: qemu-mps2-an386}\nlogging: [{to: rosout, level: warn}, {to: ring, level: debug}]\n",
        "rosout_board": _BOTH
        + "target: {name: qemu-mps2-an386}\nlogging: [rosout, {to: callback, level: warn}]\n",
        "parameters_kept": _NODES.replace("    publishers:\n", "") + "components: [+parameter_storage]\n",
        "parameters": _NODES.replace("    publishers:\n", "") + "components: [+parameters]\n",
        "parameters_every": _NODES.replace("    publishers:\n", "")
        + EVERY_PARAMETER
        + "components: [+parameters]\n",
        "parameters_rules": _NODES.replace("    publishers:\n", "    parameters: {file: parameters.yaml}\n")
        + "components: [+parameters]\n",
        "parameters_held": _NODES.replace("    publishers:\n", "    parameters: {at: agent}\n")
        + "components: [+parameters]\n",
        "parameters_held_every": _NODES.replace("    publishers:\n", "")
        + EVERY_PARAMETER.replace("parameters:\n", "parameters:\n      at: agent\n      declare:\n")
        + "components: [+parameters]\nlogging: callback\n",
        "parameter_client": _NODES.replace("    publishers:\n", "")
        + "    parameter_clients:\n      - {node: /motor, elements: 3, operations: "
        + "[get, set, set_atomically, list, describe, get_types, watch]}\n"
        + "components: [+parameter_client, +subscribe, +multithread]\n",
        "graph": _NODES + _SURE + "components: [+graph, +multithread]\nmemory: {arena: 4096}\n",
        "graph_events": _NODES + _SURE + "components: [+graph_events, +multithread]\nmemory: {arena: 4096}\n",
        "graph_topic": _NODES + _SURE + "components: [+graph_topic, +multithread]\nmemory: {arena: 4096}\n",
        "graph_topic_xml": _NODES
        + _SURE
        + "components: [+graph_topic]\nentities: xml\nmemory: {arena: 4096}\n",
        "action_server": _NODES.replace("    publishers:\n", "")
        + "    actions:\n      - {name: walk, type: tf2_msgs/action/LookupTransform, goals: 2, waiting: 2}\n"
        + "components: [+action_server, +multithread]\nlimits: {'*': {string: 20}}\n",
        "action_client": _NODES.replace("    publishers:\n", "")
        + "    action_clients:\n      - {name: walk, type: tf2_msgs/action/LookupTransform, goals: 2}\n"
        + "components: [+action_client, +graph, +multithread]\non_full: drop_oldest\n"
        + "memory: {arena: 4096}\nlimits: {'*': {string: 20}}\n",
        "diagnosis": _NODES.replace("    publishers:\n", "")
        + _MODES
        + "    timers: [{name: tick, period: 50 ms}]\ncomponents: [+timers, +executor, +diagnosis]\n"
        + "diagnosis: {deadline: 5 ms, timers: true, checks: [{name: battery, below: {error: 11000}, mode: SLOW}],\n"
        + "  callbacks: [{name: tick, limit: 2 ms}, {name: other}]}\n",
        "on_silence": _READER
        + _ALONE.replace("queue: 1", "queue: 1, on_silence: {after: 1 s, call: stop_motors}")
        + "components: [+multithread]\n",
        "time_source": _NODES
        + _SURE
        + "components: [+time_source, +clock_stamp, +diagnosis, +multithread]\n",
        "time_source_own": _NODES
        + _SURE
        + "components: [+time_source]\ntime_source: {source: application, step: 1 s}\n"
        + "target: {name: qemu-microbit}\n",
        "diagnosis_threads": _NODES + _SURE + "components: [+diagnosis, +multithread]\n",
        "diagnosis_board": _NODES
        + _SURE
        + "components: [+executor, +diagnosis]\ntarget: {name: qemu-microbit}\n"
        + f"diagnosis: {{checks: [{', '.join(f'{{name: c{i}, above: {{warn: 1}}}}' for i in range(33))}]}}\n",
        "diagnosis_riscv": _NODES
        + _SURE
        + "components: [+executor, +diagnosis]\ntarget: {name: qemu-riscv32-virt}\n",
        "executor_all": _SERVED.replace("[-subscribe, ", f"[{_EXECUTOR}, +multithread, ")
        + _ASKED
        + "    publishers: [{topic: out, type: std_msgs/msg/Int32, qos: {deadline: 200 ms}}]\n"
        + "    subscriptions: [{topic: in, type: std_msgs/msg/Int32, qos: {deadline: 200 ms}}]\n",
        "tasks": _NODES
        + _SURE
        + "    subscriptions: [{topic: in, type: std_msgs/msg/Int32}]\n"
        + "    timers: [{name: tick, period: 50 ms}]\n"
        + "    executors: [{name: fast, handles: [tick]}, {name: slow, handles: [in]}]\n"
        + "components: [+subscribe, +executor, +timers, +diagnosis]\n"
        + "tasks:\n  - {name: control, executor: fast, rate: 20 Hz, overrun: call}\n"
        + "  - {name: work, executor: slow, interval: 5 ms}\nwatchdog: {margin: 10 ms}\n",
        "tasks_custom": _BOTH
        + "    services: [{name: rest, type: std_srvs/srv/Empty}]\n"
        + "    executors: [{name: fast}]\n"
        + "components: [+executor, +services]\non_full: drop_oldest\ntransport: {type: custom}\n"
        + "tasks: [{name: control, executor: fast, rate: 20 Hz}]\n",
        "tasks_tcp": _BOTH
        + "    executors: [{name: fast}]\n"
        + "components: [+executor]\ntransport: {type: tcp, agent: '[::1]:8888'}\n"
        + "tasks: [{name: control, executor: fast, rate: 20 Hz}]\n",
        "tasks_preconfigured": _NODES
        + _BEST
        + "    executors: [{name: fast}]\n"
        + "components: [+executor]\non_full: block 10 ms\nentities: preconfigured\n"
        + "tasks: [{name: control, executor: fast, rate: 20 Hz}]\n",
        "transforms": _NODES.replace("    publishers:\n", "")
        + "components: [+tf_broadcaster, +multithread]\n",
        "executor_events": _BOTH + "components: [+qos_events, +clock_stamp]\n",
        "lifecycle": _NODES + _SURE + "components: [+lifecycle, +multithread]\n",
        "local": _LOCAL,
        "local_services": _LOCAL_SERVICES,
        "local_chip": _CHIP,
        "local_chip_tasks": _CHIP_CALLS + "components: [+services, +multithread, +executor]\nerrors: code\n",
        "local_chip_serving": _CHIP_SERVES + "components: [+services]\n",
        "local_group": _CHIP,
        "local_group_tasks": _CHIP_CALLS + "components: [+services, +multithread, +executor]\nerrors: code\n",
        "local_also": _LOCAL.replace("local: only", "local: also", 1)
        + "components: [+multithread]\nerrors: code\n",
        "peer": _PEER,
        "peer_also": _PEER.replace("peer: only", "peer: also", 1)
        + "components: [+multithread]\nerrors: code\n",
        "peer_serial": _PEER + _SERIAL,
        "peer_canfd": _PEER + "transport: {type: canfd}\n",
        "peer_network": _PEER + "transport: {type: udp}\ntarget: cortex-m4\n",
        "peer_board": _PEER + "transport: {type: serial}\ntarget: qemu-mps2-an386\n",
        "peer_services": _PEER_SERVICES,
        "peer_serving": _PEER_SERVICES.replace("peer: also", "peer: only").replace(
            "    clients: [{name: /reset, type: std_srvs/srv/Trigger, peer: only}]\n", ""
        )
        + "transport: {type: serial}\ntarget: qemu-mps2-an386\n",
        "peer_fragments": _PEER_LARGE,
        "peer_fragments_joined": _PEER_JOINED,
        "peer_fragments_serving": _PEER_LARGE.replace("peer: also", "peer: only").replace(
            "    clients: [{name: /reset, type: std_srvs/srv/Trigger, peer: only}]\n", ""
        )
        + "transport: {type: serial}\ntarget: qemu-mps2-an386\n",
        "lifecycle_managed": _NODES
        + "      - {topic: sure, type: std_msgs/msg/UInt8, managed: true}\n"
        + "    timers: [{name: control, period: 20 ms, managed: true}]\n"
        + "components: [+lifecycle, +timers, +sleep_cycles]\n",
        "modes": _NODES + _SURE + _MODES + "components: [+node_modes, +multithread]\n",
        "modes_texts": _NODES
        + _SURE
        + _MODES.replace("    modes:", "      - {name: label, type: string}\n    modes:").replace(
            "speed: 0.25", "label: calm"
        )
        + "components: [+node_modes, +sleep_cycles]\nerrors: code\n",
        "services_less": _SERVED.replace("20", "9") + _ASKED.replace("9", "20"),
        "seal": _BOTH + "liveliness: ping\nsession: {key: 7}\ntransport: {seal: psa}\n",
        "seal_tcp": _READER
        + _ALONE
        + "liveliness: ping\nsession: {key: 7}\n"
        + "transport: {type: tcp, agent: '127.0.0.1:8888', seal: application}\n",
        "seal_serial": _BOTH + "liveliness: ping\nsession: {key: 7}\ntransport: {type: serial, seal: psa}\n",
        "lent_tcp": _READER + _ALONE + "transport: {type: tcp, agent: '127.0.0.1:8888'}\n",
    }
)
"""Application files by name."""

_PRINTS = "target: own\nsummary: Prints\nextends: {}\nstdio: {}\n"
TARGETS: Mapping[str, str] = MappingProxyType(
    {
        "prints_uart": _PRINTS.format("qemu-mps2-an385", "{to: uart, driver: cmsdk, base: 0x40005000}"),
        "prints_uart_riscv": _PRINTS.format(
            "qemu-riscv32-virt", "{to: uart, driver: ns16550, base: 0x10001000}"
        ),
        "prints_semihosting": _PRINTS.format("qemu-mps2-an385", "{to: semihosting}"),
        "console": _PRINTS.format("qemu-mps2-an385", "{to: uart, driver: cmsdk, base: 0x40005000, irq: 2}"),
        "console_riscv": _PRINTS.format(
            "qemu-riscv32-virt", "{to: uart, driver: ns16550, base: 0x10001000, irq: 11}"
        ),
        "any_processor": "target: own\nsummary: Any\nextends: host\ndata_model: any\n",
        "prints_nowhere": _PRINTS.format("qemu-mps2-an385", "{to: none}"),
    }
)
"""Target files of applications that name `own.yaml`."""

AWAITED: Mapping[str, frozenset[str]] = MappingProxyType(
    {
        "reliable_creation": frozenset({"stream_reliable_input", "entities"}),
        "ordered_input": frozenset({"stream_reliable_input", "entities"}),
        "large": frozenset({"stream_reliable"}),
        "reader": frozenset({"subscribe"}),
        "reader_pool": frozenset({"subscribe"}),
        "reader_xml": frozenset({"subscribe", "entities_xml"}),
        "reader_reference": frozenset({"subscribe", "entities_reference"}),
        "reader_preconfigured": frozenset({"subscribe", "entities_preconfigured"}),
        "reader_and_sender": frozenset({"subscribe"}),
        "xml": frozenset({"entities_xml"}),
        "xml_pool": frozenset({"entities_xml"}),
        "reference": frozenset({"entities_reference"}),
        "preconfigured": frozenset({"entities_preconfigured"}),
        "serial": frozenset({"transport_serial", "framing"}),
        "custom": frozenset({"transport_custom", "framing"}),
        "cortex_m": frozenset({"port_cortex_m", "transport_serial"}),
        "cortex_m_cmsdk": frozenset({"port_cortex_m", "transport_serial"}),
        "riscv": frozenset({"port_riscv", "transport_serial"}),
    }
)
"""Components that an application needs; while one of them is planned, the application is left out."""


def ready_components() -> frozenset[str]:
    """Return the names of components that can be built."""
    return frozenset(name for name, component in load_catalogue().items() if component.ready)


@dataclass(frozen=True)
class Tree:
    """The output folder of one application, and the C files in it, relative to it."""

    name: str
    out: Path
    sources: tuple[str, ...]


def make_tree(name: str, folder: Path) -> Tree:
    """Generate the application `name` below `folder`; raises UserError."""
    place = folder / name
    place.mkdir(parents=True)
    (place / "microros.yaml").write_text(APPLICATIONS[name], encoding="utf-8")
    if name in TARGETS:
        (place / "own.yaml").write_text(TARGETS[name], encoding="utf-8")
    (place / "parameters.yaml").write_text(PARAMETER_FILE, encoding="utf-8")
    if name in SYSTEMS:
        (place / "system.yaml").write_text(SYSTEMS[name], encoding="utf-8")
        (place / "other.yaml").write_text(OTHERS[name], encoding="utf-8")
    if name in THIRDS:
        (place / "third.yaml").write_text(THIRDS[name], encoding="utf-8")
    options = compiler.Options(
        config=place / "microros.yaml", interface_paths=(INTERFACES / "quality_msgs", shipped_folder())
    )
    out = compiler.generate(options, place / "out").out
    return Tree(name, out, tuple(sorted(p.relative_to(out).as_posix() for p in out.rglob("*.c"))))


def make_trees(folder: Path) -> list[Tree]:
    """Generate every application whose components are ready."""
    ready = ready_components()
    return [make_tree(name, folder) for name in APPLICATIONS if AWAITED.get(name, frozenset()) <= ready]


def make_examples(folder: Path) -> list[Tree]:
    """Generate what each application of examples/ is compiled against; the application is all that a tree lists."""
    return [_make_example(path, folder / path.parent.name) for path in sorted(EXAMPLES.glob("*/main.c"))]


def _make_example(source: Path, out: Path) -> Tree:
    options = compiler.Options(config=source.with_name("microros.yaml"), interface_paths=(shipped_folder(),))
    compiler.generate(options, out)
    copy = out / "applications" / source.relative_to(EXAMPLES)
    copy.parent.mkdir(parents=True)
    shutil.copy(source, copy)
    shutil.copy(EXAMPLES / "example.h", copy.parents[1])
    return Tree(f"example_{source.parent.name}", out, (copy.relative_to(out).as_posix(),))


def covered(trees: Sequence[Tree]) -> set[str]:
    """Return the sources of components in `trees` as `component/file.c`."""
    return {s.removeprefix("src/") for tree in trees for s in tree.sources if s.startswith("src/")}


def run(command: Sequence[str], folder: Path, standard_input: str = "") -> subprocess.CompletedProcess[str]:
    """Run `command` in `folder` with `standard_input`, whatever it returns."""
    return subprocess.run(
        list(command), cwd=folder, input=standard_input, text=True, capture_output=True, check=False
    )


@dataclass(frozen=True)
class Unit:
    """One C file of a tree; `key` identifies its content with everything that it includes.

    `in_every_configuration`: cppcheck also reads what its conditions leave out in this tree, in at least one more pass.
    """

    tree: Tree
    source: str
    key: str
    in_every_configuration: bool = True


def tree_key(tree: Tree) -> str:
    """Return the key of every C file and header of `tree`."""
    digest = hashlib.sha256()
    for path in sorted(p for p in tree.out.rglob("*.[ch]") if p.is_file()):
        digest.update(f"{path.relative_to(tree.out).as_posix()}\0".encode() + path.read_bytes() + b"\0")
    return digest.hexdigest()


def width_flags(unit: Unit) -> tuple[str, ...]:
    """Return how a file of a microcontroller's port is compiled on a host: its registers have addresses of 32 bits."""
    bare = ("src/port_bare/", "src/port_cortex_m/", "src/port_riscv/")
    return ("-m32",) if unit.source.startswith(bare) else ()


def configuration_flags(unit: Unit) -> tuple[str, ...]:
    """Return what limits cppcheck to the configuration of the tree."""
    return () if unit.in_every_configuration else ("--max-configs=1", "--suppress=toomanyconfigs")


def rendered_names() -> frozenset[str]:
    """Return the names of the C files of components that are rendered from templates."""
    components = load_catalogue().values()
    return frozenset(p.name.removesuffix(".j2") for c in components for p in c.folder.rglob("*.c.j2"))


def units(trees: Sequence[Tree]) -> list[Unit]:
    """Return every file of every tree; a file with the text of one in an earlier tree has the key of that one.

    What is rendered from a template counts as another file where the headers that it includes differ, and so does
    every file where errors are codes.
    """
    rendered = rendered_names()
    first: dict[tuple[str, ...], tuple[Tree, str]] = {}
    found: list[tuple[Tree, str, tuple[str, ...]]] = []
    for tree in trees:
        # Errors are texts or codes: the names of this header are objects in one tree and constants in another.
        errors = tree.out / "include" / "microros" / "error.h"
        names = errors.read_text(encoding="utf-8") if errors.is_file() else ""
        for source in tree.sources:
            same = (source, names, (tree.out / source).read_text(encoding="utf-8"))
            identity: tuple[str, ...] = (*same, tree.name) if Path(source).name in rendered else same
            first.setdefault(identity, (tree, source))
            found.append((tree, source, identity))
    key_of = dict(zip(first, keys(list(first.values())), strict=True))
    return [Unit(tree, source, key_of[identity]) for tree, source, identity in found]


def keys(sources: Sequence[tuple[Tree, str]]) -> list[str]:
    """Return what identifies each file with all that it includes."""

    def preprocess(job: tuple[Tree, str]) -> str:
        tree, source = job
        # -dD keeps the definitions of macros: a finding may be in one.
        done = run(["gcc", "-std=c99", "-E", "-P", "-dD", "-Iinclude", source], tree.out)
        assert done.returncode == 0, f"{tree.name}: {done.stderr}"
        # The preprocessor drops comments, and some tell a tool what it must not report.
        text = (tree.out / source).read_text(encoding="utf-8")
        orders = [line for line in text.splitlines() if "-suppress" in line or "NOLINT" in line]
        return hashlib.sha256("\n".join((source, done.stdout, *orders)).encode()).hexdigest()

    with ThreadPoolExecutor(WORKERS) as pool:
        return list(pool.map(preprocess, sources))


def analyze(tool: str, each: Sequence[Unit], check: Callable[[Unit], str]) -> dict[str, str]:
    """Return what `check` says of each different unit, by key."""
    return analyze_together(tool, each, lambda group: [check(unit) for unit in group], 1)


def analyze_together(
    tool: str, each: Sequence[Unit], check: Callable[[Sequence[Unit]], Sequence[str]], size: int
) -> dict[str, str]:
    """Return what `check` says of each different unit, by key; answers are kept in build/quality.

    `check` gets up to `size` units without an answer. `tool` names the check, its version and its rules: another
    name, another answer.
    """
    folder = CACHE / hashlib.sha256(tool.encode()).hexdigest()[:16]
    folder.mkdir(parents=True, exist_ok=True)
    different = {unit.key: unit for unit in reversed(each)}
    missing = [unit for key, unit in different.items() if not (folder / key).is_file()]
    number = -(-len(missing) // size)
    # Neighbors take similarly long, so no group has them together.
    groups = [missing[at::number] for at in range(number)]

    def answer(group: Sequence[Unit]) -> None:
        for unit, text in zip(group, check(group), strict=True):
            fresh = folder / f"{unit.key}.{unit.tree.name}"
            fresh.write_text(text, encoding="utf-8")
            fresh.replace(folder / unit.key)

    with ThreadPoolExecutor(WORKERS) as pool:
        list(pool.map(answer, groups))
    return {key: (folder / key).read_text(encoding="utf-8") for key in different}
