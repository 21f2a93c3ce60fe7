# SPDX-License-Identifier: Apache-2.0
"""Return codes against ROS 2's librcl: of calls with wrong arguments, and of calls in every state of an entity."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from collections.abc import Iterable
from pathlib import Path

import pytest

from tests.support.runtime.harness import FIXTURES, Tree, compile_merged, link
from tests.support.runtime.returns import FLAGS, FOLDER, results_of, returned
from tests.support.runtime.surface import generate, write_application

pytestmark = pytest.mark.ros
STATES = """\
version: 1
profiles: [pure_sender, pure_reader]
components: [+timers, +executor, +clock, +services, +name_substitutions]
interfaces: [std_msgs/msg/Int32, std_srvs/srv/SetBool]
limits: {'*': {string: 16, sequence: 4}}
entities: binary
pools: {nodes: 2, publishers: 2, subscriptions: 2, services: 2, clients: 2, timers: 2, guard_conditions: 3}
"""
GRAPH = """\
version: 1
profiles: [pure_sender]
components: [+graph]
entities: binary
nodes: [{name: device, namespace: /arm}]
"""

ACTIONS = """\
version: 1
components: [+action_server, +action_client]
nodes:
  - name: device
    actions: [{name: walk, type: example_interfaces/action/Fibonacci}]
    action_clients: [{name: run, type: example_interfaces/action/Fibonacci}]
limits: {'*': {string: 16, sequence: 4}}
"""
RCLC_ACTIONS = """\
version: 1
components: [+action_server, +action_client, +executor]
nodes:
  - name: n
    actions: [{name: walk, type: example_interfaces/action/Fibonacci, goals: 2}]
    action_clients: [{name: run, type: example_interfaces/action/Fibonacci, goals: 2}]
limits: {'*': {string: 16, sequence: 4}}
"""

DIFFERENT: dict[str, tuple[int, int]] = {}
"""Call: what librcl returns, and what is returned here, for a reason."""


SHUT_DOWN = {
    "rcl_subscription_is_valid(&subscription)": (1, 0),
    "rcl_take(&subscription, &message, NULL, NULL)": (401, 400),
}
"""A context that is shut down takes its session along, and with it what was in it."""
DIFFERENT_STATES = {
    # Fast DDS takes its own default for writers, transient local; here it is volatile, as for readers.
    "qos->durability": (1, 2),
    # rcl takes it, and then has a timer that rcl_timer_init2 would have refused.
    "rcl_timer_exchange_period(&timer, -5, &value)": (0, 11),
    **SHUT_DOWN,
}


DIFFERENT_RCLC = {
    # As for every other NULL and every other node that is none.
    'rclc_publisher_init_default(&publisher, NULL, type, "a")': (11, 200),
    'rclc_subscription_init_default(&subscription, NULL, type, "b")': (11, 200),
    # rclc spins one that is finalized, and not one that was never initialized.
    "rclc_executor_spin_some(executor, 1)": (0, 1),
    "rclc_executor_spin_one_period(executor, 1)": (0, 1),
}


DIFFERENT_RCLC_ACTIONS = {
    # As for publishers and subscriptions.
    'rclc_action_server_init_default(&server, NULL, &support, type, "walk")': (11, 200),
    'rclc_action_client_init_default(&client, NULL, type, "run")': (11, 200),
    "rclc_action_server_fini(&server, NULL)": (11, 200),
    "rclc_action_client_fini(&client, NULL)": (11, 200),
    # As for a server.
    'rclc_action_client_init_default(&client, &node, type, "")': (1, 2000),
}


def of_librcl(source: Path, folder: Path, *packages: str, more: Iterable[str] = ()) -> list[tuple[str, int]]:
    """Return what the program says over librcl and `more` libraries; `packages`: the interfaces that it uses."""
    prefix = Path(sys.prefix)
    theirs = folder / "theirs.so"
    folders = [f"-I{p}" for p in sorted((prefix / "include").iterdir()) if p.is_dir()]
    libraries = [f"-L{prefix / 'lib'}", "-lrcl", "-lrmw", "-lrcutils", "-Wl,--allow-shlib-undefined"]
    libraries += [f"-l{package}__rosidl_typesupport_c" for package in packages]
    libraries += [f"-l{name}" for name in more]
    command = ["gcc", "-w", "-shared", "-fPIC", *folders, str(source), *libraries, "-o", str(theirs)]
    subprocess.run(command, check=True)
    bundled = sorted(Path(sysconfig.get_path("purelib")).glob("*.libs"))
    paths = os.pathsep.join(map(str, (prefix / "lib", *bundled)))
    # Some of librcl's libraries are for Python alone, so an interpreter has to load them.
    load = f"import ctypes; ctypes.CDLL({str(theirs)!r}).main()"
    return results_of(folder, sys.executable, "-c", load, LD_LIBRARY_PATH=paths, ROS_DOMAIN_ID="")


def of_ours(source: Path, tree: Tree, folder: Path, more: Iterable[Path] = ()) -> list[tuple[str, int]]:
    """Return what the program says over a generated library."""
    objects = compile_merged(tree, tree.sources, [source, *more], "gcc", FLAGS)
    return results_of(folder, link(objects, "gcc", (), folder / "mine"))


def differing(ours: list[tuple[str, int]], known: list[tuple[str, int]]) -> dict[str, tuple[int, int]]:
    """Return what is not the same: librcl's, then ours."""
    assert [name for name, _ in ours] == [name for name, _ in known]
    return {
        f"{index} {name}": (other, own)
        for index, ((name, own), (_, other)) in enumerate(zip(ours, known, strict=True))
        if own != other
    }


def test_every_call_returns_what_librcl_returns(tmp_path: Path) -> None:
    source = FOLDER / "returns.c"
    ours = of_ours(source, generate(tmp_path / "ours", "custom"), tmp_path)
    found = differing(ours, of_librcl(source, tmp_path))
    assert {key.split(" ", 1)[1]: pair for key, pair in found.items()} == DIFFERENT
    assert len(ours) > 150


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Tree:
    """Return a library without a port: the tests bring one, with an agent after it."""
    whole = write_application(tmp_path_factory.mktemp("states") / "ours", STATES)
    return Tree(whole.folder, tuple(s for s in whole.sources if not s.parent.name.startswith("port_posix")))


@pytest.mark.system
def test_every_state_returns_what_librcl_returns(tree: Tree, tmp_path: Path) -> None:
    source = FOLDER / "states.c"
    ours = of_ours(source, tree, tmp_path, [FIXTURES / "port_agent.c"])
    found = differing(ours, of_librcl(source, tmp_path, "std_msgs", "std_srvs"))
    assert {key.split(" ", 1)[1]: pair for key, pair in found.items()} == DIFFERENT_STATES
    assert len(found) == 2 + 1 + 2 * len(SHUT_DOWN)
    assert len(ours) > 500


def test_every_state_returns_what_rclc_returns(tree: Tree, tmp_path: Path) -> None:
    """The wheels have no rclc: states_rclc.txt says what its commit f401871 returned over their librcl."""
    ours = of_ours(FOLDER / "states_rclc.c", tree, tmp_path, [FIXTURES / "port_agent.c"])
    lines = (FOLDER / "states_rclc.txt").read_text(encoding="utf-8").splitlines()
    found = differing(ours, returned(lines))
    assert {key.split(" ", 1)[1]: pair for key, pair in found.items()} == DIFFERENT_RCLC
    assert len(found) == 2 + len(DIFFERENT_RCLC)


@pytest.mark.system
def test_names_that_the_graph_refuses_are_those_of_librcl(tmp_path: Path) -> None:
    source = FOLDER / "graph_names.c"
    whole = write_application(tmp_path / "ours", GRAPH)
    tree = Tree(whole.folder, tuple(s for s in whole.sources if not s.parent.name.startswith("port_posix")))
    ours = of_ours(source, tree, tmp_path, [FIXTURES / "port_agent.c"])
    assert differing(ours, of_librcl(source, tmp_path)) == {}
    assert {202, 201, 200, 11} <= {value for _, value in ours}
    assert len(ours) > 80


def test_actions_return_what_librcl_action_returns(tmp_path: Path) -> None:
    """Every state with every event, goals in every state, lists, names, and what is not open."""
    source = FOLDER / "actions.c"
    ours = of_ours(source, write_application(tmp_path / "ours", ACTIONS), tmp_path)
    assert differing(ours, of_librcl(source, tmp_path, more=["rcl_action"])) == {}
    assert len(ours) > 250


def test_actions_return_what_rclc_returns(tmp_path: Path) -> None:
    """Every function of rclc's action headers: wrong arguments, before and after each step, and with all goals in use.

    actions_rclc.txt says what rclc's commit f401871 returned over the wheels' librcl_action.
    """
    whole = write_application(tmp_path / "ours", RCLC_ACTIONS)
    tree = Tree(whole.folder, tuple(s for s in whole.sources if not s.parent.name.startswith("port_posix")))
    ours = of_ours(FOLDER / "actions_rclc.c", tree, tmp_path, [FIXTURES / "port_agent.c"])
    lines = (FOLDER / "actions_rclc.txt").read_text(encoding="utf-8").splitlines()
    found = differing(ours, returned(lines))
    assert {key.split(" ", 1)[1]: pair for key, pair in found.items()} == DIFFERENT_RCLC_ACTIONS
    assert len(found) == 2 * len(DIFFERENT_RCLC_ACTIONS)
