# SPDX-License-Identifier: Apache-2.0
"""What the application file can get wrong beyond its schema: one tiny input a rule, with the exact place."""

from __future__ import annotations

import pytest

from microros_gen.application.model import Application
from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source
from tests.support.ids import without_id
from tests.support.paths import ROOT

NODE = "nodes:\n  - name: n\n"
PUBLISHER = "{topic: %s, type: std_msgs/msg/Bool}"


def parse(text: str) -> tuple[Application | None, list[str]]:
    found = Diagnostics()
    application = parse_application(Source("f", text), found)
    return application, [without_id(d.headline()) for d in found]


def topic(name: str) -> str:
    return f"{NODE}    publishers: [{PUBLISHER % name}]\n"


# The topic stands in column 26 of line 3.
ERRORS: dict[str, tuple[str, str]] = {
    "hard liveliness of a moment": (
        "session: {hard_liveliness: 20 ms}\n",
        "f:1:28: error: 'session.hard_liveliness' must be between 100 ms and 999 s; it is 20 ms",
    ),
    "hard liveliness of an hour": (
        "session: {hard_liveliness: 3600 s}\n",
        "f:1:28: error: 'session.hard_liveliness' must be between 100 ms and 999 s; it is 3600 s",
    ),
    "a round trip of a moment": (
        "session: {round_trip: 1 ms}\n",
        "f:1:23: error: 'session.round_trip' must be between 10 ms and 60 s; it is 1 ms. Write `round_trip: 300 ms`",
    ),
    "a time-out of a day": (
        "session: {create_timeout: 86400 s}\n",
        "f:1:27: error: 'session.create_timeout' must be between 1 ms and 3600 s; it is 86400 s",
    ),
    "pauses that shrink": (
        "session: {round_trip: 3 s, retry_max: 200 ms}\n",
        "f:1:39: error: 'session.retry_max' is 200 ms, less than `round_trip`. Write `retry_max: 3 s` or more",
    ),
    "a promise about packets on a stream of bytes": (
        "transport: {type: custom, framing: true, read_polls: true}\n",
        "f:1:54: error: 'transport.read_polls' has no effect with frames: their read function always gets a time-out "
        "of 0. Remove `read_polls`, or set framing: false",
    ),
    "a promise about the read function of no application": (
        "transport: {type: udp, read_polls: true}\n",
        "f:1:36: error: transport: udp has no `read_polls`. Remove `read_polls`, or use type: custom",
    ),
    "an MTU for frames that have one size": (
        "transport: {type: canfd, id: 1, mtu: 64}\n",
        "f:1:38: error: transport: canfd has no `mtu`. Remove `mtu`, or use type: udp or tcp or serial or custom",
    ),
    "an agent's address on a bus": (
        'transport: {type: canfd, id: 1, agent: "10.0.0.1:8888"}\n',
        "f:1:40: error: transport: canfd has no agent address. Remove `agent`, or use type: udp or tcp",
    ),
    "the device of no transport with one": (
        "transport: {type: udp, device: can0}\n",
        "f:1:32: error: transport: udp has no `device`. Remove `device`, or use type: serial or canfd",
    ),
    "an identifier of a serial line": (
        "transport: {type: serial, id: 1}\n",
        "f:1:31: error: transport: serial has no `id`. Remove `id`, or use type: canfd",
    ),
    "unknown key": (
        "profles: [a]\n",
        "f:1:1: error: unknown key 'profles' in the file. Did you mean 'profiles'?",
    ),
    "a deadline below a millisecond": (
        f"{NODE}    publishers: [{{topic: a, type: std_msgs/msg/Bool, qos: {{deadline: 1500 us}}}}]\n",
        "f:3:70: error: XRCE carries a deadline in whole milliseconds, up to 4294966 s; it is 1500 us. Round it up",
    ),
    "unknown key, nothing near": (
        "xyzzy: 1\n",
        "f:1:1: error: unknown key 'xyzzy' in the file. Known: version,",
    ),
    "unknown nested key": (
        "transport: {mtuu: 512}\n",
        "f:1:13: error: unknown key 'mtuu' in 'transport'. Did you mean 'mtu'?",
    ),
    "missing key": (
        f"{NODE}    timers: [{{name: t}}]\n",
        "f:3:14: error: missing key 'period' in 'nodes[0].timers[0]'. Add `period: …`",
    ),
    "empty file": ("# only a comment\n", "f:1:1: error: the file is empty. Write `key: value` lines"),
    "not a mapping": (
        "- a\n- b\n",
        "f:1:1: error: the file must be a mapping of keys and values; it is a list",
    ),
    "a profile twice": (
        "profiles: [a,\n  a]\n",
        "f:2:3: error: 'profiles' contains 'a' twice; first in line 1. Remove one of them",
    ),
    "quoted number": (
        "transport: {mtu: '512'}\n",
        "f:1:18: error: 'transport.mtu' must be a whole number between 64 and 65535; it is the text '512'. "
        "Remove the quotes",
    ),
    "old thousands": ("transport: {mtu: 1_472}\n", "f:1:18: error: 'transport.mtu' must be a whole number"),
    "octal": (
        "transport: {mtu: 0512}\n",
        "f:1:18: error: '0512' is octal to some readers of YAML and decimal to others. "
        "Write 512 (decimal), 0o512 (octal) or '0512' (text)",
    ),
    "topic: double slash": (
        topic("imu//data"),
        "f:3:30: error: the topic name 'imu//data' has two slashes in a row. Remove one of them",
    ),
    "topic: ends with a slash": (
        topic("imu/"),
        "f:3:29: error: the topic name 'imu/' ends with a slash. Remove it",
    ),
    "topic: digit": (
        topic("imu/9axis"),
        "f:3:30: error: the topic name 'imu/9axis' has a part that begins with a digit. Begin it "
        "with a letter",
    ),
    "topic: character": (
        topic("imu-data"),
        "f:3:29: error: the topic name 'imu-data' has the character '-'. "
        "Write imu_data. Letters a to z, digits, _ and / ~ { } are allowed",
    ),
    "type: lower case": (
        "nodes: [{name: n, publishers: [{topic: a, type: sensor_msgs/msg/laser_scan}]}]\n",
        "f:1:49: error: 'nodes[0].publishers[0].type' must be a message type such as std_msgs/msg/Int32; it is the "
        "text 'sensor_msgs/msg/laser_scan'. Write sensor_msgs/msg/LaserScan",
    ),
    "topic: quoted": (topic('"imu data"'), "f:3:30: error: the topic name 'imu data' has the character ' '."),
    "topic: empty": (topic("''"), "f:3:26: error: the topic name '' is empty. Write a name such as imu/data"),
    "topic: tilde inside": (
        topic("imu/~"),
        "f:3:30: error: the topic name 'imu/~' has '~' after its first character. "
        "'~' means the node, and only at the beginning",
    ),
    "topic: tilde without slash": (
        topic("~imu"),
        "f:3:27: error: the topic name '~imu' needs a slash after '~'. Write ~/imu",
    ),
    "topic: substitution": (
        topic("'{host}/imu'"),
        "f:3:27: error: the topic name '{host}/imu' has the substitution '{host}', which ROS 2 "
        "does not define. "
        "Available: {node}, {ns} and {namespace}",
    ),
    "topic: open brace": (
        topic("'a{node'"),
        "f:3:28: error: the topic name 'a{node' has an unmatched brace. Write {node} or {ns}",
    ),
    "topic: too long": (
        topic("a" * 247),
        f"f:3:26: error: the topic name '/{'a' * 59}…' is 248 characters long as '/{'a' * 39}…'; "
        f"at most 247 are allowed. "
        "Shorten it by 1",
    ),
    "topic: wrong when expanded": (
        "nodes: [{name: n, publishers: [{topic: 'a{ns}/{ns}', type: std_msgs/msg/Bool}]}]\n",
        "f:1:40: error: the topic name '/a///' has two slashes in a row. Remove one of them",
    ),
    "service": (
        f"{NODE}    services: [{{name: a b, type: std_srvs/srv/SetBool}}]\n",
        "f:3:24: error: the service name 'a b' has the character ' '.",
    ),
    "node: digit": (
        "nodes: [{name: 9n}]\n",
        "f:1:16: error: the node name '9n' has a part that begins with a digit. Begin it with a letter",
    ),
    "node: slash": (
        "nodes: [{name: a/b}]\n",
        "f:1:17: error: the node name 'a/b' has the character '/'. Letters a to z, digits, _ are allowed",
    ),
    "node: empty": (
        "nodes: [{name: ''}]\n",
        "f:1:16: error: the node name '' is empty. Write a name such as imu",
    ),
    "node: too long": (
        f"nodes: [{{name: {'a' * 256}}}]\n",
        f"f:1:271: error: the node name '{'a' * 256}' is 256 characters long; at most 255 are allowed. Shorten it",
    ),
    "namespace: double slash": (
        "nodes: [{name: a, namespace: /b//c}]\n",
        "f:1:33: error: the namespace '/b//c' has two slashes in a row. Remove one of them",
    ),
    "namespace: too long": (
        f"nodes: [{{name: a, namespace: /{'b' * 245}}}]\n",
        f"f:1:30: error: the namespace '/{'b' * 245}' is 246 characters long as '/{'b' * 39}…'; "
        f"at most 245 are allowed. "
        "Shorten it by 1",
    ),
    "two nodes of one name": (
        "nodes:\n  - {name: a, namespace: b}\n  - {name: a, namespace: /b}\n",
        "f:3:12: error: duplicate node '/b/a'; the first is in line 2. "
        "Give each a different name or namespace",
    ),
    "two timers of one name": (
        f"{NODE}    timers:\n    - {{name: t, period: 1 s}}\n    - {{name: t, period: 2 s}}\n",
        "f:5:7: error: duplicate timer 't'; the first is in line 4. Write another name such as t_2",
    ),
    "a timer of no time": (
        f"{NODE}    timers: [{{name: t, period: 0 ms}}]\n",
        "f:3:32: error: 'period' must be at least 1 us; it is 0 ms. Write a longer time",
    ),
    "default of another type": (
        f"{NODE}    parameters: [{{name: p, type: bool, default: 1}}]\n",
        "f:3:49: error: the default of the parameter 'p' is not of type bool. Write true or false",
    ),
    "integer default with a part": (
        f"{NODE}    parameters: [{{name: p, type: integer, default: 1.5}}]\n",
        "f:3:52: error: the default of the parameter 'p' is not of type integer. Write 2, or type: double",
    ),
    "boolean default of a number": (
        f"{NODE}    parameters: [{{name: p, type: double, default: true}}]\n",
        "f:3:51: error: the default of the parameter 'p' is not of type double. Write 1, or type: bool",
    ),
    "default outside the range": (
        f"{NODE}    parameters: [{{name: p, type: integer, default: 9, range: {{min: 1, max: 5}}}}]\n",
        "f:3:52: error: the default of the parameter 'p' is not in its range. Write 5: it goes from 1 to 5",
    ),
    "no default, and a range without 0": (
        f"{NODE}    parameters: [{{name: p, type: integer, range: {{min: 1, max: 5}}}}]\n",
        "f:3:18: error: the parameter 'p' has no default and starts with 0, which is not in its range. "
        "Write `default: 1`",
    ),
    "no default, and a list of values without 0": (
        f"{NODE}    parameters: [{{name: p, type: integer, one_of: [7, 9]}}]\n",
        "f:3:18: error: the parameter 'p' has no default and starts with 0, which is none of its values. "
        "Write `default: 7`",
    ),
    "default longer than its size": (
        f"{NODE}    parameters: [{{name: p, type: string, default: grün, size: 4}}]\n",
        "f:3:51: error: the default of the parameter 'p' is longer than its size. Set size: 5",
    ),
    "range of a text": (
        f"{NODE}    parameters: [{{name: p, type: string, range: {{min: 1, max: 5}}}}]\n",
        "f:3:49: error: the parameter 'p' is a string, which has no range. Remove `range`",
    ),
    "array without a size": (
        f"{NODE}    parameters: [{{name: p, type: 'byte[]', default: [1, 2]}}]\n",
        "f:3:18: error: the array 'p' has no size: how many elements it has at most. Write size: 2",
    ),
    "size of a number": (
        f"{NODE}    parameters: [{{name: p, type: integer, size: 2}}]\n",
        "f:3:18: error: the parameter 'p' is of type integer, which has no size. Remove `size`",
    ),
    "too many elements": (
        f"{NODE}    parameters: [{{name: p, type: 'bool[]', size: 1, default: [true, false]}}]\n",
        "f:3:62: error: the default of the parameter 'p' is longer than its size. Set size: 2",
    ),
    "byte above 255": (
        f"{NODE}    parameters: [{{name: p, type: 'byte[]', size: 2, default: [256]}}]\n",
        "f:3:62: error: the default of the parameter 'p' is not of type byte[]. Write a list of values of type byte",
    ),
    "scalar for an array": (
        f"{NODE}    parameters: [{{name: p, type: 'string[]', size: 2, default: a}}]\n",
        "f:3:64: error: the default of the parameter 'p' is not of type string[]. "
        "Write a list of values of type string",
    ),
    "list for a number": (
        f"{NODE}    parameters: [{{name: p, type: integer, default: [1]}}]\n",
        "f:3:52: error: the default of the parameter 'p' is not of type integer. "
        'Write type: "integer[]", size: 1, or a single value',
    ),
    "integer above 64 bits": (
        f"{NODE}    parameters: [{{name: p, type: integer, default: 9223372036854775808}}]\n",
        "f:3:52: error: the default of the parameter 'p' is not of type integer. "
        "Write 9223372036854775807, or type: double",
    ),
    "infinite default": (
        f"{NODE}    parameters: [{{name: p, type: double, default: .inf}}]\n",
        "f:3:51: error: the default of the parameter 'p' is not a finite number. Set it in the program",
    ),
    "empty list of values": (
        f"{NODE}    parameters: [{{name: p, type: integer, one_of: []}}]\n",
        "f:3:51: error: 'nodes[0].parameters[0].one_of' must be a list with at least one item; "
        "it is an empty list. Add an item, or remove the key",
    ),
    "empty text": (
        'version: 1\ntransport: {type: serial, device: ""}\n',
        "f:2:35: error: 'transport.device' must not be empty. Write a text, or remove the key",
    ),
    "empty list of writers": (
        "version: 1\nlogging: []\n",
        "f:2:10: error: 'logging' must be console, callback, rosout or ring, or a list of such writers; "
        "it is an empty list. Add an item, or remove the key",
    ),
    "default that is no number": (
        f"{NODE}    parameters: [{{name: p, type: double, default: .nan}}]\n",
        "f:3:51: error: the default of the parameter 'p' is not a finite number. Set it in the program",
    ),
    "infinite range": (
        f"{NODE}    parameters: [{{name: p, type: double, range: {{min: -.inf, max: 1}}}}]\n",
        "f:3:49: error: the range of the parameter 'p' has a number that is not finite. Write finite numbers",
    ),
    "infinite step": (
        f"{NODE}    parameters: [{{name: p, type: double, range: {{min: 0, max: 1, step: .inf}}}}]\n",
        "f:3:49: error: the range of the parameter 'p' has a number that is not finite. Write finite numbers",
    ),
    "infinite value of a list": (
        f"{NODE}    parameters: [{{name: p, type: double, one_of: [0, .inf]}}]\n",
        "f:3:54: error: a value of the parameter 'p' is not a finite number. "
        "Remove it, or check the value in the callback",
    ),
    "default between steps": (
        f"{NODE}    parameters: [{{name: p, type: double, default: 0.35, range: {{min: 0, max: 1, step: 0.1}}}}]\n",
        "f:3:51: error: the default of the parameter 'p' is between two steps of its range. "
        "Write 0.3: its values are 0.1 apart, from 0",
    ),
    "range with a part": (
        f"{NODE}    parameters: [{{name: p, type: integer, range: {{min: 0.5, max: 5}}}}]\n",
        "f:3:50: error: the range of the parameter 'p' has a number that is no integer of 64 bits. "
        "Write whole numbers, or type: double",
    ),
    "priority and criticality": (
        "nodes: [{name: n, executors: [{name: fast}]}]\n"
        "tasks: [{name: t, executor: fast, priority: 1, criticality: low}]\n",
        "f:2:61: error: 'criticality' of the task 't' has no effect beside 'priority', which fixes its place. "
        "Remove `criticality`",
    ),
    "range and choice": (
        f"{NODE}    parameters: [{{name: p, type: integer, range: {{min: 0, max: 5}}, one_of: [1]}}]\n",
        "f:3:76: error: the parameter 'p' has both `range` and `one_of`. Remove `one_of`",
    ),
    "choice of a bool": (
        f"{NODE}    parameters: [{{name: p, type: bool, one_of: [1]}}]\n",
        "f:3:48: error: the parameter 'p' is of type bool, which has no `one_of`. Remove `one_of`",
    ),
    "choice of another type": (
        f"{NODE}    parameters: [{{name: p, type: integer, one_of: [1, a]}}]\n",
        "f:3:55: error: a value of `one_of` is not of type integer. Write a number such as 1, or type: string",
    ),
    "string for nothing": (
        f"{NODE}    parameters: [{{name: p, type: string, size: 0}}]\n",
        "f:3:18: error: the string 'p' has a size of 0: it holds nothing. Write size: 20, or remove `size`",
    ),
    "choice above the size": (
        f"{NODE}    parameters: [{{name: p, type: string, size: 2, one_of: [abc]}}]\n",
        "f:3:60: error: 'abc' is longer than the size of the parameter 'p'. Set size: 3",
    ),
    "default that is no choice": (
        f"{NODE}    parameters: [{{name: p, type: integer, default: 2, one_of: [1, 3]}}]\n",
        "f:3:52: error: the default of the parameter 'p' is none of its values. Available: 1, 3",
    ),
    "empty range": (
        f"{NODE}    parameters: [{{name: p, type: integer, range: {{min: 5, max: 1}}}}]\n",
        "f:3:50: error: the range of the parameter 'p' is empty: min is above max. Write {min: 1, max: 5}",
    ),
    "unknown handle": (
        f"{NODE}    timers: [{{name: tick, period: 1 s}}]\n    executors: [{{name: e, handles: [tik]}}]\n",
        "f:4:37: error: the node has no timer, subscription or service 'tik'. Did you mean 'tick'?",
    ),
    "host name": (
        'transport: {agent: "robot.local:8888"}\n',
        "f:1:20: error: the agent's address 'robot.local' is a host name. "
        "A device has no DNS to resolve it: write the IPv4 address",
    ),
    "no port": (
        'transport: {agent: "10.0.0.1"}\n',
        "f:1:20: error: missing port in the agent address '10.0.0.1'. Write \"",
    ),
    "port 0": (
        'transport: {agent: "10.0.0.1:0"}\n',
        "f:1:20: error: the agent's port must be a whole number between 1 and 65535; it is '0'.",
    ),
    "port too large": (
        'transport: {agent: "10.0.0.1:65536"}\n',
        "f:1:20: error: the agent's port must be a whole",
    ),
    "port no number": (
        'transport: {agent: "10.0.0.1:xrce"}\n',
        "f:1:20: error: the agent's port must be a whole",
    ),
    "address of five": (
        'transport: {agent: "1.2.3.4.5:8888"}\n',
        "f:1:20: error: the agent's address '1.2.3.4.5'",
    ),
    "address above 255": (
        'transport: {agent: "10.0.0.256:8888"}\n',
        "f:1:20: error: the agent's address '10.0.0",
    ),
    "address with leading zeros": (
        'transport: {agent: "10.0.0.01:8888"}\n',
        "f:1:20: error: the agent's address ",
    ),
    "discovery at a port that is none": (
        'transport: {agent: "discover:x"}\n',
        "f:1:20: error: the port of the search must be a whole number between 1 and 65535; it is 'x'",
    ),
    "IPv6 without brackets": (
        'transport: {agent: "::1:8888"}\n',
        "f:1:20: error: the agent '::1:8888' has an IPv6 address that is not in brackets, or has no port. Write it",
    ),
    "IPv6 without a port": (
        'transport: {agent: "[fd00::1]"}\n',
        "f:1:20: error: the agent '[fd00::1]' has an IPv6 address that is not in brackets, or has no port",
    ),
    "IPv6 that is none": (
        'transport: {agent: "[fd00::12345]:8888"}\n',
        "f:1:20: error: the agent's address 'fd00::12345' is not an IPv6 address",
    ),
    "IPv6 with a zone": (
        'transport: {agent: "[fe80::1%eth0]:8888"}\n',
        "f:1:20: error: the agent's address 'fe80::1%eth0' names the interface 'eth0' of one machine",
    ),
    "agent of a serial line": (
        'transport: {type: serial, agent: "10.0.0.1:8888"}\n',
        "f:1:34: error: transport: serial has no agent address. Remove `agent`, or use type: udp or tcp",
    ),
    "one agent and a list": (
        'transport: {agent: "10.0.0.1:1", agents: ["10.0.0.1:1", "10.0.0.2:1"]}\n',
        "f:1:42: error: 'transport.agent' and 'transport.agents' contradict each other. Remove `agent`",
    ),
    "a list of one agent": (
        'transport: {agents: ["10.0.0.1:1"]}\n',
        "f:1:21: error: 'transport.agents' must be a list of 2 to 8 addresses",
    ),
    "a list with a number": (
        'transport: {agents: ["10.0.0.1:1", 3]}\n',
        "f:1:36: error: 'transport.agents[1]' must be an address and a port in quotes",
    ),
    "a list with an address that is none": (
        'transport: {agents: ["10.0.0.1:1", "10.0.0.2"]}\n',
        "f:1:36: error: missing port in the agent address '10.0.0.2'",
    ),
    "a list with a search": (
        'transport: {agents: ["10.0.0.1:1", discover]}\n',
        "f:1:36: error: a list of agents cannot contain 'discover'. Write `agent: discover` instead of `agents`",
    ),
    "an agent twice in the list": (
        'transport: {agents: ["10.0.0.1:1", "10.0.0.1:1"]}\n',
        "f:1:36: error: the agent '10.0.0.1:1' is in the list twice. Remove it",
    ),
    "more agents than connect_timeout is for": (
        "transport: {agents: [" + ", ".join(f'"10.0.0.{i}:1"' for i in range(1, 10)) + "]}\n",
        "f:1:21: error: the list has 9 agents; it may have 8. Keep 8 of them",
    ),
    "agents with addresses of two kinds": (
        'transport: {agents: ["10.0.0.1:1", "[fd00::1]:1"]}\n',
        "f:1:21: error: the agents have IPv4 and IPv6 addresses. Give all of them addresses of one kind",
    ),
    "mtu above a datagram": (
        "transport: {mtu: 65508}\n",
        "f:1:18: error: 'transport.mtu' is 65508; a UDP datagram holds 65507. Set mtu: 65507 or less",
    ),
    "block for no time": (
        "on_full: block 0 ms\n",
        "f:1:10: error: 'on_full: block 0 ms' must block between 1 ms and 60 s. `on_full: error` "
        "does not block",
    ),
    "block for too long": (
        "on_full: block 61 s\n",
        "f:1:10: error: 'on_full: block 61 s' must block between 1 ms",
    ),
    "a type as C++ writes it": (
        "nodes: [{name: n, publishers: [{topic: t, type: 'std_msgs::msg::Int32'}]}]\n",
        "f:1:49: error: 'nodes[0].publishers[0].type' must be a message type such as std_msgs/msg/Int32; it is "
        "the text 'std_msgs::msg::Int32'. Write std_msgs/msg/Int32",
    ),
    "a QoS by its name": (
        "nodes: [{name: n, publishers: [{topic: t, type: a/msg/B, qos: sensor_data}]}]\n",
        "f:1:63: error: 'nodes[0].publishers[0].qos' must be a mapping of keys and values; it is the text "
        "'sensor_data'. Write `qos: {reliability: best_effort, depth: 5}`",
    ),
    "no space after the colon": (
        "nodes: [{name: n, publishers: [{topic:t, type: a/msg/B}]}]\n",
        "f:1:33: error: unknown key 'topic:t' in 'nodes[0].publishers[0]'. Write `topic: t`, with a space after"
        " the colon",
    ),
    "no space after the colon of the only key": (
        "nodes:\n - name:n\n",
        "f:2:4: error: 'nodes[0]' must be a mapping of keys and values; it is the text 'name:n'. Write `name: n`",
    ),
    "a star without quotes": (
        "limits: {*: {string: 3}}\n",
        "f:1:11: error: not valid YAML: a text that begins with '*' or '&' is an alias or an anchor to YAML. "
        'Quote it, as in "*": {string: 32}',
    ),
    "limit of a field": (
        "limits: {a/msg/B: {c: {string: 0}}}\n",
        "f:1:32: error: 'limits[\"a/msg/B\"].c.string' must be a whole number between 1 and "
        "16777216, or a mapping",
    ),
    "limit of nothing": (
        "limits: {a/msg/B: {}}\n",
        "f:1:19: error: 'limits[\"a/msg/B\"]' must be a mapping such",
    ),
    "field path with a dot": (
        "limits: {a/msg/B: {c.d: 3}}\n",
        "f:1:20: error: the keys of 'limits[\"a/msg/B\"]' must be names of fields; 'c.d' is not",
    ),
    "not YAML": ("nodes: [\n", "f:2:1: error: not valid YAML: "),
}


@pytest.mark.parametrize("case", ERRORS)
def test_a_fault_is_reported_at_its_place(case: str) -> None:
    text, expected = ERRORS[case]
    application, lines = parse(text)
    assert application is None
    assert any(line.startswith(expected) for line in lines), lines


def test_every_fault_has_a_hint() -> None:
    silent = [line for text, _ in ERRORS.values() for line in parse(text)[1] if ". " not in line]
    hintless = [line for line in silent if "must be" not in line]
    assert hintless == [], "a diagnostic that says neither what is accepted nor what to do"


def test_all_faults_are_reported_in_one_run_and_in_the_order_of_the_text() -> None:
    text = (
        "profles: []\nentities: binry\ntransport: {agent: 'a:99999'}\n"
        "nodes:\n  - name: 1\n  - name: b-c\n    publishers: [{topic: //a}]\non_full: wait\n"
    )
    _, lines = parse(text)
    places = [tuple(int(n) for n in line.split(":")[1:3]) for line in lines]
    assert places == sorted(places)
    assert [place[0] for place in places] == [1, 2, 3, 3, 5, 6, 7, 7, 8]


def test_the_demo_application_parses() -> None:
    path = ROOT / "examples" / "demo" / "microros.yaml"
    application, lines = parse(path.read_text(encoding="utf-8"))
    assert lines == []
    assert application is not None
    imu = application.nodes[0].endpoints[0]
    assert (imu.kind, imu.topic, imu.type, imu.qos.reliability) == (
        "publisher",
        "imu/data",
        "sensor_msgs/msg/Imu",
        "best_effort",
    )
    assert application.memory.ram_budget == 8192
    assert (application.limits[0].path, application.limits[0].string) == (
        ("sensor_msgs/msg/Imu", "header", "frame_id"),
        16,
    )


def test_the_application_file_of_the_design_parses() -> None:
    text = """\
version: 1
distro: jazzy
profiles: [pure_sender]
components: [+timers]
entities: binary
liveliness: ping
transport: {type: udp, agent: "192.168.1.10:8888", mtu: 512}
session: {key: device}
target: {name: cortex-m4, rtos: freertos, network: lwip}
nodes:
  - name: imu
    publishers: [{topic: imu/data, type: sensor_msgs/msg/Imu, qos: {reliability: best_effort, depth: 1}}]
limits:
  "*": {string: 32, sequence: 8}
  sensor_msgs/msg/JointState: {name: {sequence: 6, string: 16}, position: 6}
memory: {arena: 0, ram_budget: 8 KiB, flash_budget: 32 KiB, stack: 2 KiB}
on_full: error
errors: text
"""
    application, lines = parse(text)
    assert lines == []
    assert application is not None
    assert [r.path for r in application.limits] == [
        ("*",),
        ("sensor_msgs/msg/JointState", "name"),
        ("sensor_msgs/msg/JointState", "position"),
    ]


def test_what_is_not_said_is_the_default() -> None:
    application, lines = parse("profiles: [pure_sender]\n")
    assert lines == []
    assert application is not None
    default = Application()
    for name in ("distro", "transport", "session_key", "target", "nodes", "limits", "memory", "on_full"):
        assert getattr(application, name) == getattr(default, name)
    assert (application.entities, application.liveliness, application.error_text) == (None, None, True)


def test_pools_next_to_nodes_are_a_warning() -> None:
    application, lines = parse("nodes: [{name: n}]\npools: {publishers: 3, history: 2}\n")
    assert application is not None
    assert lines == [
        "f:2:9: warning: 'pools.publishers' has no effect: `nodes` decides what is created. Remove it"
    ]


def test_substitutions_are_replaced() -> None:
    application, lines = parse(
        "nodes: [{name: n, namespace: /s, publishers: [{topic: '{node}/{ns}x', type: a/msg/B}]}]\n"
    )
    assert [line.split(": error: ")[1] for line in lines] == [
        "the topic name '/s/n//sx' has two slashes in a row. Remove one of them"
    ]
    application, lines = parse(
        "nodes: [{name: n, namespace: /s, publishers: [{topic: '{ns}/{node}/x', type: a/msg/B}]}]\n"
    )
    assert lines == []
    assert application is not None
    assert application.nodes[0].endpoints[0].topic == "/s/n/x"


def test_a_field_called_string_takes_a_mapping() -> None:
    application, _ = parse("limits: {a/msg/B: {string: {sequence: 3}, sequence: 4}}\n")
    assert application is not None
    assert [(r.path, r.string, r.sequence) for r in application.limits] == [
        (("a/msg/B",), None, 4),
        (("a/msg/B", "string"), None, 3),
    ]


def test_aliases_share_what_they_name() -> None:
    text = (
        "nodes:\n  - name: a\n    publishers:\n      - {topic: x, type: a/msg/B, qos: &q {depth: 3}}\n"
        "      - {topic: y, type: a/msg/B, qos: *q}\n"
    )
    application, lines = parse(text)
    assert lines == []
    assert application is not None
    assert [e.qos.depth for e in application.nodes[0].endpoints] == [3, 3]
