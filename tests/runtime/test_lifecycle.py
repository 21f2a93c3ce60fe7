# SPDX-License-Identifier: Apache-2.0
"""A life cycle with a scripted agent: replies in fragments, managed entities, lost sessions, sleep, clock wrap."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.ros.codec import ENCAPSULATION_BYTES, Codec
from tests.support.runtime.driver import Client
from tests.support.runtime.harness import FIXTURES, Tree, build, compile_objects, link
from tests.support.runtime.parts_agent import PARTS, PartsAgent
from tests.support.runtime.serving_agent import identity
from tests.support.runtime.surface import write_application

APPLICATION = """\
version: 1
profiles: [managed_service]
components: [+timers, +sleep_cycles, +session_state]
nodes:
  - name: device
    namespace: /arm
    publishers:
      - {topic: count, type: std_msgs/msg/Int32, managed: true}
      - {topic: status, type: std_msgs/msg/Int32}
    timers: [{name: control, period: 20 ms, managed: true}, {name: watch, period: 30 ms}]
"""
SERVICES = (
    ("change_state", "ChangeState"),
    ("get_available_states", "GetAvailableStates"),
    ("get_available_transitions", "GetAvailableTransitions"),
    ("get_state", "GetState"),
    ("get_transition_graph", "GetAvailableTransitions"),
)
PUBLISHERS, STEP_MS, SPINS = 3, 20, 12
EVENT, COUNT, STATUS = 0, 1, 2
CONFIGURE, CLEANUP, ACTIVATE, DEACTIVATE, SHUTDOWN = 1, 2, 3, 4, 7
NEARLY_WRAPPED = 2**32 - 700


class Device:
    """The program and its agent."""

    def __init__(self, client: Client, agent: PartsAgent, codec: Codec) -> None:
        self.client, self.agent, self._codec, self._requests = client, agent, codec, 0

    def start(self) -> None:
        for call in ("init", "make"):
            self.client.ok(call)

    def spin(self, times: int = SPINS) -> None:
        self.client.spin(times, STEP_MS)

    def request(self, service: str, **members: Any) -> int:
        kind = f"lifecycle_msgs/srv/{dict(SERVICES)[service]}_Request"
        return self.send(service, self._codec.encode(kind, members)[ENCAPSULATION_BYTES:])

    def send(self, service: str, body: bytes) -> int:
        """Send a request with these bytes."""
        self._requests += 1
        place = next(i for i, (name, _) in enumerate(SERVICES) if name == service)
        target = ((PUBLISHERS + place) << 4 | 8).to_bytes(2, "big")
        self.client.queued += self.agent.give(target, identity(self._requests) + body)
        return self._requests

    def answer(self, service: str, number: int) -> Any:
        (reply,) = [b[24:] for b in self.agent.answered if b[:24] == identity(number)]
        kind = f"lifecycle_msgs/srv/{dict(SERVICES)[service]}_Response"
        return self._codec.decode(kind, b"\0\1\0\0" + reply)

    def ask(self, service: str, spins: int = SPINS, **members: Any) -> Any:
        number = self.request(service, **members)
        self.spin(spins)
        return self.answer(service, number)

    def change(self, identifier: int, label: str = "") -> bool:
        return bool(self.ask("change_state", transition={"id": identifier, "label": label})["success"])

    def state(self) -> str:
        """Return the state, which the service and the program tell alike."""
        state: str = self.ask("get_state")["current_state"]["label"]
        assert self.client.ok("state").lines == (f"state {state}",)
        return state

    def graph(self) -> list[Any]:
        found: list[Any] = self.ask("get_transition_graph", 60)["available_transitions"]
        return found

    def calls(self) -> list[int]:
        (line,) = self.client.ok("calls").lines
        return [int(word) for word in line.split()[1:]]

    def dropped(self) -> int:
        (line,) = self.client.ok("statistics").lines
        return int(line.split()[1])

    def events(self) -> list[tuple[str, str]]:
        found = []
        for target, body in self.agent.written:
            if target == ((EVENT << 4) | 5).to_bytes(2, "big"):
                event = self._codec.decode("lifecycle_msgs/msg/TransitionEvent", b"\0\1\0\0" + body)
                found.append((event["start_state"]["label"], event["goal_state"]["label"]))
        return found


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Tree:
    return write_application(tmp_path_factory.mktemp("cycle") / "tree", APPLICATION)


@pytest.fixture(scope="module")
def program(tree: Tree) -> Path:
    return build(tree.without_port(), ["port_fake.c", "client_lifecycle.c"], "cycle")


@pytest.fixture(scope="module")
def codec() -> Codec:
    names = [Named(f"lifecycle_msgs/srv/{name}", None) for name in {kind for _, kind in SERVICES}]
    names.append(Named("lifecycle_msgs/msg/TransitionEvent", None))
    finder = InterfaceFinder.from_environment((shipped_folder(),))
    return Codec(resolve_interfaces(tuple(names), finder, Diagnostics()))


@pytest.fixture
def device(program: Path, codec: Codec) -> Iterator[Device]:
    agent = PartsAgent()
    with Client(program, agent) as client:
        yield Device(client, agent, codec)


@pytest.mark.parametrize("start_ms", [0, NEARLY_WRAPPED], ids=["zero", "wraps"])
def test_the_graph_is_sent_in_parts(device: Device, start_ms: int) -> None:
    device.client.wait(start_ms)
    device.start()
    graph = device.graph()
    assert len(graph) == 25
    assert device.agent.parts[:-1] == [64] * (len(device.agent.parts) - 1)
    assert [
        t["transition"]["label"] for t in device.ask("get_available_transitions")["available_transitions"]
    ] == [
        "configure",
        "shutdown",
    ]
    assert device.graph() == graph
    device.client.ok("end")


@pytest.mark.parametrize("start_ms", [0, NEARLY_WRAPPED], ids=["zero", "wraps"])
def test_lost_parts_are_repeated(device: Device, start_ms: int) -> None:
    """Every second part and every third acknowledgement of one are lost."""
    device.client.wait(start_ms)
    device.start()
    seen = {"up": 0, "down": 0}

    def lost(way: str, every: int, is_part: bool) -> bool:
        seen[way] += is_part
        return is_part and seen[way] % every == 0

    device.agent.drop = lambda datagram: lost("up", 2, datagram[1] == PARTS)
    device.agent.drop_answer = lambda answer: lost(
        "down", 3, answer[4] == 0x0A and len(answer) > 12 and answer[12] == PARTS
    )
    assert len(device.ask("get_transition_graph", 600)["available_transitions"]) == 25
    assert device.agent.spoiled == 0


def test_two_requests_for_the_graph(device: Device) -> None:
    """The second one waits until the first is answered; other services are not delayed."""
    device.start()
    first = device.request("get_transition_graph")
    second = device.request("get_transition_graph")
    assert device.state() == "unconfigured"
    device.spin(120)
    assert device.answer("get_transition_graph", first) == device.answer("get_transition_graph", second)


def test_a_session_lost_between_parts(device: Device) -> None:
    """The reply begins again, and what the agent has of the old one is no message."""
    device.start()
    number = device.request("get_transition_graph")
    device.agent.drop = lambda datagram: datagram[1] == PARTS and len(device.agent.parts) == 5
    device.spin(20)
    assert len(device.agent.parts) == 5
    device.agent.restart()
    device.agent.drop = lambda datagram: False
    device.spin(400)
    assert len(device.answer("get_transition_graph", number)["available_transitions"]) == 25
    assert device.agent.spoiled == 1
    assert 0 in device.agent.parts
    device.agent.spoiled = 0
    assert len(device.graph()) == 25
    assert device.agent.spoiled == 0


def test_a_service_closed_between_parts(device: Device) -> None:
    device.start()
    device.request("get_transition_graph")
    device.agent.drop = lambda datagram: datagram[1] == PARTS and len(device.agent.parts) == 5
    device.spin(20)
    device.client.ok("close")
    device.agent.drop = lambda datagram: False
    parts = len(device.agent.parts)
    device.spin(100)
    assert len(device.agent.parts) <= parts + 1
    assert device.state() == "unconfigured"


@pytest.mark.parametrize("start_ms", [0, NEARLY_WRAPPED], ids=["zero", "wraps"])
def test_publishers_and_timers_follow_the_state(device: Device, start_ms: int) -> None:
    device.client.wait(start_ms)
    device.start()
    wanted = {COUNT: list[int](), STATUS: list[int]()}
    value = 0
    for path, active in (
        ((), False),
        ((CONFIGURE,), False),
        ((ACTIVATE,), True),
        ((DEACTIVATE,), False),
        ((ACTIVATE,), True),
    ):
        for step in path:
            assert device.change(step)
        dropped = device.dropped()
        device.calls()
        for _ in range(3):
            value += 1
            device.client.ok(f"managed {value}")
            device.client.ok(f"free {value}")
            device.spin(3)
            wanted[STATUS].append(value)
            wanted[COUNT] += [value] if active else []
        managed, free = device.calls()
        assert free == 6
        assert managed == (9 if active else 0)
        assert device.dropped() - dropped == (0 if active else 3)
    for publisher, values in wanted.items():
        assert device.agent.values(publisher) == values
    assert device.change(SHUTDOWN)
    assert device.state() == "finalized"
    device.client.ok("managed 99")
    device.spin()
    assert device.agent.values(COUNT) == wanted[COUNT]


def test_a_timer_begins_with_a_whole_period(device: Device) -> None:
    """When its node becomes active, and also after another period was set; it remains managed."""
    device.start()
    device.client.ok("period 50")
    device.client.spin(10, 10)
    assert device.calls()[0] == 0
    device.client.ok(f"change {CONFIGURE}")
    device.client.ok(f"change {ACTIVATE}")
    device.client.spin(4, 10)
    assert device.calls()[0] == 0
    device.client.spin(1, 10)
    assert device.calls()[0] == 1


def test_the_state_outlasts_the_agent(device: Device) -> None:
    device.start()
    assert device.change(CONFIGURE)
    device.agent.silent = True
    device.spin(400)  # the session is lost
    device.client.ok(f"change {ACTIVATE}")
    device.agent.silent = False
    device.agent.restart()
    device.spin(600)
    assert device.state() == "active"
    device.client.ok("managed 5")
    device.spin()
    assert device.agent.values(COUNT) == [5]
    assert device.events()[:2] == [("unconfigured", "configuring"), ("configuring", "inactive")]


def test_the_state_survives_a_sleep(device: Device, program: Path, codec: Codec, tmp_path: Path) -> None:
    device.start()
    for step in (CONFIGURE, ACTIVATE):
        assert device.change(step)
    device.client.ok(f"sleep {tmp_path / 'memory'}")
    with Client(program, device.agent) as client:
        client.wait(77_000)
        client.ok(f"wake {tmp_path / 'memory'}")
        woken = Device(client, device.agent, codec)
        woken._requests = 100
        woken.start()
        assert woken.state() == "active"
        client.ok("managed 7")
        woken.spin()
        assert device.agent.values(COUNT) == [7]
        assert len(woken.graph()) == 25
        assert woken.change(DEACTIVATE)
    with Client(program, PartsAgent()) as client:  # a cold start
        cold = Device(client, PartsAgent(), codec)
        cold.agent = client.agent  # type: ignore[assignment]
        cold.start()
        assert cold.state() == "unconfigured"


def test_a_reply_survives_a_sleep_between_its_parts(
    device: Device, program: Path, codec: Codec, tmp_path: Path
) -> None:
    """It goes on when the node has its life cycle again: only then its bytes are known."""
    device.start()
    number = device.request("get_transition_graph")
    device.spin(20)
    device.client.ok(f"sleep {tmp_path / 'memory'}")
    before = len(device.agent.parts)
    assert before > 1
    assert not device.agent.answered
    with Client(program, device.agent) as client:
        client.wait(77_000)
        client.ok(f"wake {tmp_path / 'memory'}")
        woken = Device(client, device.agent, codec)
        client.ok("init")
        woken.spin()
        assert len(device.agent.parts) == before
        client.ok("make")
        woken.spin(200)
        assert len(woken.answer("get_transition_graph", number)["available_transitions"]) == 25
    assert device.agent.spoiled == 0


def test_a_reply_without_a_body_neither_begins_nor_is_waited_for(tree: Tree, tmp_path: Path) -> None:
    """After a sleep a device that waits for its node would otherwise poll."""
    sources = (FIXTURES / "unit_parts.c", next(s for s in tree.sources if s.name == "xrce_parts.c"))
    flags = ("-std=c99", "-Wall", "-Werror", "-ffunction-sections", "-Wl,--gc-sections")
    program = tmp_path / "parts"
    subprocess.run(["gcc", *flags, f"-I{tree.include}", *sources, "-o", program], check=True)
    assert subprocess.run([program], capture_output=True, text=True, check=True).stdout == "ok\n"


def test_labels_of_any_length(device: Device) -> None:
    device.start()
    assert device.change(0, "configure")
    for label in ("transition_failure", "x" * 18):
        assert not device.change(0, label)
    for size in (
        19,
        24,
        60,
        300,
        900,
    ):  # what is too large is reported, and answered; the last two come in fragments
        number = device.request("change_state", transition={"id": ACTIVATE, "label": "y" * size})
        device.client.wait(STEP_MS)
        codes = [device.client.call("spin").code for _ in range(SPINS)]
        assert codes.count(0) >= SPINS - 1
        assert not device.answer("change_state", number)["success"]
    assert device.state() == "inactive"


def test_a_request_that_ends_early_is_reported(device: Device) -> None:
    """It is neither answered nor obeyed, and the next one is."""
    device.start()
    for body in (b"", b"\1", b"\1\0\0\0\1\0\0", b"\1\0\0\0\2\0\0\0\0", b"\1\0\0\0\xff\xff\xff\xff\0"):
        answered = len(device.agent.answered)
        device.send("change_state", body)
        device.client.wait(STEP_MS)
        codes = [device.client.call("spin").code for _ in range(SPINS)]
        assert codes.count(0) == SPINS - 1, body
        assert len(device.agent.answered) == answered, body
        assert device.state() == "unconfigured"
    assert device.change(CONFIGURE)


CYCLE = (CONFIGURE, ACTIVATE, DEACTIVATE, CLEANUP)
EVENTS = [
    *(("unconfigured", "configuring"), ("configuring", "inactive"), ("inactive", "activating")),
    *(("activating", "active"), ("active", "deactivating"), ("deactivating", "inactive")),
    *(("inactive", "cleaningup"), ("cleaningup", "unconfigured")),
]


def test_events_wait_for_room_in_order(device: Device) -> None:
    """Eight wait besides those in the stream; of more the oldest are dropped, and counted."""
    device.start()
    for step in CYCLE:
        device.client.ok(f"change {step}")
    device.spin()
    assert device.events() == EVENTS
    device.agent.silent = True
    before = device.dropped()
    for step in CYCLE * 3:
        device.client.ok(f"change {step}")
    assert device.client.ok("state").lines == ("state unconfigured",)
    dropped = device.dropped() - before
    assert 0 < dropped <= 24 - 8
    device.agent.silent = False
    device.spin(60)
    assert len(device.events()) == 8 + 24 - dropped
    assert device.events()[-8:] == EVENTS


PROTOTYPES = {
    "rcl_lifecycle/rcl_lifecycle.h": (
        "rcl_lifecycle_state_machine_options_t rcl_lifecycle_get_default_state_machine_options(void)",
        "rcl_lifecycle_state_machine_t rcl_lifecycle_get_zero_initialized_state_machine(void)",
        "rcl_ret_t rcl_lifecycle_state_machine_init(rcl_lifecycle_state_machine_t *, rcl_node_t *,"
        " const rosidl_message_type_support_t *, const rosidl_service_type_support_t *,"
        " const rosidl_service_type_support_t *, const rosidl_service_type_support_t *,"
        " const rosidl_service_type_support_t *, const rosidl_service_type_support_t *,"
        " const rcl_lifecycle_state_machine_options_t *)",
        "rcl_ret_t rcl_lifecycle_state_machine_fini(rcl_lifecycle_state_machine_t *, rcl_node_t *)",
        "rcl_ret_t rcl_lifecycle_state_machine_is_initialized(const rcl_lifecycle_state_machine_t *)",
        "const rcl_lifecycle_transition_t * rcl_lifecycle_get_transition_by_id("
        "const rcl_lifecycle_state_t *, uint8_t)",
        "const rcl_lifecycle_transition_t * rcl_lifecycle_get_transition_by_label("
        "const rcl_lifecycle_state_t *, const char *)",
        "rcl_ret_t rcl_lifecycle_trigger_transition_by_id(rcl_lifecycle_state_machine_t *, uint8_t, bool)",
        "rcl_ret_t rcl_lifecycle_trigger_transition_by_label(rcl_lifecycle_state_machine_t *, const char *, bool)",
        "void rcl_print_state_machine(const rcl_lifecycle_state_machine_t *)",
    ),
    "rclc_lifecycle/rclc_lifecycle.h": (  # rclc 6.2, commit f401871
        "rcl_ret_t rclc_lifecycle_init_get_state_server(rclc_lifecycle_service_context_t *, rclc_executor_t *)",
        "rcl_ret_t rclc_lifecycle_init_get_available_states_server("
        "rclc_lifecycle_service_context_t *, rclc_executor_t *)",
        "rcl_ret_t rclc_lifecycle_init_change_state_server(rclc_lifecycle_service_context_t *, rclc_executor_t *)",
        "void rclc_lifecycle_get_state_callback(const void *, void *, void *)",
        "void rclc_lifecycle_get_available_states_callback(const void *, void *, void *)",
        "void rclc_lifecycle_change_state_callback(const void *, void *, void *)",
        "rcl_ret_t rclc_make_node_a_lifecycle_node(rclc_lifecycle_node_t *, rcl_node_t *,"
        " rcl_lifecycle_state_machine_t *, rcl_allocator_t *, bool)",
        "rcl_ret_t rclc_lifecycle_change_state(rclc_lifecycle_node_t *, unsigned int, bool)",
        "rcl_ret_t rclc_lifecycle_register_callback(rclc_lifecycle_node_t *, unsigned int, int (*)(void))",
        "rcl_ret_t rclc_lifecycle_register_on_configure(rclc_lifecycle_node_t *, int (*)(void))",
        "rcl_ret_t rclc_lifecycle_register_on_activate(rclc_lifecycle_node_t *, int (*)(void))",
        "rcl_ret_t rclc_lifecycle_register_on_deactivate(rclc_lifecycle_node_t *, int (*)(void))",
        "rcl_ret_t rclc_lifecycle_register_on_cleanup(rclc_lifecycle_node_t *, int (*)(void))",
        "rcl_ret_t rclc_lifecycle_execute_callback(rclc_lifecycle_node_t *, unsigned int)",
        "rcl_ret_t rclc_lifecycle_node_fini(rclc_lifecycle_node_t *, rcl_allocator_t *)",
    ),
}
MEMBERS = """
static void use(rcl_lifecycle_state_machine_t * m, rcl_lifecycle_state_t * s, rcl_lifecycle_transition_t * t)
{
  const rcl_lifecycle_state_t * current = m->current_state;
  const char * labels[] = {s->label, t->label, rcl_lifecycle_configure_label, rcl_lifecycle_cleanup_label,
    rcl_lifecycle_activate_label, rcl_lifecycle_deactivate_label, rcl_lifecycle_shutdown_label,
    rcl_lifecycle_transition_success_label, rcl_lifecycle_transition_failure_label,
    rcl_lifecycle_transition_error_label};
  const rcl_lifecycle_transition_t * valid = s->valid_transitions;
  unsigned int sizes = s->valid_transition_size + m->transition_map.states_size + m->transition_map.transitions_size;
  const rcl_lifecycle_state_t * ends[] = {t->start, t->goal, m->transition_map.states};
  rcl_service_t * services[] = {&m->com_interface.srv_change_state, &m->com_interface.srv_get_state,
    &m->com_interface.srv_get_available_states, &m->com_interface.srv_get_available_transitions,
    &m->com_interface.srv_get_transition_graph};
  rcl_publisher_t * publisher = &m->com_interface.pub_transition_event;
  lifecycle_msgs__msg__TransitionEvent * event = &m->com_interface.msg;
  rcl_node_t * node = m->com_interface.node_handle;
  bool flags = m->options.initialize_default_states && m->options.enable_com_interface;
  rcl_allocator_t * allocator = &m->options.allocator;
  uint8_t id = s->id;
  (void)current, (void)labels, (void)valid, (void)sizes, (void)ends, (void)services, (void)publisher;
  (void)event, (void)node, (void)flags, (void)allocator, (void)id;
}
void (*used)(rcl_lifecycle_state_machine_t *, rcl_lifecycle_state_t *, rcl_lifecycle_transition_t *) = use;
"""


def declared(*headers: str) -> str:
    each = [prototype for header in headers for prototype in PROTOTYPES[header]]
    names = [match[1] for prototype in each if (match := re.search(r"(\w+)\(", prototype))]
    table = "".join(f"  (any_t){name},\n" for name in names)
    return (
        "".join(f"#include <{header}>\n" for header in headers)
        + MEMBERS
        + "typedef void (*any_t)(void);\nextern const any_t surface[];\n"
        + f"const any_t surface[] = {{\n{table}}};\n"
        + "".join(f"extern {prototype};\n" for prototype in each)
        + "int main(void) { return 0; }\n"
    )


@pytest.mark.system
def test_every_function_has_its_prototype_and_links(tree: Tree, tmp_path: Path) -> None:
    uses = tmp_path / "uses.c"
    uses.write_text(declared(*PROTOTYPES), encoding="utf-8")
    flags = ("-O0", "-Wno-redundant-decls", "-Wno-cast-function-type", "-Wno-unused-value")
    objects = compile_objects(tree, [uses, *tree.sources], "gcc", flags)
    link(objects, "gcc", (), tmp_path / "surface")


@pytest.mark.ros
def test_these_are_the_prototypes_of_jazzy(tmp_path: Path) -> None:
    source = tmp_path / "jazzy.c"
    source.write_text(declared("rcl_lifecycle/rcl_lifecycle.h"), encoding="utf-8")
    folders = [f"-I{p}" for p in sorted((Path(sys.prefix) / "include").iterdir()) if p.is_dir()]
    command = ["gcc", *folders, "-fsyntax-only", "-Werror", "-Wno-cast-function-type", str(source)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
