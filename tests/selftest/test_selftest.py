# SPDX-License-Identifier: Apache-2.0
"""The self-test: it passes on the ports of the tool, and each of its checks fails where a port has the fault."""

from __future__ import annotations

import json
import os
import pty
import re
import shutil
import socket
import subprocess
import threading
import tty
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.client.plan.project import Project
from microros_gen.selftest import checks as checks_module
from microros_gen.selftest.render import lacks_image
from microros_gen.toolchain.emulator import Emulator, Machine
from tests.support.command_line import Runner
from tests.support.e2e.can_bus import CanBus
from tests.support.firmware.board import need, target
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.selftest.programs import (
    failed,
    generated,
    lines_of,
    link,
    results,
    start,
)
from tests.support.slices import first

pytestmark = pytest.mark.builds

HEAD = """\
version: 1
profiles: [pure_sender, pure_reader]
session: {key: 7}
limits: {"*": {string: 20, sequence: 3}}
"""
HOST = f"""\
{HEAD}components: [+executor, +timers, +sleep_cycles]
transport: {{type: udp, agent: "127.0.0.1:8888"}}
nodes:
  - name: device
    publishers:
      - {{topic: imu, type: sensor_msgs/msg/Imu}}
      - {{topic: joints, type: sensor_msgs/msg/JointState}}
      - {{topic: empty, type: std_msgs/msg/Empty}}
      - {{topic: count, type: std_msgs/msg/Int32}}
    subscriptions:
      - {{topic: target, type: std_msgs/msg/Int32}}
      - {{topic: health, type: diagnostic_msgs/msg/DiagnosticArray}}
    timers: [{{name: beat, period: 100 ms, kind: rtos}}]
    executors: [{{name: all}}, {{name: other, handles: [target]}}]
tasks: [{{name: main, executor: all, rate: 10 Hz}}, {{name: second, executor: other}}]
"""
SMALL = """\
nodes: [{name: device, publishers: [{topic: count, type: std_msgs/msg/Int32}],
         subscriptions: [{topic: target, type: std_msgs/msg/Int32}]}]
"""
BOARD = f"""\
{HEAD}components: [+executor, +timers, +diagnosis]
memory: {{stack: 8 KiB}}
diagnosis: {{period: 1 s}}
nodes:
  - name: device
    subscriptions: [{{topic: target, type: std_msgs/msg/Int32}}, {{topic: joints, type: sensor_msgs/msg/JointState}}]
    timers: [{{name: beat, period: 100 ms, kind: rtos}}]
"""
PRIVILEGED = "lock_plain"
"""A fault that shows only where tasks have priorities."""
HOST_FAULTS = {
    "time_back": "time_never_backwards",
    "time_stands": "time_resolution",
    "time_coarse": "time_resolution",
    "steady_back": "steady_never_backwards",
    "steady_coarse": "steady_resolution",
    "steady_slow": "steady_agrees",
    "epoch_back": "epoch_never_backwards",
    "epoch_stands": "epoch_resolution",
    "epoch_slow": "epoch_agrees",
    "sleep_short": "sleep_lower_bound",
    "sleep_long": "sleep_upper_bound sleep_zero",
    "wait_never": "wait_rests",
    "wait_long": "wait_zero wait_upper_bound",
    "wake_lost": "wake_is_kept wake_from_timer wake_from_task",
    "timer_none": "timer_start wake_from_timer",
    "timer_slow": "timer_ticks",
    "timer_late": "timer_not_late",
    "timer_early": "timer_not_early",
    "timer_drift": "timer_no_drift",
    "timer_goes_on": "timer_stops",
    "lock_none": "lock_excludes",
    PRIVILEGED: "lock_inheritance",
    "task_none": "task_create",
    "self_wrong": "task_self",
    "restart_refused": "task_restart",
    "restart_self": "task_restart_self",
    "restart_stalls": "task_restart_others",
    "self_everywhere": "task_self_outside",
    "event_first_lost": "task_event_is_kept",
    "event_second_lost": "task_event_wakes",
    "task_wait_never": "task_wait_rests",
    "task_wait_long": "task_wait_upper_bound",
    "task_time_back": "task_time_never_backwards",
    "task_time_coarse": "task_time_resolution",
    "task_time_slow": "task_time_agrees",
    "release_early": "release_not_early",
    "release_late": "release_not_late",
    "release_drift": "release_no_drift",
    "release_past": "release_in_the_past",
    "task_peak_zero": "task_stack_peak",
    "task_peak_above": "task_stack_peak_fits",
    "id_zero": "unique_id",
    "id_changes": "unique_id_stays",
    "udp_takes_all": "udp_refuses_a_wrong_address",
    "udp_none": "udp_open",
    "udp_invents": "udp_receive_nothing",
    "udp_waits": "udp_receive_never_waits",
    "udp_cuts": "udp_lengths",
    "udp_breaks": "udp_after_an_empty_one",
    "udp_fits": "udp_too_large",
    "type_encode": "std_msgs/msg/Int32: seen other encoded bytes",
    "type_encode_refuses": "std_msgs/msg/Int32: seen an encoder that refuses",
    "type_size": "std_msgs/msg/Int32: seen another encoded size",
    "type_largest": "std_msgs/msg/Int32: seen a body above the largest size",
    "type_refuses": "std_msgs/msg/Int32: seen a decoder that refuses",
    "type_decode": "std_msgs/msg/Int32: seen another message",
    "type_order": "std_msgs/msg/Int32: seen another message after big endian",
    "type_part": "std_msgs/msg/Int32: seen a decoder that takes part of a body",
}
SERIAL_FAULTS = {
    "serial_none": "serial_open",
    "serial_full": "serial_room",
    "serial_refuses_nothing": "serial_write_nothing",
    "serial_refuses": "serial_write",
    "serial_waits": "serial_read_never_waits",
    "serial_busy": "serial_becomes_idle",
    "serial_flips": "serial_lengths",
    "serial_once": "serial_opens_again",
}
TCP_FAULTS = {
    "tcp_takes_all": "tcp_refuses_a_wrong_address",
    "tcp_waits": "tcp_receive_never_waits",
    "tcp_invents": "tcp_refused",
}
MULTICAST_FAULTS = {
    "multicast_none": "multicast_open",
    "multicast_takes_all": "multicast_refuses_a_wrong_group",
    "multicast_refuses": "multicast_send",
    "multicast_invents": "multicast_receive_nothing",
    "multicast_waits": "multicast_receive_never_waits",
}
LINK_FAULTS = {
    "link_send_waits": "link_down_send_never_waits",
    "link_invents": "link_down_receive_nothing",
    "link_receive_waits": "link_down_receive_never_waits",
    "link_refuses": "link_up_opens link_up_answers",
    "link_stays_down": "link_up_answers",
}
TCP_LINK_FAULTS = {
    "link_send_waits": "tcp_link_down_send_never_waits",
    "link_invents": "tcp_link_down_receive_nothing",
    "link_receive_waits": "tcp_link_down_receive_never_waits",
    "link_refuses": "tcp_link_up_opens tcp_link_up_answers",
    "link_stays_down": "tcp_link_up_answers",
}
SERIAL_LINK_FAULTS = {
    "link_send_waits": "serial_link_down_write_never_waits",
    "link_invents": "serial_link_down_read_nothing",
    "link_receive_waits": "serial_link_down_read_never_waits",
    "link_refuses": "serial_link_up_opens serial_link_up_returns",
    "link_stays_down": "serial_link_up_returns",
}
CAN_LINK_FAULTS = {
    "link_send_waits": "canfd_link_down_send_never_waits",
    "link_invents": "canfd_link_down_receive_nothing",
    "link_receive_waits": "canfd_link_down_receive_never_waits",
    "link_refuses": "canfd_link_up_opens canfd_link_up_returns",
    "link_stays_down": "canfd_link_up_returns",
}
CAN_FAULTS = {
    "can_none": "canfd_open",
    "can_refuses": "canfd_send",
    "can_invents": "canfd_receive_nothing",
    "can_waits": "canfd_receive_never_waits",
    "can_send_waits": "canfd_send_never_waits",
    "can_flips": "canfd_lengths",
    "can_cuts": "canfd_lengths",
    "can_once": "canfd_opens_again",
}
STORAGE_FAULTS = {
    "storage_none": "storage_works",
    "storage_cuts": "storage_keeps",
    "storage_not_erased": "storage_erases",
}
BOARD_FAULTS = {
    "us_back": "microseconds_never_backwards",
    "us_coarse": "microseconds_resolution",
    "us_slow": "microseconds_agree",
    "peak_zero": "stack_peak",
    "peak_above": "stack_peak_fits",
    "wake_lost": "wake_is_kept wake_from_timer",
}
NAMES = re.compile(
    r'selftest_(?:equal|at_least|at_most|true)\(\s*"(\w+)"|"(?=\w+_(?:never|resol|agree))(\w+)"'
)
TRIES = 6
DECODER = ("-DHAS_DECODER",)
TASKS = ("-DHAS_TASKS", *DECODER)
STORAGE = ("-DHAS_STORAGE", *DECODER)
CAN = ("-DHAS_CAN", *DECODER)
LINK = ("-DHAS_LINK", *DECODER)
UNSEEN = {"lock_is_recursive"}
"""A check that does not fail but stops the program: `test_a_lock_that_is_not_recursive_stops_the_program`."""


@pytest.fixture(scope="module")
def outputs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("selftest")


@pytest.fixture(scope="module")
def out(outputs: Path) -> Path:
    return generated(outputs / "host", HOST)


@pytest.fixture(scope="module")
def program(out: Path) -> Path:
    return link(["gcc", "-O1"], out, out / "faulty", TASKS, "-pthread")


def all_pass(program: Path, fault: str = "", one_processor: bool = False) -> str:
    """Run until all checks pass: a busy machine may delay all tries of one that has an upper bound."""
    seen = []
    for _ in range(TRIES):
        status, text = lines_of(start(program, fault, one_processor))
        if status == 0:
            assert failed(text) == []
            return text
        seen.append((status, text))
    raise AssertionError(seen)


def check_passes(program: Path, name: str) -> None:
    """Run until a check passes: where a busy machine answered too late before the link went down, it is left out."""
    seen = []
    for _ in range(TRIES):
        seen.append(results(all_pass(program))[name])
        if seen[-1] == ("PASS", ""):
            return
    raise AssertionError(seen)


def unseen(program: Path, fault: str, wanted: str) -> list[str]:
    """Return those of the wanted checks that pass with a fault; a busy machine may hide it, but not each time."""
    names = [wanted] if ": " in wanted else [f"{name}: seen " for name in wanted.split()]
    missing = names
    for _ in range(TRIES):
        status, text = lines_of(start(program, fault, fault == PRIVILEGED))
        seen = failed(text)
        assert status == int(bool(seen))
        missing = [name for name in names if not any(line.startswith(name) for line in seen)]
        if not missing:
            break
    return missing


def check_faults(program: Path, faults: dict[str, str]) -> None:
    """Run with each fault: the checks that it is about fail."""
    with ThreadPoolExecutor(4) as pool:
        missing = pool.map(lambda fault: unseen(program, fault, faults[fault]), faults)
        assert dict(zip(faults, missing, strict=True)) == {fault: [] for fault in faults}


def has_priorities(program: Path) -> bool:
    text = lines_of(start(program, one_processor=True))[1]
    return results(text)["lock_inheritance"][0] != "SKIP"


def test_the_port_to_posix_passes(program: Path) -> None:
    found = results(all_pass(program, one_processor=True))
    skipped = {name: why for name, (word, why) in found.items() if word == "SKIP"}
    if skipped.get("lock_inheritance"):
        print(skipped.pop("lock_inheritance"))
    assert "-DSELFTEST_LINK" in skipped.pop("link_down")
    for transport in ("tcp", "serial", "canfd"):
        assert skipped.pop(f"{transport}_link") == f"the library does not use '{transport}'"
    assert skipped == {
        name: f"the library does not use '{name}'"
        for name in ("microseconds", "stack_peak", "tcp", "serial", "multicast", "canfd", "storage")
    }
    assert {name for name in found if "/" in name} == {
        *("std_msgs/msg/Int32", "std_msgs/msg/Empty", "sensor_msgs/msg/Imu"),
        *("sensor_msgs/msg/JointState", "diagnostic_msgs/msg/DiagnosticArray"),
    }


def test_a_clock_that_wraps_meanwhile_passes(program: Path) -> None:
    all_pass(program, "wraps")


def test_a_clock_of_whole_ticks_is_no_second_processor(program: Path) -> None:
    """The middle task begins in the tick in which the low one ends: seen on FreeRTOS without a finer clock."""
    found = results(all_pass(program, "task_time_ticks", one_processor=True))
    assert "processors" not in found["lock_inheritance"][1]
    if has_priorities(program):
        assert found["lock_inheritance"][0] == "PASS"


def test_each_check_fails_where_the_port_has_the_fault(program: Path) -> None:
    faults = dict(HOST_FAULTS)
    if not has_priorities(program):
        faults.pop(PRIVILEGED)
    check_faults(program, faults)


def test_a_lock_that_is_not_recursive_stops_the_program(program: Path) -> None:
    process = start(program, "lock_once")
    assert process.stdout is not None
    before = [process.stdout.readline()]
    while not before[-1].startswith("PASS wake_from_timer"):
        assert before[-1] != ""
        before.append(process.stdout.readline())
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(0.3)
    process.kill()
    assert process.communicate()[0] == ""


@pytest.mark.system
@pytest.mark.skipif(shutil.which("clang") is None, reason="no clang")
def test_the_self_test_has_no_races(out: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Besides that of a stack that is looked at while its task runs, which port_tasks.h allows."""
    suppressed = out.parent / "suppressed"
    suppressed.write_text("race:port_task_stack_peak\n")
    monkeypatch.setenv("TSAN_OPTIONS", f"suppressions={suppressed}")
    program = link(["clang", "-g", "-O1", "-fsanitize=thread"], out, out / "tsan", TASKS)
    all_pass(program)


@contextmanager
def looped_line(path: Path) -> Iterator[None]:
    """A pseudo-terminal whose other end sends back what it gets."""
    ours, theirs = pty.openpty()
    tty.setraw(theirs)
    path.symlink_to(os.ttyname(theirs))
    stop = threading.Event()
    thread = threading.Thread(target=echo, args=(ours, stop))
    thread.start()
    try:
        yield
    finally:
        stop.set()
        os.write(theirs, b"x")
        thread.join()
        os.close(ours)
        os.close(theirs)


def echo(line: int, stop: threading.Event) -> None:
    with suppress(OSError):
        while not stop.is_set():
            os.write(line, os.read(line, 4096))


def test_a_serial_line_that_is_looped(outputs: Path) -> None:
    line = outputs / "line"
    out = generated(outputs / "serial", f"{HEAD}transport: {{type: serial, device: {line}}}\n{SMALL}")
    program = link(["gcc", "-O1"], out, out / "faulty", DECODER)
    with looped_line(line):
        assert results(all_pass(program))["serial_lengths"] == ("PASS", "")
        for fault in SERIAL_FAULTS:
            check_faults(program, {fault: SERIAL_FAULTS[fault]})
    assert results(lines_of(start(program))[1])["serial_open"] == (
        "FAIL",
        f"seen no line expected the line '{line}'",
    )


@contextmanager
def answering() -> Iterator[int]:
    """An agent at a port: it answers what asks for it, and nothing else."""
    agent = FakeAgent()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as served:
        served.bind(("127.0.0.1", 0))
        thread = threading.Thread(target=answer, args=(served, agent))
        thread.start()
        try:
            yield served.getsockname()[1]
        finally:
            served.sendto(b"", served.getsockname())
            thread.join()


def answer(served: socket.socket, agent: FakeAgent) -> None:
    datagram, peer = served.recvfrom(2048)
    while datagram:
        for message in agent.receive(datagram):
            served.sendto(message, peer)
        datagram, peer = served.recvfrom(2048)


def test_a_network_that_goes_down_and_up(outputs: Path) -> None:
    with answering() as port:
        text = f"{HEAD}transport: {{type: udp, agent: '127.0.0.1:{port}'}}\n{SMALL}"
        out = generated(outputs / "link", text)
        program = link(["gcc", "-O1", "-DSELFTEST_LINK"], out, out / "faulty", LINK)
        check_passes(program, "link_up_answers")
        check_faults(program, LINK_FAULTS)
    found = results(all_pass(program))
    assert (found["link_up_opens"][0], found["link_up_answers"][0]) == ("PASS", "SKIP")


@contextmanager
def connected() -> Iterator[int]:
    """An agent that listens at a port: it answers what asks for it, and nothing else."""
    stop = threading.Event()
    with socket.create_server(("127.0.0.1", 0)) as served:
        served.settimeout(0.1)
        thread = threading.Thread(target=accept, args=(served, stop))
        thread.start()
        try:
            yield served.getsockname()[1]
        finally:
            stop.set()
            thread.join()


def accept(served: socket.socket, stop: threading.Event) -> None:
    while not stop.is_set():
        with suppress(TimeoutError):
            connection, _ = served.accept()
            threading.Thread(target=answer_connection, args=(connection,), daemon=True).start()


def answer_connection(connection: socket.socket) -> None:
    """Answer messages, each after two bytes with its length, until the other end closes."""
    agent = FakeAgent()
    with connection, suppress(OSError), connection.makefile("rb") as stream:
        while len(length := stream.read(2)) == 2:
            for message in agent.receive(stream.read(int.from_bytes(length, "little"))):
                connection.sendall(len(message).to_bytes(2, "little") + message)


@pytest.mark.variant
def test_a_connection_whose_network_goes_down_and_up(outputs: Path) -> None:
    with connected() as port:
        text = f"{HEAD}transport: {{type: tcp, agent: '127.0.0.1:{port}'}}\n{SMALL}"
        out = generated(outputs / "tcp_link", text)
        program = link(["gcc", "-O1", "-DSELFTEST_LINK"], out, out / "faulty", LINK)
        check_passes(program, "tcp_link_up_answers")
        assert results(all_pass(program, "link_closes"))["tcp_link_down_receive_nothing"] == ("PASS", "")
        check_faults(program, TCP_LINK_FAULTS)
    found = results(all_pass(program))
    assert (found["tcp_link_up_opens"][0], found["tcp_link_up_answers"][0]) == ("PASS", "SKIP")


@pytest.mark.variant
def test_a_serial_line_that_is_unplugged_and_plugged_in(outputs: Path) -> None:
    line = outputs / "unplugged"
    out = generated(outputs / "serial_link", f"{HEAD}transport: {{type: serial, device: {line}}}\n{SMALL}")
    program = link(["gcc", "-O1", "-DSELFTEST_LINK"], out, out / "faulty", LINK)
    with looped_line(line):
        check_passes(program, "serial_link_up_returns")
        for fault in SERIAL_LINK_FAULTS:
            check_faults(program, {fault: SERIAL_LINK_FAULTS[fault]})


def test_a_connection_that_is_refused(outputs: Path) -> None:
    out = generated(outputs / "tcp", f"{HEAD}transport: {{type: tcp, agent: '127.0.0.1:8888'}}\n{SMALL}")
    program = link(["gcc", "-O1"], out, out / "faulty", DECODER)
    assert results(all_pass(program))["tcp_refused"] == ("PASS", "")
    check_faults(program, TCP_FAULTS)


@pytest.mark.system
def test_multicast(outputs: Path) -> None:
    text = f"{HEAD.replace('pure_reader', 'ad_hoc_discoverable_sender, pure_reader')}{SMALL}"
    out = generated(outputs / "multicast", text)
    program = link(["gcc", "-O1"], out, out / "faulty", DECODER)
    assert results(all_pass(program))["multicast_send"] == ("PASS", "")
    check_faults(program, MULTICAST_FAULTS)


@pytest.mark.system
def test_a_controller_that_is_looped(outputs: Path) -> None:
    with CanBus(outputs / "bus") as bus:
        out = generated(
            outputs / "can", f"{HEAD}transport: {{type: canfd, id: 0x7f, device: '{bus.device}'}}\n{SMALL}"
        )
        program = link(["gcc", "-O1"], out, out / "faulty", CAN)
        word, why = results(all_pass(program))["canfd_lengths"]
        assert (word, "loopback" in why) == ("SKIP", True), "a bus does not send a frame back"
        bus.echoes = True
        assert results(all_pass(program))["canfd_lengths"] == ("PASS", "")
        check_faults(program, CAN_FAULTS)
    word, why = results(lines_of(start(program))[1])["canfd_open"]
    assert (word, why.startswith("seen no controller expected the controller 'unix:")) == ("FAIL", True)


@pytest.mark.system
def test_a_bus_that_is_removed_and_returns(outputs: Path) -> None:
    with CanBus(outputs / "bus2") as bus:
        text = f"{HEAD}transport: {{type: canfd, id: 0x7f, device: '{bus.device}'}}\n{SMALL}"
        out = generated(outputs / "can_link", text)
        program = link(["gcc", "-O1", "-DSELFTEST_LINK"], out, out / "faulty", (*LINK, *CAN))
        found = results(all_pass(program))
        assert (found["canfd_link_up_opens"][0], found["canfd_link_up_returns"][0]) == ("PASS", "SKIP")
        bus.echoes = True
        check_passes(program, "canfd_link_up_returns")
        check_faults(program, CAN_LINK_FAULTS)


@pytest.mark.system
def test_storage_is_tested_where_a_slot_is_free(outputs: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    parameters = SMALL.replace("name: device,", "name: device, parameters: [{name: on, type: bool}],")
    out = generated(outputs / "storage", f"{HEAD}components: [+parameter_storage]\n{parameters}")
    monkeypatch.setenv("MICROROS_STORAGE", str(out))
    program = link(["gcc", "-O1", "-DSELFTEST_STORAGE_SLOT=9"], out, out / "faulty", STORAGE)
    assert results(all_pass(program))["storage_erases"] == ("PASS", "")
    assert (out / "microros_storage.9").stat().st_size == 24
    check_faults(program, STORAGE_FAULTS)
    shutil.rmtree(out / "objects-gcc")
    program = link(["gcc", "-O1"], out, out / "without", STORAGE)
    word, why = results(all_pass(program))["storage"]
    assert (word, "SELFTEST_STORAGE_SLOT" in why) == ("SKIP", True)


def run_on(name: str, image: Path, *arguments: str) -> str:
    """Return what a self-test prints in the emulator of a target."""
    emulator = target(name).emulator
    assert emulator is not None
    semihosting = ("-semihosting-config", "enable=on,target=native")
    machine = Machine(emulator.program, emulator.package, (*emulator.arguments, *semihosting, *arguments))
    process = subprocess.Popen(
        machine.command(image, restarts=False),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        running = Emulator(process)
        line = os.open(running.device(), os.O_RDWR | os.O_NOCTTY)
        stop = threading.Event()
        thread = threading.Thread(target=echo, args=(line, stop), daemon=True)
        thread.start()
        running.go_on()
        assert process.stderr is not None
        text = process.stderr.read()  # until the board is reset, which ends the emulator
        stop.set()
        return text
    finally:
        process.kill()
        process.communicate()


def board_image(outputs: Path, name: str, fault: str = "") -> Path:
    need(name, emulator=True)
    out = outputs / name / "out"
    if not out.is_dir():
        generated(outputs / name, BOARD, name)
    board = target(name)
    script = ("-T", str(out / "src" / "port_bare" / "image.ld"))
    flags = (f'-DFAULT="{fault}"', *DECODER)
    command = [board.compilers[0], *board.c_flags]
    return link(command, out, out / f"faulty{fault}.elf", flags, *board.link_flags, *script)


COUNTED = ("-icount", "shift=5,sleep=off")
"""The clock counts instructions and skips idle time: a busy machine delays nothing."""


@pytest.mark.parametrize("name", first(["qemu-mps2-an386", "qemu-riscv32-virt", "qemu-microbit"], 2))
def test_the_ports_to_boards_pass(outputs: Path, name: str) -> None:
    text = run_on(name, board_image(outputs, name), *COUNTED)
    assert failed(text) == []
    found = results(text)
    assert {"wake_from_timer", "stack_peak", "microseconds_agree", "sensor_msgs/msg/JointState"} <= {
        check for check, (word, _) in found.items() if word == "PASS"
    }


@pytest.mark.system
def test_the_checks_of_a_board_fail(outputs: Path) -> None:
    name = "qemu-mps2-an386"
    for fault, wanted in BOARD_FAULTS.items():
        seen = {
            line.partition(":")[0]
            for line in failed(run_on(name, board_image(outputs, name, fault), *COUNTED))
        }
        assert set(wanted.split()) <= seen, fault


def test_a_serial_line_of_a_board_that_is_looped(outputs: Path) -> None:
    name = "qemu-mps2-an386"
    assert results(run_on(name, board_image(outputs, name)))["serial_lengths"] == ("PASS", "")


def test_every_check_has_a_fault() -> None:
    """Each name in the C files is one that some fault makes fail."""
    of_lines = (SERIAL_FAULTS, TCP_FAULTS, MULTICAST_FAULTS, CAN_FAULTS)
    of_links = (LINK_FAULTS, TCP_LINK_FAULTS, SERIAL_LINK_FAULTS, CAN_LINK_FAULTS)
    faults = (HOST_FAULTS, *of_lines, *of_links, STORAGE_FAULTS, BOARD_FAULTS)
    wanted = [checks for group in faults for checks in group.values()]
    tested = {name for checks in wanted if ": " not in checks for name in checks.split()}
    folder = Path(checks_module.__file__).parent / "c"
    names = {pair[0] or pair[1] for path in folder.glob("*.c") for pair in NAMES.findall(path.read_text())}
    assert names - tested == UNSEEN
    assert tested <= names


def test_run_gives_the_result_of_a_board(outputs: Path, run: Runner) -> None:
    name = "qemu-mps2-an386"
    found = {}
    for fault in ("", "peak_zero", "stops"):
        image = board_image(outputs, name, fault)
        out = image.parent
        (out / "bin").mkdir(exist_ok=True)
        shutil.copy(image, out / "bin" / "selftest.elf")
        done = run("run", str(out), "--selftest")
        found[fault] = (done.status, re.findall(r"MG-\d+", done.err))
        assert ("stack_peak" in done.out) == (fault != "stops")
    assert found == {"": (0, []), "peak_zero": (1, []), "stops": (1, ["MG-7163"])}


def test_size_measures_the_self_test_of_this_plan_alone(outputs: Path, run: Runner) -> None:
    image = board_image(outputs, "qemu-mps2-an386")
    out = image.parent
    shown = run("size", str(out), "--image", str(image))
    assert (shown.status, "port_cortex_m" in shown.out) == (0, True), shown.out + shown.err
    manifest = out / "manifest.json"
    before = manifest.read_text()
    plan = json.loads(before)["plan"]
    manifest.write_text(before.replace(plan, plan[::-1]))
    try:
        refused = run("size", str(out), "--image", str(image))
    finally:
        manifest.write_text(before)
    assert (refused.status, "MG-8414" in refused.err) == (2, True)


def test_run_refuses_what_has_no_self_test(outputs: Path, run: Runner, out: Path) -> None:
    refused = run("run", str(out), "--selftest")
    assert (refused.status, "contains no self-test" in refused.err) == (2, True)
    assert run("run", str(out), "--selftest", "--image", str(out / "manifest.json")).status == 2


def test_build_says_why_a_self_test_has_no_image(out: Path) -> None:
    """A processor without memory, and a board that prints nowhere; the host has an image."""
    assert lacks_image(project_of("cortex-m4")).startswith("target cortex-m4 names a processor and no memory")
    board = project_of("qemu-mps2-an386")
    assert lacks_image(board) == ""
    silent = replace(board, target=replace(board.target, stdio=None))
    assert "define selftest_line" in lacks_image(silent)


def project_of(target: str) -> Project:
    options = compiler.Options(profiles=("pure_sender",), target=target, selftest=True)
    return compiler.plan(compiler.resolve(compiler.read(options))).project


def test_an_output_without_the_option_has_nothing_of_it() -> None:
    options = compiler.Options(profiles=("pure_sender",))
    plain = compiler.plan(compiler.resolve(compiler.read(options)))
    tested = compiler.plan(compiler.resolve(compiler.read(replace(options, selftest=True))))
    files, more = compiler.render(plain), compiler.render(tested)
    assert {name for name in more if name not in files} == {n for n in more if n.startswith("selftest/")}
    assert {name for name in files if files[name] != more[name]} == {"manifest.json"}
