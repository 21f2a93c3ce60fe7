# SPDX-License-Identifier: Apache-2.0
"""For each key of the application file: a value that is taken, what it becomes, and one that is refused."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from typing import Any

from microros_gen.application.model import Application, LimitRule, ParameterDecl, TimerDecl
from microros_gen.application.silence import SilenceDecl
from tests.support.application.diagnosis_cases import DIAGNOSIS_CASES
from tests.support.application.key_case import KeyCase
from tests.support.application.task_cases import TASK_CASES
from tests.support.application.time_source_cases import TIME_SOURCE_CASES


def _node(app: Application) -> Any:
    return app.nodes[0]


def _system(application: Application) -> tuple[str, str]:
    reference = application.system
    assert reference is not None
    return reference.file.name, reference.board.name


def _member(key: str, application: Application) -> object:
    return getattr(_endpoint(application), key)


def _endpoint(app: Application) -> Any:
    return app.nodes[0].endpoints[0]


def _qos(key: str, app: Application) -> Any:
    return getattr(_endpoint(app).qos, key)


def _time(key: str, app: Application) -> Any:
    return getattr(app.times, key)


def _pool(key: str, app: Application) -> Any:
    return app.pools[key]


def _named(value: Any) -> Any:
    return value.name


def _names(items: Any) -> list[str]:
    return [item.name for item in items]


def _rules(rules: tuple[LimitRule, ...]) -> list[tuple[Any, ...]]:
    return [(r.path, r.string, r.sequence, r.single) for r in rules]


def _writers(app: Application) -> list[tuple[str, str]]:
    return [(writer.to, writer.level) for writer in app.logging]


def _in_node(text: str) -> str:
    return f"nodes:\n  - name: n\n    {text}\n"


def _timer(t: TimerDecl) -> tuple[Any, ...]:
    return t.name, t.period_us


def _parameter(p: ParameterDecl) -> tuple[Any, ...]:
    return p.name, p.type, p.default


def _endpoint_cases(
    key: str, kind: str, name_key: str, type_name: str, wrong_type: str
) -> dict[str, KeyCase]:
    def one(rest: str) -> str:
        return _in_node(f"{key}: [{{{rest}}}]")

    start = 8 + len(key)  # column after `    key: [{`
    path = f"nodes[].{key}[]"
    entry = f"{name_key}: a/b, type: {type_name}"
    cases = {
        f"nodes[].{key}": KeyCase(
            one(entry),
            lambda a: [(e.kind, e.topic, e.type) for e in _node(a).endpoints],
            [(kind, "a/b", type_name)],
            _in_node(f"{key}: 3"),
            f"3:{start - 1}",
            f"'nodes[0].{key}' must be a list; it is 3. Write it as a list: [3]",
        ),
        f"{path}.{name_key}": KeyCase(
            one(entry),
            lambda a: _endpoint(a).topic,
            "a/b",
            one(f"{name_key}: 3, type: {type_name}"),
            f"3:{start + 3 + len(name_key)}",
            f"'nodes[0].{key}[0].{name_key}' must be a",
        ),
        f"{path}.type": KeyCase(
            one(entry),
            lambda a: _endpoint(a).type,
            type_name,
            one(f"{name_key}: a, type: {wrong_type}"),
            f"3:{start + 12 + len(name_key)}",
            f"'nodes[0].{key}[0].type' must be a",
        ),
        f"{path}.limits": KeyCase(
            one(f"{entry}, limits: {{string: 5, sequence: 6, data: 7}}"),
            lambda a: _rules(_endpoint(a).limits),
            [(("*",), 5, 6, False), ((type_name, "data"), 7, 7, True)],
            one(f"{name_key}: a, type: {type_name}, limits: 7"),
            f"3:{start + 22 + len(name_key) + len(type_name)}",
            f"'nodes[0].{key}[0].limits' must be a mapping such as {{string: 32, sequence: 8}}",
        ),
    }
    for word in ("local", "peer"):
        cases[f"{path}.{word}"] = KeyCase(
            one(f"{entry}, {word}: also"),
            partial(_member, word),
            "also",
            one(f"{name_key}: a, type: {type_name}, {word}: yes"),
            f"3:{start + 16 + len(word) + len(name_key) + len(type_name)}",
            f"'nodes[0].{key}[0].{word}' must be ",
        )
    if kind == "publisher":
        cases[f"{path}.managed"] = KeyCase(
            one(f"{entry}, managed: true"),
            lambda a: _endpoint(a).managed,
            True,
            one(f"{name_key}: a, type: {type_name}, managed: 1"),
            f"3:{start + 23 + len(name_key) + len(type_name)}",
            f"'nodes[0].{key}[0].managed' must be ",
        )
        cases[f"{path}.rate"] = KeyCase(
            one(f"{entry}, rate: 1.5 kHz"),
            lambda a: _endpoint(a).interval_us,
            Fraction(2000, 3),
            one(f"{name_key}: a, type: {type_name}, rate: 0 Hz"),
            f"3:{start + 20 + len(name_key) + len(type_name)}",
            f"'nodes[0].{key}[0].rate' must be a rate above 0 such as 100 Hz or 1 kHz; it is the text '0 Hz'",
        )
    if kind != "publisher":
        cases[f"{path}.queue"] = KeyCase(
            one(f"{entry}, queue: 3"),
            lambda a: _endpoint(a).queue,
            3,
            one(f"{name_key}: a, type: {type_name}, queue: 0"),
            f"3:{start + 21 + len(name_key) + len(type_name)}",
            f"'nodes[0].{key}[0].queue' must be a whole number between 1 and 250; it is 0",
        )
        cases[f"{path}.queue_bytes"] = KeyCase(
            one(f"{entry}, queue_bytes: 300"),
            lambda a: _endpoint(a).queue_bytes,
            300,
            one(f"{name_key}: a, type: {type_name}, queue_bytes: 3"),
            f"3:{start + 27 + len(name_key) + len(type_name)}",
            f"'nodes[0].{key}[0].queue_bytes' must be a whole number between 4 and 16777216; it is 3",
        )
        cases[f"{path}.storage"] = KeyCase(
            one(f"{entry}, storage: none"),
            lambda a: _endpoint(a).stored,
            False,
            one(f"{name_key}: a, type: {type_name}, storage: mine"),
            f"3:{start + 23 + len(name_key) + len(type_name)}",
            f"'nodes[0].{key}[0].storage' must be ",
        )
    if name_key == "topic":
        for qos, value, wrong in (
            ("reliability", "best_effort", "best"),
            ("durability", "transient_local", "transient"),
            ("history", "keep_all", "all"),
            ("depth", 3, "0"),
        ):
            cases[f"{path}.qos.{qos}"] = KeyCase(
                one(f"{entry}, qos: {{{qos}: {value}}}"),
                partial(_qos, qos),
                value,
                one(f"topic: a, type: {type_name}, qos: {{{qos}: {wrong}}}"),
                f"3:{start + 27 + len(type_name) + len(qos)}",
                f"'nodes[0].{key}[0].qos.{qos}' must be ",
            )
        for time in ("deadline", "lifespan"):
            cases[f"{path}.qos.{time}"] = KeyCase(
                one(f"{entry}, qos: {{{time}: 1.5 s}}"),
                partial(_qos, f"{time}_ms"),
                1500,
                one(f"topic: a, type: {type_name}, qos: {{{time}: 5}}"),
                f"3:{start + 35 + len(type_name)}",
                f"'nodes[0].{key}[0].qos.{time}' must be a time with its unit such as 20 ms",
            )
        cases[f"{path}.qos.liveliness"] = KeyCase(
            one(f"{entry}, qos: {{liveliness: automatic}}"),
            lambda a: _endpoint(a).qos.depth,
            10,
            one(f"topic: a, type: {type_name}, qos: {{liveliness: manual_by_topic}}"),
            f"3:{start + 37 + len(type_name)}",
            f"'nodes[0].{key}[0].qos.liveliness' must be automatic",
        )
        cases[f"{path}.qos"] = KeyCase(
            one(f"{entry}, qos: {{depth: 2}}"),
            lambda a: _endpoint(a).qos.depth,
            2,
            one(f"topic: a, type: {type_name}, qos: sensor_data"),
            f"3:{start + 24 + len(type_name)}",
            f"'nodes[0].{key}[0].qos' must be a mapping of keys and values; it is the text 'sensor_data'",
        )
    return cases


_TOP = {
    "version": KeyCase(
        "version: 1", lambda a: a.distro, "jazzy", "version: 2", "1:10", "'version' must be 1; it is 2"
    ),
    "distro": KeyCase(
        "distro: kilted",
        lambda a: a.distro,
        "kilted",
        "distro: humble",
        "1:9",
        "'distro' must be jazzy or kilted",
    ),
    "profiles": KeyCase(
        "profiles: [pure_sender, own.yaml]",
        lambda a: _names(a.profiles),
        ["pure_sender", "own.yaml"],
        "profiles: [3]",
        "1:12",
        "'profiles[0]' must be a text; it is 3. Put it into quotes: \"3\"",
    ),
    "components": KeyCase(
        "components: [+timers, -ping, clock]",
        lambda a: [(c.name, c.add) for c in a.components],
        [("timers", True), ("ping", False), ("clock", True)],
        "components: [+Timers]",
        "1:14",
        "'components[0]' must be a component to add or drop such as +timers or -ping, or a folder such as "
        "./my_component; it is the text '+Timers'",
    ),
    "creation": KeyCase(
        "creation: reliable",
        lambda a: _named(a.creation),
        "reliable",
        "creation: realiable",
        "1:11",
        "'creation' must be best_effort or reliable; it is the text 'realiable'. Did you mean 'reliable'?",
    ),
    "entities": KeyCase(
        "entities: xml",
        lambda a: _named(a.entities),
        "xml",
        "entities: XML",
        "1:11",
        "'entities' must be preconfigured,",
    ),
    "liveliness": KeyCase(
        "liveliness: none",
        lambda a: _named(a.liveliness),
        "none",
        "liveliness: null",
        "1:13",
        "'liveliness' must be ping, acknack or none; it is empty",
    ),
    "logging": KeyCase(
        "logging: [callback, {to: console, level: debug}]",
        _writers,
        [("callback", "info"), ("console", "debug")],
        "logging: printer",
        "1:10",
        "'logging' must be console, callback, rosout or ring, or a list of such writers; it is the text 'printer'",
    ),
    "logging[].to": KeyCase(
        "logging: [{to: callback}]",
        _writers,
        [("callback", "info")],
        "logging: [{to: file}]",
        "1:16",
        "'logging[0].to' must be console, callback, rosout or ring",
    ),
    "logging[].size": KeyCase(
        "logging: [{to: rosout, size: 2 KiB}]",
        lambda a: [writer.size for writer in a.logging],
        [2048],
        "logging: [{to: rosout, size: much}]",
        "1:30",
        "'logging[0].size' must be a size in bytes such as 8192",
    ),
    "logging[].level": KeyCase(
        "logging: [{to: callback, level: fatal}]",
        _writers,
        [("callback", "fatal")],
        "logging: [{to: callback, level: loud}]",
        "1:33",
        "'logging[0].level' must be debug, info, warn, error or fatal",
    ),
    "clock": KeyCase(
        "clock: ros", lambda a: _named(a.clock), "ros", "clock: sim", "1:8", "'clock' must be steady or ros"
    ),
    "transport": KeyCase(
        "transport: {type: tcp}",
        lambda a: a.transport.type,
        "tcp",
        "transport: udp",
        "1:12",
        "'transport' must be a mapping of keys and values; it is the text 'udp'",
    ),
    "transport.type": KeyCase(
        "transport: {type: serial}",
        lambda a: a.transport.type,
        "serial",
        "transport: {type: upd}",
        "1:19",
        "'transport.type' must be udp, tcp, serial, canfd or custom; it is the text 'upd'. Did you mean 'udp'?",
    ),
    "transport.agent": KeyCase(
        'transport: {agent: "192.168.1.10:9999"}',
        lambda a: (a.transport.host, a.transport.port),
        ("192.168.1.10", 9999),
        "transport: {agent: 3}",
        "1:20",
        "'transport.agent' must be an IPv4 address and a port in quotes",
    ),
    "transport.agents": KeyCase(
        'transport: {agents: ["192.168.1.10:9999", "192.168.1.11:8888"]}',
        lambda a: (a.transport.host, a.transport.port, a.transport.agents),
        ("192.168.1.10", 9999, (("192.168.1.10", 9999), ("192.168.1.11", 8888))),
        'transport: {agents: "192.168.1.10:8888"}',
        "1:21",
        "'transport.agents' must be a list of 2 to 8 addresses",
    ),
    "transport.id": KeyCase(
        "transport: {type: canfd, device: can1, id: 0x1FFFFFFF}",
        lambda a: (a.transport.can_device, a.transport.can_id),
        ("can1", 0x1FFFFFFF),
        "transport: {type: canfd, id: 0x20000000}",
        "1:30",
        "'transport.id' must be a number between 1 and 0x1FFFFFFF",
    ),
    "transport.mtu": KeyCase(
        "transport: {mtu: 0x200}",
        lambda a: (a.transport.mtu, a.transport.mtu_span and a.transport.mtu_span.column),
        (512, 18),
        "transport: {mtu: 63}",
        "1:18",
        "'transport.mtu' must be a whole number between 64 and 65535; it is 63",
    ),
    "transport.device": KeyCase(
        "transport: {type: serial, device: /dev/ttyACM0}",
        lambda a: a.transport.device,
        "/dev/ttyACM0",
        "transport: {type: serial, device: 3}",
        "1:35",
        "'transport.device' must be a text; it is 3",
    ),
    "transport.bitrate": KeyCase(
        "transport: {type: canfd, id: 1, bitrate: 500000}",
        lambda a: a.transport.bitrate,
        500_000,
        "transport: {type: canfd, id: 1, bitrate: 100}",
        "1:42",
        "'transport.bitrate' must be a whole number between 10000 and 8000000; it is 100",
    ),
    "transport.baud": KeyCase(
        "transport: {type: serial, baud: 921600}",
        lambda a: a.transport.baud,
        921600,
        "transport: {type: serial, baud: 100}",
        "1:33",
        "'transport.baud' must be a whole number between 300 and 12000000; it is 100",
    ),
    "transport.send_buffer": KeyCase(
        "transport: {type: serial, send_buffer: 512}",
        lambda a: a.transport.send_buffer,
        512,
        "transport: {type: serial, send_buffer: 8}",
        "1:40",
        "'transport.send_buffer' must be a whole number between 64 and 1048576; it is 8",
    ),
    "transport.seal": KeyCase(
        "transport: {seal: psa}",
        lambda a: a.transport.seal,
        "psa",
        "transport: {seal: aes}",
        "1:19",
        "'transport.seal' must be psa or application; it is the text 'aes'",
    ),
    "transport.framing": KeyCase(
        "transport: {type: custom, framing: false}",
        lambda a: a.transport.framing,
        False,
        "transport: {type: custom, framing: 1}",
        "1:36",
        "'transport.framing' must be true or false; it is 1",
    ),
    "transport.read_polls": KeyCase(
        "transport: {type: custom, framing: false, read_polls: true}",
        lambda a: a.transport.read_polls,
        True,
        "transport: {type: custom, read_polls: 1}",
        "1:39",
        "'transport.read_polls' must be true or false; it is 1",
    ),
    "session": KeyCase(
        "session: {key: device}",
        lambda a: a.session_key,
        "device",
        "session: 3",
        "1:10",
        "'session' must be a mapping of keys and values; it is 3",
    ),
    "session.hard_liveliness": KeyCase(
        "session: {hard_liveliness: 10 s}",
        lambda a: a.hard_liveliness_ms,
        10_000,
        "session: {hard_liveliness: 10}",
        "1:28",
        "'session.hard_liveliness' must be a time with its unit",
    ),
    **{
        f"session.{name}": KeyCase(
            f"session: {{{name}: 2 s}}",
            partial(_time, name),
            2000,
            f"session: {{{name}: 2}}",
            f"1:{13 + len(name)}",
            f"'session.{name}' must be a time with its unit",
        )
        for name in (
            "round_trip",
            "retry_max",
            "heartbeat",
            "liveliness_period",
            "liveliness_timeout",
            "connect_timeout",
            "create_timeout",
            "close_timeout",
        )
    },
    "session.key": KeyCase(
        "session: {key: 0xAABBCCDD}",
        lambda a: a.session_key,
        0xAABBCCDD,
        "session: {key: 0x1AABBCCDD}",
        "1:16",
        "'session.key' must be a number between 1 and 0xFFFFFFFF, or device; it is 0x1AABBCCDD",
    ),
    "target": KeyCase(
        "target: cortex-m4",
        lambda a: (a.target.name, a.target.rtos),
        ("cortex-m4", None),
        "target: [m4]",
        "1:9",
        "'target' must be the name of a target, or a mapping with `name`, `rtos` and `network`; it is a list",
    ),
    "target.name": KeyCase(
        "target: {name: own.yaml}",
        lambda a: a.target.name,
        "own.yaml",
        "target: {name: 4}",
        "1:16",
        "'target.name' must be a text; it is 4",
    ),
    "target.rtos": KeyCase(
        "target: {name: m4, rtos: freertos}",
        lambda a: a.target.rtos and a.target.rtos.name,
        "freertos",
        "target: {name: m4, rtos: no rtos at all, port: 3}",
        "1:42",
        "unknown key 'port' in 'target'",
    ),
    "target.network": KeyCase(
        "target: {name: m4, network: lwip}",
        lambda a: a.target.network and a.target.network.name,
        "lwip",
        "target: {name: m4, network: [lwip]}",
        "1:29",
        "'target.network' must be a text; it is a list",
    ),
    "interfaces": KeyCase(
        "interfaces: [std_msgs, std_msgs/msg/Int32, std_msgs/Bool]",
        lambda a: _names(a.interfaces),
        ["std_msgs", "std_msgs/msg/Int32", "std_msgs/Bool"],
        "interfaces: [std_msgs/msgs/Int32]",
        "1:14",
        "'interfaces[0]' must be a package or a type such as std_msgs or std_msgs/msg/Int32; it is the text",
    ),
    "system": KeyCase(
        "system: {file: ../s.yaml, board: arm}",
        _system,
        ("../s.yaml", "arm"),
        "system: s.yaml",
        "1:9",
        "'system' must be a mapping of keys and values; it is the text 's.yaml'",
    ),
    "system.file": KeyCase(
        "system: {file: s.yaml, board: arm}",
        lambda a: _system(a)[0],
        "s.yaml",
        "system: {file: 3, board: arm}",
        "1:16",
        "'system.file' must be the path of a file; it is 3",
    ),
    "system.board": KeyCase(
        "system: {file: s.yaml, board: arm}",
        lambda a: _system(a)[1],
        "arm",
        "system: {file: s.yaml, board: 3}",
        "1:31",
        "'system.board' must be the name of a board; it is 3",
    ),
    "interface_paths": KeyCase(
        "interface_paths: [../msgs, own_msgs]",
        lambda a: _names(a.interface_paths),
        ["../msgs", "own_msgs"],
        "interface_paths: [3]",
        "1:19",
        "'interface_paths[0]' must be the path of a folder; it is 3",
    ),
    "pools": KeyCase(
        "pools: {}",
        lambda a: dict(a.pools),
        {},
        "pools: 4",
        "1:8",
        "'pools' must be a mapping of keys and values",
    ),
    **{
        f"pools.{name}": KeyCase(
            f"pools: {{{name}: 9}}",
            partial(_pool, name),
            9,
            f"pools: {{{name}: {wrong}}}",
            f"1:{11 + len(name)}",
            f"'pools.{name}' must be a whole number between ",
        )
        for name, wrong in {
            "nodes": 251,
            "publishers": -1,
            "subscriptions": 1.5,
            "services": "many",
            "clients": "",
            "timers": "[]",
            "executors": "true",
            "handles": 0,
            "guard_conditions": -1,
            "wait_sets": 0,
            "ros_clocks": 251,
            "jump_callbacks": 0,
            "parameters": 251,
            "loggers": 251,
            "logger_name_size": 7,
            "history": 17,
            "input_history": 0,
            "best_effort_history": 65,
            "queue": 251,
            "name_size": 7,
        }.items()
    },
    "pools.queue_bytes": KeyCase(
        "pools: {queue_bytes: 3000}",
        lambda a: a.pools["queue_bytes"],
        3000,
        "pools: {queue_bytes: 3 KiB}",
        "1:22",
        "'pools.queue_bytes' must be a whole number between ",
    ),
    "pools.slot_size": KeyCase(
        "pools: {slot_size: 512}",
        lambda a: a.pools["slot_size"],
        512,
        "pools: {slot_size: 63}",
        "1:20",
        "'pools.slot_size' must be a whole number between ",
    ),
    "limits": KeyCase(
        'limits:\n  "*": {string: 32, sequence: 8}\n  a/msg/B: {c: 6, d: {sequence: 6, e: '
        "{string: 2}}, string: 3}\n",
        lambda a: _rules(a.limits),
        [
            (("*",), 32, 8, False),
            (("a/msg/B",), 3, None, False),
            (("a/msg/B", "c"), 6, 6, True),
            (("a/msg/B", "d"), None, 6, False),
            (("a/msg/B", "d", "e"), 2, None, False),
        ],
        "limits: {std_msgs/String: {string: 1}}",
        "1:10",
        "the keys of 'limits' must be \"*\" or types such as sensor_msgs/msg/Imu; 'std_msgs/String' is not. "
        "Write std_msgs/msg/String",
    ),
    "endpoints": KeyCase(
        'endpoints: {/diagnostics: {depth: 2, limits: {status: 3}}, "~/ask": {queue: 1, limits: {string: 9}}}\n',
        lambda a: [(e.name, e.depth, e.queue, _rules(e.limits)) for e in a.endpoints],
        [
            ("/diagnostics", 2, None, [(("", "status"), 3, 3, True)]),
            ("~/ask", None, 1, [(("*",), 9, None, False)]),
        ],
        "endpoints: {/diagnostics: {length: 2}}",
        "1:28",
        "unknown key 'length' in 'endpoints[\"/diagnostics\"]'. Known: depth, queue, limits",
    ),
    "memory": KeyCase(
        "memory: {}",
        lambda a: a.memory.arena,
        0,
        "memory: 8 KiB",
        "1:9",
        "'memory' must be a mapping of keys",
    ),
    "memory.arena": KeyCase(
        "memory: {arena: 512}",
        lambda a: a.memory.arena,
        512,
        "memory: {arena: -1}",
        "1:17",
        "'memory.arena' must be a size in bytes such as 8192, 8 KiB or 2 kB (units B, kB, KiB, "
        "MB, MiB); it is -1",
    ),
    "memory.messages": KeyCase(
        "memory: {messages: 3}",
        lambda a: a.memory.messages,
        3,
        "memory: {messages: -1}",
        "1:20",
        "'memory.messages' must be",
    ),
    "memory.ram_budget": KeyCase(
        "memory: {ram_budget: 8 KiB}",
        lambda a: a.memory.ram_budget,
        8192,
        "memory: {ram_budget: 8 KB}",
        "1:22",
        "'memory.ram_budget' must be a size in bytes",
    ),
    "memory.flash_budget": KeyCase(
        "memory: {flash_budget: 2 kB}",
        lambda a: a.memory.flash_budget,
        2000,
        "memory: {flash_budget: 1.5 kB}",
        "1:24",
        "'memory.flash_budget' must be a size in bytes",
    ),
    "memory.stack": KeyCase(
        "memory: {stack: 1MiB}",
        lambda a: a.memory.stack,
        1048576,
        "memory: {stack: 2.5}",
        "1:17",
        "'memory.stack' must be a size in bytes",
    ),
    "on_full": KeyCase(
        "on_full: block 20 ms",
        lambda a: (a.on_full, a.on_full_block_ms),
        ("block", 20),
        "on_full: block",
        "1:10",
        "'on_full' must be error, drop_oldest, or block with its longest time (block 20 ms); it "
        "is the text 'block'",
    ),
    "errors": KeyCase(
        "errors: code",
        lambda a: a.error_text,
        False,
        "errors: texts",
        "1:9",
        "'errors' must be text or code; it is",
    ),
    "float64": KeyCase(
        "float64: exact",
        lambda a: a.exact_float64,
        True,
        "float64: rounded",
        "1:10",
        "'float64' must be converted or exact; it is",
    ),
    "nodes": KeyCase(
        "nodes: [{name: a}, {name: b}]",
        lambda a: _names(a.nodes),
        ["a", "b"],
        "nodes: {name: a}",
        "1:8",
        "'nodes' must be a list; it is a mapping. Write [{name: a}]",
    ),
}

_NODES = {
    "nodes[].name": KeyCase(
        "nodes: [{name: Imu_1}]",
        lambda a: (_node(a).name, _node(a).name_span.column),
        ("Imu_1", 16),
        "nodes: [{name: [a]}]",
        "1:16",
        "'nodes[0].name' must be a node name of letters, digits and _ that does not begin with a "
        "digit; it is a list",
    ),
    "nodes[].namespace": KeyCase(
        "nodes: [{name: a, namespace: robot/arm}]",
        lambda a: _node(a).namespace,
        "/robot/arm",
        "nodes: [{name: a, namespace: 3}]",
        "1:30",
        "'nodes[0].namespace' must be a namespace such as /robot; it is 3",
    ),
    "nodes[].domain_id": KeyCase(
        "nodes: [{name: a, domain_id: 232}]",
        lambda a: _node(a).domain_id,
        232,
        "nodes: [{name: a, domain_id: 233}]",
        "1:30",
        "'nodes[0].domain_id' must be a whole number between 0 and 232, or 255 for the agent's own; it is 233",
    ),
    "nodes[].remap": KeyCase(
        "nodes: [{name: a, remap: {__ns: /b}}]",
        lambda a: (_node(a).namespace, _node(a).given_namespace),
        ("/b", "/"),
        "nodes: [{name: a, remap: [b]}]",
        "1:26",
        "'nodes[0].remap' must be a mapping such as {imu/data: /left/imu, __ns: /left}; it is a list",
    ),
    "nodes[].timers": KeyCase(
        _in_node("timers: [{name: t, period: 1.5 ms}]"),
        lambda a: [_timer(t) for t in _node(a).timers],
        [("t", 1500)],
        _in_node("timers: {name: t}"),
        "3:13",
        "'nodes[0].timers' must be a list; it is a mapping",
    ),
    "nodes[].timers[].name": KeyCase(
        _in_node("timers: [{name: t_1, period: 1 s}]"),
        lambda a: _node(a).timers[0].name,
        "t_1",
        _in_node("timers: [{name: T, period: 1 s}]"),
        "3:21",
        "'nodes[0].timers[0].name' must be a name of lower-case letters, digits and _ that "
        "begins with a letter",
    ),
    "nodes[].timers[].kind": KeyCase(
        _in_node("timers: [{name: t, period: 1 s, kind: rtos}]"),
        lambda a: _node(a).timers[0].kind,
        "rtos",
        _in_node("timers: [{name: t, period: 1 s, kind: os}]"),
        "3:43",
        "'nodes[0].timers[0].kind' must be clock, rtos or hardware; it is the text 'os'",
    ),
    "nodes[].timers[].managed": KeyCase(
        _in_node("timers: [{name: t, period: 1 s, managed: true}]"),
        lambda a: _node(a).timers[0].managed,
        True,
        _in_node("timers: [{name: t, period: 1 s, managed: 1}]"),
        "3:46",
        "'nodes[0].timers[0].managed' must be ",
    ),
    "nodes[].modes": KeyCase(
        _in_node("modes: {SLOW: {gain: 0.5, gains: {p: $(parent p)}}}"),
        lambda a: [(m.name, [(v.parameter, v.value, v.parent) for v in m.values]) for m in _node(a).modes],
        [("__DEFAULT__", []), ("SLOW", [("gain", 0.5, ""), ("gains.p", None, "p")])],
        _in_node("modes: {SLOW: 0.5}"),
        "3:19",
        "'nodes[0].modes.SLOW' must be a mapping such as {speed: 0.2}; it is 0.5",
    ),
    "nodes[].timers[].period": KeyCase(
        _in_node("timers: [{name: t, period: 50us}]"),
        lambda a: _node(a).timers[0].period_us,
        50,
        _in_node("timers: [{name: t, period: 10}]"),
        "3:32",
        "'nodes[0].timers[0].period' must be a time with its unit such as 20 ms (units us, ms, s); it is 10",
    ),
    "nodes[].actions": KeyCase(
        _in_node("actions: [{name: f, type: p/action/F}]"),
        lambda a: [action.name for action in _node(a).actions],
        ["f"],
        _in_node("actions: f"),
        "3:14",
        "'nodes[0].actions' must be",
    ),
    "nodes[].actions[].name": KeyCase(
        _in_node("actions: [{name: f, type: p/action/F}]"),
        lambda a: _node(a).actions[0].name,
        "f",
        _in_node("actions: [{name: 3, type: p/action/F}]"),
        "3:22",
        "'nodes[0].actions[0].name' must be an action name such as fibonacci or ~/fibonacci; it is 3",
    ),
    "nodes[].actions[].type": KeyCase(
        _in_node("actions: [{name: f, type: p/action/F}]"),
        lambda a: _node(a).actions[0].type,
        "p/action/F",
        _in_node("actions: [{name: f, type: p/msg/F}]"),
        "3:31",
        "'nodes[0].actions[0].type' must be an action type such as example_interfaces/action/Fibonacci",
    ),
    "nodes[].actions[].goals": KeyCase(
        _in_node("actions: [{name: f, type: p/action/F, goals: 7}]"),
        lambda a: _node(a).actions[0].goals,
        7,
        _in_node("actions: [{name: f, type: p/action/F, goals: 0}]"),
        "3:50",
        "'nodes[0].actions[0].goals' must be",
    ),
    "nodes[].actions[].result_timeout": KeyCase(
        _in_node("actions: [{name: f, type: p/action/F, result_timeout: 2 s}]"),
        lambda a: _node(a).actions[0].result_timeout_ms,
        2000,
        _in_node("actions: [{name: f, type: p/action/F, result_timeout: 2}]"),
        "3:59",
        "'nodes[0].actions[0].result_timeout' must be",
    ),
    "nodes[].actions[].waiting": KeyCase(
        _in_node("actions: [{name: f, type: p/action/F, waiting: 3}]"),
        lambda a: _node(a).actions[0].waiting,
        3,
        _in_node("actions: [{name: f, type: p/action/F, waiting: 17}]"),
        "3:52",
        "'nodes[0].actions[0].waiting' must be",
    ),
    "nodes[].actions[].limits": KeyCase(
        _in_node("actions: [{name: f, type: p/action/F, limits: {string: 5, sequence: 6}}]"),
        lambda a: _rules(_node(a).actions[0].limits),
        [(("*",), 5, 6, False)],
        _in_node("actions: [{name: f, type: p/action/F, limits: 7}]"),
        "3:51",
        "'nodes[0].actions[0].limits' must be a mapping with string and sequence",
    ),
    "nodes[].action_clients": KeyCase(
        _in_node("action_clients: [{name: f, type: p/action/F}]"),
        lambda a: [action.name for action in _node(a).action_clients],
        ["f"],
        _in_node("action_clients: f"),
        "3:21",
        "'nodes[0].action_clients' must be",
    ),
    "nodes[].action_clients[].name": KeyCase(
        _in_node("action_clients: [{name: f, type: p/action/F}]"),
        lambda a: _node(a).action_clients[0].name,
        "f",
        _in_node("action_clients: [{name: 3, type: p/action/F}]"),
        "3:29",
        "'nodes[0].action_clients[0].name' must be an action name such as fibonacci or ~/fibonacci; it is 3",
    ),
    "nodes[].action_clients[].type": KeyCase(
        _in_node("action_clients: [{name: f, type: p/action/F}]"),
        lambda a: _node(a).action_clients[0].type,
        "p/action/F",
        _in_node("action_clients: [{name: f, type: p/msg/F}]"),
        "3:38",
        "'nodes[0].action_clients[0].type' must be an action type such as example_interfaces/action/Fibonacci",
    ),
    "nodes[].action_clients[].goals": KeyCase(
        _in_node("action_clients: [{name: f, type: p/action/F, goals: 7}]"),
        lambda a: _node(a).action_clients[0].goals,
        7,
        _in_node("action_clients: [{name: f, type: p/action/F, goals: 0}]"),
        "3:57",
        "'nodes[0].action_clients[0].goals' must be",
    ),
    "nodes[].action_clients[].result_timeout": KeyCase(
        _in_node("action_clients: [{name: f, type: p/action/F, result_timeout: 2 s}]"),
        lambda a: _node(a).action_clients[0].result_timeout_ms,
        2000,
        _in_node("action_clients: [{name: f, type: p/action/F, result_timeout: 2}]"),
        "3:66",
        "'nodes[0].action_clients[0].result_timeout' must be",
    ),
    "nodes[].action_clients[].response_timeout": KeyCase(
        _in_node("action_clients: [{name: f, type: p/action/F, response_timeout: 2 s}]"),
        lambda a: _node(a).action_clients[0].response_timeout_ms,
        2000,
        _in_node("action_clients: [{name: f, type: p/action/F, response_timeout: 2}]"),
        "3:68",
        "'nodes[0].action_clients[0].response_timeout' must be",
    ),
    "nodes[].action_clients[].limits": KeyCase(
        _in_node("action_clients: [{name: f, type: p/action/F, limits: {string: 5, sequence: 6}}]"),
        lambda a: _rules(_node(a).action_clients[0].limits),
        [(("*",), 5, 6, False)],
        _in_node("action_clients: [{name: f, type: p/action/F, limits: 7}]"),
        "3:58",
        "'nodes[0].action_clients[0].limits' must be a mapping with string and sequence",
    ),
    "nodes[].parameter_clients": KeyCase(
        _in_node("parameter_clients: [/motor]"),
        lambda a: [client.node for client in _node(a).parameter_clients],
        ["/motor"],
        _in_node("parameter_clients: [3]"),
        "3:25",
        "'nodes[0].parameter_clients[0]' must be the name of a node, or a mapping such as",
    ),
    "nodes[].parameter_clients[].node": KeyCase(
        _in_node("parameter_clients: [{node: motor}]"),
        lambda a: _node(a).parameter_clients[0].node,
        "/motor",
        _in_node("parameter_clients: [{node: 3}]"),
        "3:32",
        "'nodes[0].parameter_clients[0].node' must be a text; it is 3",
    ),
    "nodes[].parameter_clients[].operations": KeyCase(
        _in_node("parameter_clients: [{node: /motor, operations: [list, watch]}]"),
        lambda a: _node(a).parameter_clients[0].operations,
        ("list", "watch"),
        _in_node("parameter_clients: [{node: /motor, operations: [gets]}]"),
        "3:53",
        "'nodes[0].parameter_clients[0].operations[0]' must be get, set, set_atomically, list, describe, "
        "get_types or watch",
    ),
    "nodes[].parameter_clients[].parameters": KeyCase(
        _in_node("parameter_clients: [{node: /motor, parameters: 7}]"),
        lambda a: _node(a).parameter_clients[0].parameters,
        7,
        _in_node("parameter_clients: [{node: /motor, parameters: 0}]"),
        "3:52",
        "'nodes[0].parameter_clients[0].parameters' must be",
    ),
    "nodes[].parameter_clients[].types": KeyCase(
        _in_node("parameter_clients: [{node: /motor, types: ['bool[]'], elements: 2}]"),
        lambda a: _node(a).parameter_clients[0].types,
        ("bool[]",),
        _in_node("parameter_clients: [{node: /motor, types: [bool]}]"),
        "3:48",
        "'nodes[0].parameter_clients[0].types[0]' must be",
    ),
    "nodes[].parameter_clients[].description": KeyCase(
        _in_node("parameter_clients: [{node: /motor, description: 9}]"),
        lambda a: _node(a).parameter_clients[0].description,
        9,
        _in_node("parameter_clients: [{node: /motor, description: -1}]"),
        "3:53",
        "'nodes[0].parameter_clients[0].description' must be",
    ),
    "nodes[].parameter_clients[].string": KeyCase(
        _in_node("parameter_clients: [{node: /motor, string: 0}]"),
        lambda a: _node(a).parameter_clients[0].string,
        0,
        _in_node("parameter_clients: [{node: /motor, string: -1}]"),
        "3:48",
        "'nodes[0].parameter_clients[0].string' must be",
    ),
    "nodes[].parameter_clients[].elements": KeyCase(
        _in_node("parameter_clients: [{node: /motor, elements: 9}]"),
        lambda a: _node(a).parameter_clients[0].elements,
        9,
        _in_node("parameter_clients: [{node: /motor, elements: 65536}]"),
        "3:50",
        "'nodes[0].parameter_clients[0].elements' must be",
    ),
    "nodes[].parameters": KeyCase(
        _in_node("parameters: [{name: gain, type: double, default: 2}]"),
        lambda a: [_parameter(p) for p in _node(a).parameters],
        [("gain", "double", 2)],
        _in_node("parameters: gain"),
        "3:17",
        "'nodes[0].parameters' must be a list of parameters, or a mapping with `at`, `file` and `declare`; it is",
    ),
    "nodes[].parameters.at": KeyCase(
        _in_node("parameters: {at: device, declare: [{name: a, type: bool}]}"),
        lambda a: _node(a).parameters[0].name,
        "a",
        _in_node("parameters: {at: cloud}"),
        "3:22",
        "'nodes[0].parameters.at' must be device or agent; it is the text 'cloud'",
    ),
    "nodes[].parameters.file": KeyCase(
        _in_node("parameters: {file: motor.yaml}"),
        lambda a: _node(a).parameter_file.name,
        "motor.yaml",
        _in_node("parameters: {file: 3}"),
        "3:24",
        "'nodes[0].parameters.file' must be a text; it is 3",
    ),
    "nodes[].parameters.declare": KeyCase(
        _in_node("parameters: {declare: [{name: a, type: bool}]}"),
        lambda a: _parameter(_node(a).parameters[0]),
        ("a", "bool", None),
        _in_node("parameters: {declare: 3}"),
        "3:27",
        "'nodes[0].parameters.declare' must be a list",
    ),
    "nodes[].parameters[].name": KeyCase(
        _in_node("parameters: [{name: motor.gain, type: bool}]"),
        lambda a: _node(a).parameters[0].name,
        "motor.gain",
        _in_node("parameters: [{name: motor gain, type: bool}]"),
        "3:25",
        "'nodes[0].parameters[0].name' must be a parameter name such as gain or motor.gain; it is the text",
    ),
    "nodes[].parameters[].type": KeyCase(
        _in_node("parameters: [{name: a, type: string}]"),
        lambda a: _node(a).parameters[0].type,
        "string",
        _in_node("parameters: [{name: a, type: float}]"),
        "3:34",
        "'nodes[0].parameters[0].type' must be bool, integer, double, string, byte[]",
    ),
    "nodes[].parameters[].default": KeyCase(
        _in_node("parameters: [{name: a, type: bool, default: true}]"),
        lambda a: _node(a).parameters[0].default,
        True,
        _in_node("parameters: [{name: a, type: bool, default: {}}]"),
        "3:49",
        "'nodes[0].parameters[0].default' must be true or false, a number, a text or a list of them",
    ),
    "nodes[].parameters[].one_of": KeyCase(
        _in_node("parameters: [{name: a, type: integer, default: 1, one_of: [1, 5]}]"),
        lambda a: _node(a).parameters[0].one_of,
        (1, 5),
        _in_node("parameters: [{name: a, type: integer, one_of: 5}]"),
        "3:51",
        "'nodes[0].parameters[0].one_of' must be a list",
    ),
    "nodes[].parameters[].unit": KeyCase(
        _in_node("parameters: [{name: a, type: integer, unit: mm}]"),
        lambda a: _node(a).parameters[0].shown,
        "[mm]",
        _in_node("parameters: [{name: a, type: integer, unit: 5}]"),
        "3:49",
        "'nodes[0].parameters[0].unit' must be a text; it is 5",
    ),
    "nodes[].parameters[].description": KeyCase(
        _in_node("parameters: [{name: a, type: bool, description: Whether}]"),
        lambda a: _node(a).parameters[0].description,
        "Whether",
        _in_node("parameters: [{name: a, type: bool, description: 3}]"),
        "3:53",
        "'nodes[0].parameters[0].description' must be a text; it is 3",
    ),
    "nodes[].parameters[].read_only": KeyCase(
        _in_node("parameters: [{name: a, type: bool, read_only: true}]"),
        lambda a: _node(a).parameters[0].read_only,
        True,
        _in_node("parameters: [{name: a, type: bool, read_only: yes}]"),
        "3:51",
        "'nodes[0].parameters[0].read_only' must be true or false; it is the text 'yes'. "
        "'yes' is a text in YAML 1.2; write true",
    ),
    "nodes[].parameters[].range": KeyCase(
        _in_node("parameters: [{name: a, type: integer, default: 1, range: {min: 1, max: 5, step: 2}}]"),
        lambda a: (
            _node(a).parameters[0].minimum,
            _node(a).parameters[0].maximum,
            _node(a).parameters[0].step,
        ),
        (1, 5, 2),
        _in_node("parameters: [{name: a, type: integer, range: {min: 1}}]"),
        "3:50",
        "missing key 'max' in 'nodes[0].parameters[0].range'. Add `max: 10`",
    ),
    "nodes[].parameters[].range.min": KeyCase(
        _in_node("parameters: [{name: a, type: double, range: {min: -1.5, max: 5}}]"),
        lambda a: _node(a).parameters[0].minimum,
        -1.5,
        _in_node("parameters: [{name: a, type: double, range: {min: low, max: 5}}]"),
        "3:55",
        "'nodes[0].parameters[0].range.min' must be a number; it is the text 'low'",
    ),
    "nodes[].parameters[].range.max": KeyCase(
        _in_node("parameters: [{name: a, type: double, default: 1, range: {min: 1, max: 1e3}}]"),
        lambda a: _node(a).parameters[0].maximum,
        1000.0,
        _in_node("parameters: [{name: a, type: double, range: {min: 1, max: 10:30}}]"),
        "3:63",
        "'nodes[0].parameters[0].range.max' must be a number; it is the text '10:30'. '10:30' is "
        "a text in YAML "
        "1.2; write the number in decimal, or in hex with 0x",
    ),
    "nodes[].parameters[].range.step": KeyCase(
        _in_node("parameters: [{name: a, type: integer, default: 1, range: {min: 1, max: 5, step: 2}}]"),
        lambda a: _node(a).parameters[0].step,
        2,
        _in_node("parameters: [{name: a, type: integer, range: {min: 1, max: 5, step: -2}}]"),
        "3:73",
        "'nodes[0].parameters[0].range.step' must be a number of at least 0; it is -2",
    ),
    "nodes[].parameters[].size": KeyCase(
        _in_node("parameters: [{name: a, type: string, size: 16}]"),
        lambda a: _node(a).parameters[0].size,
        16,
        _in_node("parameters: [{name: a, type: string, size: long}]"),
        "3:48",
        "'nodes[0].parameters[0].size' must be a size in bytes",
    ),
    "nodes[].executors": KeyCase(
        _in_node("executors: [{name: e}]"),
        lambda a: [(e.name, e.handles, e.timeout_us) for e in _node(a).executors],
        [("e", (), None)],
        _in_node("executors: e"),
        "3:16",
        "'nodes[0].executors' must be a list; it is the text 'e'",
    ),
    "nodes[].executors[].name": KeyCase(
        _in_node("executors: [{name: fast}]"),
        lambda a: _node(a).executors[0].name,
        "fast",
        _in_node("executors: [{name: 1}]"),
        "3:24",
        "'nodes[0].executors[0].name' must be a name of lower-case letters",
    ),
    "nodes[].executors[].handles": KeyCase(
        _in_node("executors: [{name: e, handles: [t]}]\n    timers: [{name: t, period: 1 s}]"),
        lambda a: _names(_node(a).executors[0].handles),
        ["t"],
        _in_node("executors: [{name: e, handles: [t, t]}]\n    timers: [{name: t, period: 1 s}]"),
        "3:40",
        "'nodes[0].executors[0].handles' contains 't' twice; first in line 3. Remove one of them",
    ),
    "nodes[].executors[].timeout": KeyCase(
        _in_node("executors: [{name: e, timeout: 2 s}]"),
        lambda a: _node(a).executors[0].timeout_us,
        2_000_000,
        _in_node("executors: [{name: e, timeout: 2 min}]"),
        "3:36",
        "'nodes[0].executors[0].timeout' must be a time with its unit",
    ),
}


def _silence(application: Application) -> SilenceDecl:
    (endpoint,) = application.nodes[0].endpoints
    assert endpoint.silence is not None
    return endpoint.silence


_EXECUTORS: dict[str, KeyCase] = {}

RESERVED = {
    "links": ("links: {}", "1:1", "the key 'links' is reserved for delivery from board to board"),
    "agents": ("agents: [a]", "1:1", "the key 'agents' is reserved for more than one agent"),
    "modes": (
        "modes: {}",
        "1:1",
        "the key 'modes' is reserved for system modes, which this version does not have",
    ),
    "systems": (
        "systems: []",
        "1:1",
        "the key 'systems' is reserved for systems of several devices, which this",
    ),
}

_SILENCE = "subscriptions: [{topic: a, type: std_msgs/msg/Int32, on_silence: "
_SILENCE_PATH = "nodes[0].subscriptions[0].on_silence"
_SILENCES = {
    "nodes[].subscriptions[].on_silence": KeyCase(
        _in_node(_SILENCE + "{after: 500 ms, call: stop}}]"),
        lambda a: (_silence(a).after_ms, _silence(a).call),
        (500, "stop"),
        _in_node(_SILENCE + "stop}]"),
        "3:70",
        f"'{_SILENCE_PATH}' must be a mapping such as {{after: 500 ms, call: stop_motors}}; it is the text 'stop'",
    ),
    "nodes[].subscriptions[].on_silence.after": KeyCase(
        _in_node(_SILENCE + "{after: 1.5 s, call: stop}}]"),
        lambda a: _silence(a).after_ms,
        1500,
        _in_node(_SILENCE + "{after: 5, call: stop}}]"),
        "3:78",
        f"'{_SILENCE_PATH}.after' must be a time with its unit such as 20 ms (units us, ms, s); it is 5",
    ),
    "nodes[].subscriptions[].on_silence.call": KeyCase(
        _in_node(_SILENCE + "{after: 1 s, call: _Go9}}]"),
        lambda a: _silence(a).call,
        "_Go9",
        _in_node(_SILENCE + "{after: 1 s, call: 9go}}]"),
        "3:89",
        f"'{_SILENCE_PATH}.call' must be the name of a C function such as stop_motors; it is the text '9go'",
    ),
}

CASES: dict[str, KeyCase] = {
    **_TOP,
    **_NODES,
    **_EXECUTORS,
    **DIAGNOSIS_CASES,
    **TIME_SOURCE_CASES,
    **TASK_CASES,
    **_endpoint_cases("publishers", "publisher", "topic", "std_msgs/msg/String", "std_msgs/String"),
    **_endpoint_cases("subscriptions", "subscription", "topic", "std_msgs/msg/String", "std_msgs/srv/String"),
    **_SILENCES,
    **_endpoint_cases("services", "service", "name", "std_srvs/srv/SetBool", "std_srvs/SetBool"),
    **_endpoint_cases("clients", "client", "name", "std_srvs/srv/SetBool", "std_srvs/msg/SetBool"),
}
