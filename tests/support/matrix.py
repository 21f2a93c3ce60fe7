# SPDX-License-Identifier: Apache-2.0
"""Applications that select different files of the runtime, generated for the tests of this folder."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from microros_gen.toolchain.toolchain import WARNINGS
from tests.support.paths import ROOT
from tests.support.quality.corpus import APPLICATIONS, EVERY_PARAMETER, OTHERS, SYSTEMS, THIRDS

DEMO = ROOT / "examples" / "demo" / "microros.yaml"

_POOL = """\
version: 1
profiles: [pure_sender]
interfaces: [std_msgs/msg/Int32]
"""
_POOL_LARGE = """\
version: 1
profiles: [pure_sender]
interfaces: [diagnostic_msgs/msg/DiagnosticArray, std_msgs/msg/Empty]
pools: {nodes: 2, publishers: 3}
limits: {"*": {string: 12, sequence: 2}}
"""
_NODES = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: arm
    namespace: /robot
    publishers:
      - {topic: joints, type: sensor_msgs/msg/JointState}
      - {topic: ~/count, type: std_msgs/msg/UInt8}
  - name: base
    publishers:
      - {topic: /velocity, type: geometry_msgs/msg/TwistStamped}
limits: {"*": {string: 16, sequence: 6}}
"""
_BEST_EFFORT = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: probe
    publishers:
      - {topic: temperature, type: sensor_msgs/msg/Temperature, qos: {reliability: best_effort}}
limits: {"*": {string: 16}}
"""

_READER = """\
version: 1
profiles: [pure_reader]
limits: {"*": {string: 24, sequence: 6}}
nodes:
  - name: ear
    subscriptions:
      - {topic: said, type: std_msgs/msg/String, limits: {string: 3000}, queue: 2}
      - {topic: joints, type: sensor_msgs/msg/JointState}
"""
_LENT = """\
version: 1
profiles: [pure_reader]
nodes:
  - name: ear
    subscriptions:
      - {topic: said, type: std_msgs/msg/String, qos: {reliability: best_effort}, queue: 1}
limits: {"*": {string: 400}}
"""
_BUSY = """\
version: 1
limits: {"*": {string: 24, sequence: 3}}
nodes:
  - name: busy
"""
_SERVES = "    services: [{name: sum, type: example_interfaces/srv/AddTwoInts}]\n"
_ASKS = "    clients: [{name: /far/sum, type: example_interfaces/srv/AddTwoInts}]\n"
_RULES = """\
busy:
  names: {type: string_array_fixed_2, default_value: [a], validation: {unique<>: [], not_empty<>: []}}
  gains: {type: double_array_fixed_2, default_value: [0.5], validation: {element_bounds<>: [0.0, 1.0]}}
"""
"""A parameter file with validations, for the variant that reads it."""
_WIDE = "wstring[<=2] lines\n"
"""A message of wide strings, which no included interface has in a sequence."""


def _of_numbers(application: str) -> str:
    """Return a board of the corpus with the messages that other variants here have, too."""
    application = application.replace("UInt8", "Int32").replace(
        "std_srvs/srv/Trigger", "example_interfaces/srv/AddTwoInts"
    )
    return application.replace("quality_msgs/msg/Tree", "std_msgs/msg/String")


VARIANTS: Mapping[str, str] = MappingProxyType(
    {
        "pool": _POOL,
        "demo": DEMO.read_text(encoding="utf-8"),
        "pool-none-drop-code-arena-device": _POOL_LARGE
        + "liveliness: none\non_full: drop_oldest\nerrors: code\nmemory: {arena: 1024}\n"
        + "session: {key: device}\ncomponents: [+publish_statistics, +name_substitutions, +continuous_serialization]\n",
        "pool-acknack-block-xml-reliable": _POOL
        + "liveliness: acknack\non_full: block 20 ms\nentities: xml\ncreation: reliable\n",
        "declared-acknack-drop-arena-reference-pieces": _NODES.replace("sequence: 6", "sequence: 80")
        + "liveliness: acknack\non_full: drop_oldest\nmemory: {arena: 1024}\nentities: reference\n",
        "declared-ping-block-code-device-preconfigured": _NODES
        + "on_full: block 20 ms\nerrors: code\nsession: {key: device}\nentities: preconfigured\n",
        "best-effort-none-code": _BEST_EFFORT + "liveliness: none\nerrors: code\nentities: preconfigured\n",
        "best-effort-ping-drop": _BEST_EFFORT + "on_full: drop_oldest\nsession: {key: 7}\n",
        "best-effort-reference-reliable-held": _BEST_EFFORT
        + "entities: reference\ncreation: reliable\npools: {input_history: 2}\n",
        "reader-loans": _READER + "components: [+loaned_messages]\n",
        "reader": _READER
        + "      - {topic: shared, type: std_msgs/msg/String, limits: {string: 900}, queue: 8, queue_bytes: 1000}\n"
        + "      - {topic: fast, type: std_msgs/msg/Int32, qos: {reliability: best_effort}}\n",
        "reader-code-none-preconfigured": _READER
        + "entities: preconfigured\nliveliness: none\nerrors: code\n",
        "simulation-pool": "version: 1\nprofiles: [simulation_node, pure_sender]\nlimits: {'*': {string: 8}}\n"
        + "interfaces: [std_msgs/msg/Header, wide_msgs/msg/Wide]\ninterface_paths: [interfaces]\n",
        "reader-pool-xml": "version: 1\nprofiles: [pure_reader]\ninterfaces: [std_msgs/msg/String]\n"
        + "entities: xml\nlimits: {'*': {string: 2000}}\ntransport: {mtu: 2400}\npools: {queue_bytes: 2100}\n",
        "server-binary-timers-sleep": _BUSY
        + _SERVES
        + "    timers: [{name: tick, period: 50 ms}]\nprofiles: [pure_reader]\ncomponents: [-subscribe, +services, "
        + "+executor, +timers, +sleep_cycles, +session_state, +micro_ros_utilities, +time_sync]\n",
        "client-xml-code-rtos-timers-threads": _BUSY
        + _ASKS
        + "    timers: [{name: tick, period: 50 ms, kind: rtos}]\nprofiles: [pure_sender]\n"
        + "components: [-publish, +services, +executor, +timers, +multithread, +liveliness_hard, +discovery]\n"
        + "entities: xml\nerrors: code\n",
        "both-reference-tcp": _BUSY
        + _SERVES
        + _ASKS
        + "profiles: [pure_sender]\ncomponents: [-publish, +services, +executor, +time_sync]\nentities: reference\n"
        + "transport: {type: tcp, agents: ['10.0.0.1:8888', '10.0.0.2:8888']}\n",
        "lent-serial": _LENT + "transport: {type: serial}\n",
        "lent-tcp": _LENT + "transport: {type: tcp}\n",
        "serial-sleep": _POOL + "components: [+sleep_cycles]\ntransport: {type: serial}\n",
        "custom-framed-sleep": _POOL
        + "components: [+sleep_cycles]\ntransport: {type: custom, framing: true}\n",
        "custom-framed-reader": _LENT + "transport: {type: custom, framing: true}\n",
        "custom-packets-reader": _LENT + "transport: {type: custom, framing: false}\n",
        "custom-either-reader": _LENT + "transport: {type: custom}\n",
        "custom-either-own-limits": _BUSY
        + "    services: [{name: on, type: std_srvs/srv/SetBool, limits: {message: 9}}]\n"
        + "    clients: [{name: ask, type: std_srvs/srv/SetBool, limits: {message: 20}}]\n"
        + "profiles: [pure_reader]\ncomponents: [-subscribe, +services, +executor]\ntransport: {type: custom}\n",
        "parameters": _BUSY
        + "    parameters:\n      - {name: gain, type: double, default: 0.5, range: {min: 0, max: 1}}\n"
        + "      - {name: label, type: string, default: left, size: 8}\n"
        + "profiles: [pure_sender]\ncomponents: [+parameters]\n",
        "parameters-every": _BUSY + EVERY_PARAMETER + "profiles: [pure_sender]\ncomponents: [+parameters]\n",
        "parameters-rules": _BUSY
        + "    parameters: {file: rules.yaml}\n"
        + "profiles: [pure_sender]\ncomponents: [+parameters]\nerrors: code\n",
        "parameters-held": _BUSY
        + "    parameters: {at: agent, declare: [{name: mode, type: integer, one_of: [0, 5]}]}\n"
        + "profiles: [pure_sender]\ncomponents: [+parameters]\nlogging: callback\nerrors: code\n",
        "parameters-held-silent": _BUSY
        + "    parameters: {at: agent, declare: [{name: gain, type: double}]}\n"
        + "profiles: [pure_sender]\ncomponents: [+parameters]\n",
        "parameter-client": _BUSY
        + "    parameters: [{name: gain, type: double}]\n"
        + "    parameter_clients:\n      - {node: /motor, elements: 3, operations: "
        + "[get, set, set_atomically, list, describe, get_types, watch]}\n"
        + "profiles: [pure_sender]\ncomponents: [+parameter_client, +subscribe, +parameters]\n",
        "action-server": _BUSY
        + "    actions: [{name: walk, type: tf2_msgs/action/LookupTransform, goals: 2, waiting: 2}]\n"
        + "profiles: [pure_sender]\ncomponents: [+action_server]\nerrors: code\n",
        "action-client": _BUSY
        + "    action_clients: [{name: walk, type: tf2_msgs/action/LookupTransform, goals: 2}]\n"
        + "profiles: [pure_sender]\ncomponents: [+action_client, +graph]\nmemory: {arena: 4096}\nerrors: code\n"
        + "on_full: drop_oldest\n",
        "executor-all": _BUSY
        + _SERVES
        + _ASKS
        + "    publishers: [{topic: out, type: std_msgs/msg/Int32, qos: {deadline: 200 ms}}]\n"
        + "    subscriptions: [{topic: in, type: std_msgs/msg/Int32, qos: {deadline: 200 ms}}]\n"
        + "profiles: [pure_sender, pure_reader]\ncomponents: [+services, +executor, +service_call, "
        + "+executor_nodes, +new_data_callbacks, +qos_events]\nerrors: code\n",
        "local": _BUSY
        + "    publishers: [{topic: near, type: std_msgs/msg/String, local: only}]\n"
        + "    subscriptions: [{topic: near, type: std_msgs/msg/String, local: only, queue: 2}]\n"
        + _SERVES.replace("}]", ", local: only}]")
        + _ASKS.replace("/far/sum", "sum").replace("}]", ", local: only}]")
        + "profiles: [pure_sender, pure_reader]\ncomponents: [+services]\nerrors: code\n",
        "canfd": _BUSY
        + "    publishers: [{topic: far, type: std_msgs/msg/Int32}]\n"
        + "profiles: [pure_sender]\ncomponents: [+sleep_cycles]\ncreation: reliable\ntransport: {type: canfd, id: 7}\n"
        + "errors: code\n",
        **{
            name: _of_numbers(APPLICATIONS[name])
            for name in (
                "peer_services",
                "peer_serial",
                "peer_canfd",
                "peer_fragments_joined",
                "local_chip_tasks",
                "local_group_tasks",
            )
        },
        "diagnosis": _BUSY
        + "    parameters: [{name: speed, type: double}]\n    modes: {SLOW: {speed: 0.5}}\n"
        + "    timers: [{name: tick, period: 50 ms}]\nprofiles: [managed_service]\n"
        + "components: [+timers, +diagnosis]\n"
        + "diagnosis: {deadline: 5 ms, checks: [{name: battery, below: {error: 11000}, mode: SLOW}],\n"
        + "  callbacks: [{name: tick, limit: 2 ms}]}\n",
        "on-silence": _BUSY
        + "    subscriptions: [{topic: near, type: std_msgs/msg/Int32, on_silence: {after: 1 s, call: stop_motors}}]\n"
        + "profiles: [pure_reader]\n",
        "time-source": _BUSY
        + "    publishers: [{topic: sure, type: std_msgs/msg/Int32}]\n"
        + "profiles: [pure_sender]\ncomponents: [+time_source]\n",
        "diagnosis-threads": _BUSY + "profiles: [pure_sender]\ncomponents: [+diagnosis, +multithread]\n",
        "lifecycle": _BUSY + "profiles: [managed_service]\nerrors: code\n",
        "lifecycle-managed": _BUSY
        + "    publishers: [{topic: sure, type: std_msgs/msg/Int32, managed: true}]\n"
        + "    timers: [{name: control, period: 20 ms, managed: true}]\n"
        + "profiles: [managed_service]\ncomponents: [+timers, +sleep_cycles]\n",
        "modes": _BUSY
        + "    parameters: [{name: speed, type: double}, {name: label, type: string, size: 8}, "
        + '{name: path, type: "byte[]", size: 4}]\n'
        + "    modes: {SLOW: {speed: 0.5, label: slow}, FAST: {speed: $(parent speed), path: [1, 2]}}\n"
        + "profiles: [managed_service]\ncomponents: [+node_modes]\nerrors: code\n",
        "tasks": _BUSY
        + "    publishers: [{topic: sure, type: std_msgs/msg/Int32}]\n"
        + "    timers: [{name: tick, period: 50 ms}]\n    executors: [{name: all}]\n"
        + "profiles: [pure_sender]\ncomponents: [+executor, +timers]\nerrors: code\n"
        + "tasks: [{name: all, executor: all, rate: 20 Hz, overrun: call}]\nwatchdog: {margin: 50 ms}\n"
        + "transport: {type: tcp, agent: '10.0.0.1:8888'}\n",
        "tasks-custom": _BUSY
        + "    publishers: [{topic: sure, type: std_msgs/msg/Int32}]\n    executors: [{name: all}]\n"
        + "profiles: [pure_sender]\ncomponents: [+executor]\nerrors: code\n"
        + "tasks: [{name: all, executor: all, rate: 20 Hz}]\ntransport: {type: custom}\n",
        "agents-of-lines": _POOL
        + "components: [+agents]\ntransport: {type: serial, agents: [/dev/ttyS0, /dev/ttyS1]}\n",
        "graph": _BUSY
        + "profiles: [pure_sender]\ncomponents: [+graph]\nmemory: {arena: 4096}\nerrors: code\n",
        "graph-events": _BUSY
        + "profiles: [pure_sender]\ncomponents: [+graph_events]\nmemory: {arena: 4096}\nerrors: code\n",
        "graph-topic": _BUSY
        + "profiles: [pure_sender]\ncomponents: [+graph_topic]\nmemory: {arena: 4096}\nerrors: code\n",
        "parameter-storage": _BUSY
        + "    parameters: [{name: gain, type: double}]\n"
        + "profiles: [pure_sender]\ncomponents: [+parameter_storage]\n",
        "transforms": _BUSY
        + "profiles: [pure_sender]\ncomponents: [+tf_broadcaster, +clock_stamp]\nerrors: code\n",
        "logging": _POOL
        + "components: [+logging_float, +logging_wide]\nlogging: [{to: console, level: debug}, callback]\n",
        "rosout": _BUSY + "profiles: [pure_sender]\nlogging: [rosout, console]\n",
        "ring": _BUSY
        + "profiles: [pure_sender]\nlogging: [{to: rosout, level: warn}, {to: ring, level: debug}]\n",
        "logger-services": _BUSY
        + "profiles: [pure_sender]\ncomponents: [+logger_services]\nlogging: callback\nerrors: code\n",
        "logging-callback-codes": _POOL + "logging: callback\nerrors: code\n",
        "custom-packets-threads": _BUSY
        + _ASKS
        + "profiles: [pure_sender]\ncomponents: [-publish, +services, +executor, +multithread]\n"
        + "transport: {type: custom, framing: false}\n",
    }
)
"""Application files by name."""
FIRST = ("pool", "reader", "server-binary-timers-sleep", "client-xml-code-rtos-timers-threads")
"""Those whose symbols the default suite looks at; `make lint` looks at the others."""
ALSO = (
    "pool-acknack-block-xml-reliable",
    "best-effort-none-code",
    "best-effort-ping-drop",
    "reader-code-none-preconfigured",
    "reader-pool-xml",
)
"""Those of the long run: the others together select every file of the components that are ready."""


@dataclass(frozen=True)
class Compiled:
    """Objects of a tree by the source that each was made from, `src/…` or `examples/…`."""

    objects: Mapping[str, Path]


@dataclass(frozen=True)
class Tree:
    """One generated output folder."""

    name: str
    out: Path

    @property
    def sources(self) -> tuple[str, ...]:
        """The library's sources as sources.txt lists them."""
        return tuple((self.out / "sources.txt").read_text(encoding="utf-8").splitlines())

    @property
    def example(self) -> str:
        """The example's only source."""
        (path,) = (self.out / "examples").glob("*/main.c")
        return path.relative_to(self.out).as_posix()

    @property
    def headers(self) -> tuple[str, ...]:
        """The headers of what is selected: those that are not one `#error`."""
        return tuple(h for h in self.all_headers if not self.is_refusal(h))

    @property
    def all_headers(self) -> tuple[str, ...]:
        """Every header below include/, as an application includes it."""
        folder = self.out / "include"
        return tuple(sorted(p.relative_to(folder).as_posix() for p in folder.rglob("*.h")))

    def is_refusal(self, header: str) -> bool:
        """Whether `header` belongs to a component that is not selected."""
        return '#error "The component' in (self.out / "include" / header).read_text(encoding="utf-8")


def make_tree(name: str, text: str, folder: Path) -> Tree:
    """Generate the application `text` below `folder`."""
    folder.mkdir(parents=True)
    config = folder / "microros.yaml"
    config.write_text(text, encoding="utf-8")
    (folder / "rules.yaml").write_text(_RULES, encoding="utf-8")
    messages = folder / "interfaces" / "wide_msgs" / "msg"
    messages.mkdir(parents=True)
    (messages / "Wide.msg").write_text(_WIDE, encoding="utf-8")
    if name in SYSTEMS:
        (folder / "system.yaml").write_text(SYSTEMS[name], encoding="utf-8")
        (folder / "other.yaml").write_text(_of_numbers(OTHERS[name]), encoding="utf-8")
    if name in THIRDS:
        (folder / "third.yaml").write_text(_of_numbers(THIRDS[name]), encoding="utf-8")
    options = compiler.Options(config=config, interface_paths=(shipped_folder(),))
    out = compiler.generate(options, folder / "out").out
    return Tree(name, out)


def check(command: Sequence[str], folder: Path) -> str:
    """Run `command` in `folder`; return what it printed, and fail with it when its status is not 0."""
    result = subprocess.run(
        list(command), cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False
    )
    assert result.returncode == 0, f"{' '.join(command)}\n{result.stdout}"
    return result.stdout


def compile_tree(
    tree: Tree, compiler: str, flags: Iterable[str], sources: Iterable[str], folder: Path
) -> Compiled:
    """Compile each of `sources` with the project's warnings to an object below `folder`."""
    groups: dict[Path, list[str]] = {}
    for source in sources:
        groups.setdefault(folder / Path(source).parent, []).append(source)
    common = [compiler, *WARNINGS, *flags, f"-I{tree.out / 'include'}", "-c"]
    for target, group in groups.items():  # a compiler that gets many sources writes into the current folder
        target.mkdir(parents=True, exist_ok=True)
        check([*common, *(str(tree.out / source) for source in group)], target)
    objects = {source: (folder / source).with_suffix(".o") for group in groups.values() for source in group}
    return Compiled(MappingProxyType(objects))


def has(program: str) -> bool:
    """Whether `program` is on the PATH."""
    return shutil.which(program) is not None
