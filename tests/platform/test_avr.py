# SPDX-License-Identifier: Apache-2.0
"""A processor whose C library starts the image, and whose numbers are small: what is refused, and what structs take."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.interfaces.find import shipped_folder
from microros_gen.platform.find import read_target

UNO = "version: 1\nprofiles: [pure_reader]\ntarget: arduino-uno\nsession: {key: 1}\n"
TYPES = {
    "std_msgs/msg/Header": "{frame_id: 9}",
    "std_msgs/msg/UInt64": "{}",
    "std_msgs/msg/Int16MultiArray": "{data: 7, layout: {dim: {label: 3, sequence: 2}}}",
    "sensor_msgs/msg/Range": "{header: {frame_id: 3}}",
    "sensor_msgs/msg/LaserScan": "{header: {frame_id: 3}, ranges: 5, intensities: 5}",
    "rcl_interfaces/msg/Log": "{name: 5, msg: 9, file: 3, function: 3}",
    "diagnostic_msgs/msg/KeyValue": "{key: 4, value: 4}",
    "sensor_msgs/msg/JointState": "{header: {frame_id: 3}, name: {string: 4, sequence: 2}, "
    "position: 2, velocity: 2, effort: 2}",
    "geometry_msgs/msg/PoseWithCovariance": "{}",
    "geometry_msgs/msg/PoseArray": "{header: {frame_id: 3}, poses: 2}",
    "rcl_interfaces/msg/ParameterValue": "{string_value: 3, byte_array_value: 2, bool_array_value: 2, "
    "integer_array_value: 2, double_array_value: 2, string_array_value: {string: 3, sequence: 2}}",
}
"""Types and limits whose structs and storage have every kind of member."""


def reasons(folder: Path, text: str) -> list[str]:
    """Return the ids of what generating the application says, warnings not."""
    (folder / "microros.yaml").write_text(text)
    options = compiler.Options(config=folder / "microros.yaml", interface_paths=(shipped_folder(),))
    try:
        compiler.generate(options, folder / "out")
    except UserError as error:
        return [d.id for d in error.diagnostics]
    return []


def test_doubles_are_refused_where_they_must_be_exact(tmp_path: Path) -> None:
    text = UNO + "interfaces: [geometry_msgs/msg/Vector3]\n"
    assert reasons(tmp_path, text + "float64: exact\n") == ["MG-5014"] * 3
    assert reasons(tmp_path, text) == []
    on_host = text.replace("target: arduino-uno", "target: host")
    assert reasons(tmp_path, on_host + "float64: exact\n") == []


def test_a_budget_of_the_stack_is_smaller_than_ram(tmp_path: Path) -> None:
    text = UNO + "interfaces: [std_msgs/msg/Int32]\n"
    assert reasons(tmp_path, text + "memory: {stack: 512}\n") == []
    assert reasons(tmp_path, text + "memory: {stack: 2048}\n") == ["MG-7009"]


@pytest.mark.parametrize(
    "key",
    [
        "interrupts: {3: my_handler}",
        "hooks: {clocks: my_clocks}",
        "memories: {other: {origin: 0x810000, size: 64, holds: [.mine]}}",
        "flash: {origin: 0, size: 32 KiB, offset: 512}",
        "stdio: {to: none}",
    ],
)
def test_keys_of_start_up_code_are_refused(tmp_path: Path, key: str) -> None:
    text = f"target: mine\nsummary: mine\nextends: arduino-uno\n{key}\n"
    (tmp_path / "mine.yaml").write_text(text)
    diagnostics = Diagnostics()
    read_target("mine.yaml", tmp_path, None, diagnostics)
    assert [d.id for d in diagnostics] == ["MG-6035"]


def test_structs_are_as_large_as_planned(tmp_path: Path) -> None:
    """The generated sources assert their sizes; avr-gcc decides."""
    if shutil.which("avr-gcc") is None:
        pytest.skip("no avr-gcc: apt-get install gcc-avr avr-libc")
    limits = "".join(f"  {name}: {limit}\n" for name, limit in TYPES.items() if limit != "{}")
    text = UNO.replace("uno", "mega") + f"interfaces: [{', '.join(TYPES)}]\nlimits:\n{limits}"
    assert reasons(tmp_path, text) == []
    out = tmp_path / "out"
    packages = {name.partition("/")[0] for name in TYPES}
    sources = [path for path in sorted(out.glob("src/*/*.c")) if path.parent.name in packages]
    assert len(sources) > len(TYPES)
    call = ["avr-gcc", "-std=c99", "-Wall", "-Werror", "-mmcu=atmega2560", "-fsyntax-only"]
    done = subprocess.run([*call, f"-I{out / 'include'}", *map(str, sources)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert any("__assert_size" in path.read_text() for path in sources)


COMPONENTS = """\
executor, timers, graph_events, executor_nodes, service_call, liveliness_hard, lifecycle, logger_services, diagnosis,
clock_stamp, tf_broadcaster, micro_ros_utilities, qos_events, new_data_callbacks, loaned_messages, action_server,
action_client, time_sync, sleep_cycles
"""
EVERYTHING = """\
logging: [{to: rosout, level: info}, {to: console, level: debug}, {to: ring, level: warn}]
nodes:
  - name: n
    publishers: [{topic: a, type: std_msgs/msg/Int32}]
    subscriptions: [{topic: b, type: std_msgs/msg/Int32, on_silence: {after: 500 ms, call: stop}}]
    services: [{name: s, type: std_srvs/srv/SetBool, limits: {string: 8}}]
    clients: [{name: c, type: std_srvs/srv/SetBool, limits: {string: 8}}]
    actions: [{name: d, type: example_interfaces/action/Fibonacci, goals: 1, limits: {sequence: 8}}]
    action_clients: [{name: e, type: example_interfaces/action/Fibonacci, goals: 1, limits: {sequence: 8}}]
"""


@pytest.mark.system
def test_components_compile_where_int_has_16_bits(tmp_path: Path) -> None:
    """They need not fit: what a board has room for is up to the application."""
    if shutil.which("avr-gcc") is None:
        pytest.skip("no avr-gcc: apt-get install gcc-avr avr-libc")
    names = ", ".join(f"+{name.strip()}" for name in COMPONENTS.split(","))
    text = UNO.replace("uno", "mega").replace("[pure_reader]", "[pure_sender, pure_reader]")
    assert reasons(tmp_path, f"{text}components: [{names}]\n{EVERYTHING}") == []
    out = tmp_path / "out"
    sources = sorted(out.glob("src/*/*.c"))
    flags = "-std=gnu99 -Wall -Wextra -Wconversion -Wsign-conversion -Wno-type-limits -Werror -fsyntax-only"
    call = ["avr-gcc", *flags.split(), "-mmcu=atmega2560", f"-I{out / 'include'}", *map(str, sources)]
    done = subprocess.run(call, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "more",
    [
        "nodes: [{name: n, parameters: [{name: gain, type: double}]}]\ncomponents: [+parameters]\n",
        "nodes: [{name: n, parameter_clients: [{node: /other}]}]\ncomponents: [+parameter_client]\n",
    ],
)
def test_parameters_are_refused(tmp_path: Path, more: str) -> None:
    assert "MG-5015" in reasons(tmp_path, UNO + more)
