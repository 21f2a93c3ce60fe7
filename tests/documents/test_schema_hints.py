# SPDX-License-Identifier: Apache-2.0
"""Hints for values and keys that a schema refuses."""

from __future__ import annotations

import pytest

from microros_gen.application.parser import parse_application
from microros_gen.diagnostics import Diagnostics, Source

START = "version: 1\nprofiles: [pure_sender]\n"
NODE = "nodes:\n  - name: probe\n    publishers: [{topic: count, type: std_msgs/msg/Int32, MORE}]\n"
# Text after START → end of the message
HINTS = {
    "transport: {mtu: 512 bytes}": "it is the text '512 bytes'. Write 512",
    "transport: {mtu: 1 KiB}": "it is the text '1 KiB'. Write 1024",
    "transport: {mtu: 1.5 kB}": "it is the text '1.5 kB'. Write 1500",
    "transport: {mtu: '0x200'}": "it is the text '0x200'. Remove the quotes",
    "transport: {mtu: 512.5}": "it is 512.5. Write a whole number",
    "transport: {mtu: 64 KiB}": "Write 65535 or less",
    "transport: {mtu: 100 kB}": "Write 65535 or less",
    "transport: {mtu: 0.01 kB}": "Write 64 or more",
    "transport: {mtu: '100000'}": "Write 65535 or less",
    "transport: {mtu: '100.5'}": "Write a whole number",
    "transport: {mtu: '1.5'}": "Write 64 or more",
    "transport: {mtu: '512.0'}": "Remove the quotes",
    "transport: {bitrate: 10 M}": "Write 8000000 or less",
    "transport: {send_buffer: 2 MiB}": "Write 1048576 or less",
    "pools: {slot_size: 64 KiB}": "Write 65535 or less",
    "pools: {queue: 4 k}": "Write 250 or less",
    f"pools: {{queue: '{'9' * 400}'}}": "Write 250 or less",
    "diagnosis: {supply: {warn: 3.3}}": "it is 3.3. Write 3300",
    "diagnosis: {supply: {error: 3 V}}": "Write 3000",
    "diagnosis: {supply: {error: 4 MV}}": "Write 4",
    "diagnosis: {supply: {error: 2000.5}}": "Write 1000000 or less",
    "transport: {type: serial, device: d, baud: fast}": "it is the text 'fast'. Write 115200, the default",
    "transport: {type: serial, device: d, baud: true}": "it is true. Write 115200, the default",
    "session: {key: abc}": "it is the text 'abc'. Write device",
    "session: {key: devise}": "it is the text 'devise'. Write device",
    "logging: stdout": "it is the text 'stdout'. Write console",
    "logging: off": "it is the text 'off'. Write `components: [-logging]` instead of this line",
    "logging: [{to: uart}]": "it is the text 'uart'. Write console",
    "logging: [{to: console, level: WARNING}]": "it is the text 'WARNING'. Write warn",
    "logging: {to: console, level: warn}": "it is a mapping. Write [{to: console, level: warn}]",
    "logging: {console: warn}": "it is a mapping. Write [{to: console, level: warn}]",
    "logging: {console: debug}": "Write [{to: console, level: debug}]",
    "logging: {uart: WARNING}": "Write [{to: console, level: warn}]",
    "logging: {to: console, level: WARNING}": "Write [{to: console, level: warn}]",
    "logging: {to: console, level: loud}": "Write [{to: console, level: info}]",
    "logging: {to: nowhere}": "Begin each item with '- ', or write [ … ]",
    "logging: [{to: console, level: loud}]": "Write info, the default",
    "nodes: [{name: a, parameters: [{name: b, type: double, range: [0, 1]}]}]": "Write {min: 0, max: 1}",
    "nodes: [{name: a, parameters: [{name: b, type: double, range: [0, 1, 2]}]}]": "Write {min: 0, max: 1, step: 2}",
    "nodes: [{name: a, parameters: [{name: b, type: double, range: [0, 1, 2, 3]}]}]": "it is a list",
    "tasks: [{name: control, on_overrun: skip}]": "Write `overrun: call`: your function is called",
    "tasks: [{name: control, period_ms: 10}]": "Write `period: 10 ms`",
    "tasks: [{name: control, rate_hz: 10}]": "Write `rate: 100 Hz`",
    "tasks: [{name: control, wcet: 1}]": "Write `time: 200 us`",
    "tasks: [{name: control, executors: [a]}]": "Write `executor: NAME`, one of the `executors:` of a node",
    "tasks: [{name: control, stack_size: 4096}]": "Write `stack: 4 KiB`",
    "tasks: [{name: control, prio: 1}]": "Write `priority: 1`",
    "tasks: [{name: control, criticality: medium}]": "Write middle",
    "tasks: [{name: control, criticality: 7}]": "Write middle, the default",
    "tasks: [{name: control, rate: -5 Hz}]": "it is the text '-5 Hz'. Write 5 Hz",
    "tasks: [{name: control, rate: 3 MHz}]": "it is the text '3 MHz'. Write 3000 kHz",
    "nodes: [{name: a, parameters: {gain: 0.5}}]": "Declare it in a list: `parameters: [{name: gain, type: double}]`",
    "nodes: [{name: a, parameters: [{name: b}]}]": "Add `type: bool`",
    "nodes: [{name: a, parameters: [{type: bool}]}]": "Add `name: gain`",
    "nodes: [{name: a, parameters: [{name: my gain, type: double}]}]": "it is the text 'my gain'. Write my_gain",
    "nodes: [{name: a, parameters: [{name: 12, type: double}]}]": "it is 12. Write p_12",
    "nodes: [{name: a, parameters: [{name: '', type: double}]}]": "it is the text ''. Write gain",
    "nodes: [{name: a, parameters: [{name: b, type: float}]}]": "it is the text 'float'. Write double",
    "nodes: [{name: a, parameters: [{name: b, type: int32}]}]": "it is the text 'int32'. Write integer",
    "nodes: [{name: a, parameters: [{name: b, type: integer_array, size: 2}]}]": "Write 'integer[]'",
    "nodes: [{name: a, parameters: [{name: b, type: 'float64[]'}]}]": "Write 'double[]'",
    "nodes: [{name: a, parameters: [{name: b, type: double, range: {min: 1}}]}]": "Add `max: 10`",
    "nodes: [{name: a, parameters: [{name: b, type: double, range: {min: 0, max: 9, step: two}}]}]": "Write 1",
    "transport: {mtu: -1}": "it is -1. Write 64 or more",
    "transport: {mtu: 1e300}": "Write 65535 or less",
    "transport: {mtu: }": "it is empty. Write a value, or remove the key",
    "session: {key: 0}": "it is 0. Write 1 or more",
    "session: {key: 0x1FFFFFFFF}": "it is 0x1FFFFFFFF. Write 4294967295 or less",
    "limits: {'*': {string: -5}}": "it is -5. Write 1 or more",
    "on_full: block": "it is the text 'block'. Write block 20 ms",
    "on_full: block 1sec": "it is the text 'block 1sec'. Write block 1 s",
    "on_full: block 0.5 s": "Write block 500 ms",
    "on_full: block 0.4 ms": "Write block 1 ms",
    "on_full: block 90 sec": "Write block 60 s",
    "on_full: block 1.5 s": "Write block 1500 ms",
    "on_full: block 500 us": "Write block 1 ms",
    "on_full: block 5": "it is the text 'block 5'. Write block 5 ms",
    f"on_full: block {'9' * 400} ms": "Write block 20 ms",
    "on_full: drop oldest": "it is the text 'drop oldest'. Did you mean 'drop_oldest'?",
    "memory: {arena: 2 KB}": "it is the text '2 KB'. Write 2 kB",
    "memory: {arena: 2048 bytes}": "it is the text '2048 bytes'. Write 2048 B",
    "memory: {arena: 1.5 KiB}": "it is the text '1.5 KiB'. Write 1536",
    "session: {hard_liveliness: 5}": "it is 5. Add the unit: 5 ms or 5 s",
    "session: {hard_liveliness: 5 seconds}": "it is the text '5 seconds'. Write 5 s",
    "session: {hard_liveliness: 10 hz}": "it is the text '10 hz'. Write 100 ms, the period of 10 Hz",
    "session: {hard_liveliness: 4 kHz}": "Write 0.25 ms, the period of 4 kHz",
    "session: {hard_liveliness: 0}": "Write a time above 0 such as 20 ms",
    "session: {hard_liveliness: 0 sec}": "Write a time above 0 such as 20 ms",
    "session: {hard_liveliness: 99999999999 khz}": "it is the text '99999999999 khz'",
    "memory: {arena: 0 bytes}": "Write a size above 0 such as 2 kB",
    "memory: {arena: 0.0001 kB}": "Write a size above 0 such as 2 kB",
    "memory: {arena: 0.4}": "Write a size above 0 such as 2 kB",
    NODE.replace("MORE", "rate: 99999999999 s"): "it is the text '99999999999 s'",
    NODE.replace("MORE", "rate: 0.0000000001 us"): "it is the text '0.0000000001 us'",
    "tasks: [{name: control, rate: 10}]": "it is 10. Write 10 Hz",
    "tasks: [{name: control, rate: 5 ms}]": "Write 200 Hz",
    "interfaces: [std_msgs.msg.Int32]": "Write std_msgs/msg/Int32",
    "interfaces: [std_srvs/srv/set_bool]": "Write std_srvs/srv/SetBool",
    "interfaces: [std_msgs::msg]": "Write std_msgs/msg",
    NODE.replace("MORE", "rate: 10"): "it is 10. Write 10 Hz",
    NODE.replace("MORE", "rate: 0 Hz"): "it is the text '0 Hz'. Remove the key",
    NODE.replace("MORE", "rate: 20 ms"): "it is the text '20 ms'. Write 50 Hz",
    "nodes: [probe]": "it is the text 'probe'. Write {name: probe}",
    "nodes: [{name: probe, publishers: [count]}]": "Write {topic: count, …}",
    "nodes: [{name: probe, timers: [100]}]": "it is 100",
    "nodes: [{name: probe, subscriptions: [{topic: t, type: a/msg/B, on_silence: stop}]}]": "it is the text 'stop'",
    "watchdog: 5": "it is 5",
    "tasks: [5]": "it is 5",
    "nodes:": "it is empty. Add an item, or remove the key",
    "session:": "it is empty. Add a `key: value`, or remove the key",
    "limit: 3": "unknown key 'limit' in the file. Did you mean 'limits'?",
    "rtos: freertos": "unknown key 'rtos' in the file. It is a key of `target`",
    "nodes: [{name: probe, period: 1 s}]": "It is a key of `nodes[].timers[]` and `tasks[]`",
    NODE.replace("MORE", "queue: 2"): "It is a key of `nodes[].subscriptions[]` and `nodes[].clients[]`",
    "executors: 2": "unknown key 'executors' in the file. It is a key of `pools` and `nodes[]`",
}


def messages(text: str) -> list[str]:
    found = Diagnostics()
    assert parse_application(Source("f", text), found) is None
    return [diagnostic.headline().rpartition(" [")[0] for diagnostic in found]


@pytest.mark.parametrize("text", HINTS)
def test_the_hint_can_be_pasted(text: str) -> None:
    lines = messages(f"{START}{text}\n")
    assert any(line.endswith(HINTS[text]) for line in lines), lines


def test_a_version_in_quotes() -> None:
    assert messages(START.replace("1", '"1"')) == [
        "f:1:10: error: 'version' must be 1; it is the text '1'. Remove the quotes"
    ]


@pytest.mark.parametrize("text", ["- version: 1\n", "hello\n"])
def test_a_file_that_is_no_mapping(text: str) -> None:
    (line,) = messages(text)
    assert line.startswith("f:1:1: error: the file must be a mapping of keys and values; it is ")
    assert line.endswith(". Write `key: value` lines")
