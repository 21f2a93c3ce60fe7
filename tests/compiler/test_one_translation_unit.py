# SPDX-License-Identifier: Apache-2.0
"""All sources of an application can be compiled as one translation unit: no name at file scope is used twice."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from microros_gen.toolchain.toolchain import WARNINGS

EVERYTHING = """\
version: 1
profiles: [pure_reader]
components: [+publish, +services, +executor, +timers, +multithread, +session_state, +micro_ros_utilities, +time_sync,
  +parameters, +parameter_storage, +parameter_client, +lifecycle, +node_modes, +action_server, +action_client,
  +graph, +logger_services, +logging_float, +logging_wide, +name_substitutions, +publish_statistics,
  +ping, +session_close, +clock_ros, +service_call, +executor_nodes, +new_data_callbacks, +qos_events, +tf_broadcaster,
  +graph_events, +clock_stamp, +continuous_serialization, +loaned_messages, {choice}]
logging: [rosout, {{to: ring, level: debug}}, console, callback]
nodes:
  - name: all
    parameters: [{{name: gain, type: double}}, {{name: label, type: string, size: 8}}]
    modes: {{SLOW: {{gain: 0.5}}, FAST: {{gain: 2.0, label: fast}}}}
    parameter_clients:
      - {{node: /motor, elements: 3, operations: [get, set, set_atomically, list, describe, get_types, watch]}}
    actions: [{{name: find, type: tf2_msgs/action/LookupTransform, goals: 2}}]
    action_clients: [{{name: find, type: tf2_msgs/action/LookupTransform, goals: 2}}]
    publishers:
      - {{topic: out, type: std_msgs/msg/String, limits: {{string: 20}}, managed: true}}
      - {{topic: near, type: std_msgs/msg/String, limits: {{string: 20}}, local: only}}
    subscriptions:
      - {{topic: in, type: std_msgs/msg/String, limits: {{string: 20}}, queue: 2}}
      - {{topic: near, type: std_msgs/msg/String, limits: {{string: 20}}, local: only}}
    services: [{{name: on, type: std_srvs/srv/SetBool, limits: {{message: 9}}}}]
    clients: [{{name: ask, type: std_srvs/srv/SetBool, limits: {{message: 20}}}}]
    timers: [{{name: tick, period: 50 ms, managed: true}}]
limits:
  "*": {{string: 20, sequence: 8}}
transport: {transport}
"""


@pytest.mark.parametrize(
    ("choice", "transport"),
    [
        pytest.param("+sleep_cycles", "{type: udp}", marks=pytest.mark.variant),
        ("+discovery", "{type: udp}"),
        ("+sleep_cycles", "{type: serial}"),
    ],
)
def test_no_name_of_a_file_clashes_with_that_of_another(choice: str, transport: str, tmp_path: Path) -> None:
    config = tmp_path / "microros.yaml"
    config.write_text(EVERYTHING.format(choice=choice, transport=transport), encoding="utf-8")
    out = compiler.generate(
        compiler.Options(config=config, interface_paths=(shipped_folder(),)), tmp_path / "out"
    ).out
    sources = sorted((out / "src").rglob("*.c"))
    assert len(sources) > 150
    unit = tmp_path / "all.c"
    unit.write_text("".join(f'#include "{source}"\n' for source in sources), encoding="utf-8")
    command = [
        "gcc",
        "-std=c99",
        *WARNINGS,
        "-fsyntax-only",
        "-D_POSIX_C_SOURCE=200809L",
        f"-I{out / 'include'}",
        str(unit),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-4000:]
