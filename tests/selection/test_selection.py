# SPDX-License-Identifier: Apache-2.0
"""From profiles and an application to components with reasons, and every contradiction with both places."""

from __future__ import annotations

from collections.abc import Callable
from itertools import permutations
from pathlib import Path

import pytest

from microros_gen.cli.tables import selection_data
from microros_gen.diagnostics import Diagnostics
from microros_gen.selection.find_profiles import load_builtin_profiles
from microros_gen.selection.resolve import check_ready
from tests.support.ids import without_id
from tests.support.selection.profiles import BUILTIN_PROFILES
from tests.support.selection.small_catalogue import Outcome

Resolve = Callable[..., Outcome]

TWO_PUBLISHERS = """\
profiles: [pure_sender]
nodes:
  - name: imu
    publishers:
      - {topic: imu/data, type: sensor_msgs/msg/Imu, qos: {reliability: best_effort}}
      - {topic: "~/count", type: std_msgs/msg/Int32}
"""


@pytest.mark.parametrize("name", BUILTIN_PROFILES)
def test_every_profile_resolves(name: str, resolve: Resolve) -> None:
    outcome = resolve(name)
    assert outcome.messages == ()
    assert outcome.selection.profiles == (name,)
    assert all(c.reasons for c in outcome.selection.components)


WITH_NODES = [name for name, profile in load_builtin_profiles().items() if profile.nodes]


@pytest.mark.parametrize("first", BUILTIN_PROFILES)
@pytest.mark.parametrize("second", BUILTIN_PROFILES)
def test_pairs_give_the_union_in_any_order(first: str, second: str, resolve: Resolve) -> None:
    both = resolve(first, second)
    assert both.messages == ()
    union = set(resolve(first).names()) | set(resolve(second).names())
    dropped = {"entities_binary"} if "static_configured_sender" in (first, second) else set()
    if "pure_reader" in (first, second) and not {first, second}.isdisjoint(WITH_NODES):
        dropped |= {"stream_best_effort_input"}  # their nodes say what is created: no subscription
    assert set(both.names()) == union - dropped
    assert both.selection == resolve(second, first).selection


def test_order_of_the_input_changes_nothing(resolve: Resolve) -> None:
    keys = ["profiles: [pure_sender]", "components: [+timers, +clock]", "liveliness: none", "entities: xml"]
    found = {resolve(text="\n".join(order)).names() for order in permutations(keys)}
    assert len(found) == 1
    found |= {resolve(text="profiles: [pure_sender]\ncomponents: [+clock, +timers]\n").names()}
    assert len(found) == 2


def test_reasons_tell_the_whole_way(resolve: Resolve) -> None:
    outcome = resolve(text=TWO_PUBLISHERS)
    assert outcome.reasons("publish") == ("profile pure_sender",)
    assert outcome.reasons("node") == ("profile pure_sender", "needed by publish")
    assert outcome.reasons("entities_binary") == ("entities: binary (default)",)
    assert outcome.reasons("transport_udp") == ("transport: udp (default)",)
    assert outcome.reasons("ping") == ("liveliness: ping (default)",)
    assert outcome.reasons("port_posix") == ("target: host",)
    assert outcome.reasons("stream_reliable") == ("a reliable publisher on /imu/count (microros.yaml:6)",)
    assert outcome.reasons("stream_best_effort") == (
        "a best effort publisher on /imu/data (microros.yaml:5)",
        "entities: binary (CREATE goes on the best effort stream)",
    )


def test_causes_are_the_users_choices_with_places(resolve: Resolve) -> None:
    outcome = resolve(text="profiles: [pure_sender]\ncomponents: [+timers]\n")
    executor = next(c for c in outcome.selection.components if c.component.name == "executor")
    assert executor.reasons == ("needed by timers",)
    assert [(c.name, str(c.span)) for c in executor.causes] == [
        ("components: +timers (microros.yaml:2)", "microros.yaml:2:14")
    ]


def test_only_reliable_preconfigured_publishers_need_one_stream(resolve: Resolve) -> None:
    text = TWO_PUBLISHERS.replace("best_effort", "reliable") + "entities: preconfigured\nliveliness: none\n"
    names = resolve(text=text).names()
    assert "stream_reliable" in names
    assert "stream_best_effort" not in names
    assert "ping" not in names
    assert "entities_preconfigured" in names


def test_only_best_effort_publishers_need_no_reliable_stream(resolve: Resolve) -> None:
    names = resolve(text=TWO_PUBLISHERS.rsplit("\n", 2)[0] + "\n").names()
    assert "stream_best_effort" in names
    assert "stream_reliable" not in names


def test_an_application_without_nodes_may_create_any_publisher(resolve: Resolve) -> None:
    outcome = resolve("pure_sender")
    assert outcome.reasons("stream_reliable") == (
        "publishers without `nodes:` (rclc_publisher_init_default makes a reliable one)",
    )
    assert "stream_best_effort" in outcome.names()


def test_a_reader_needs_no_reliable_output_and_reads_reliably(resolve: Resolve) -> None:
    names = resolve("pure_reader").names()
    assert "stream_reliable_input" in names
    assert "stream_reliable" not in names
    text = (
        "profiles: [pure_reader]\nnodes: [{name: a, subscriptions: [{topic: b, type: std_msgs/msg/Bool}]}]\n"
    )
    assert resolve(text=text).reasons("stream_reliable_input") == (
        "a reliable subscription on /b (microros.yaml:2)",
    )
    best_effort = text.replace("Bool}", "Bool, qos: {reliability: best_effort}}")
    assert "stream_reliable_input" not in resolve(text=best_effort).names()


def test_axes_pick_their_components(resolve: Resolve) -> None:
    text = "profiles: [pure_sender]\nentities: xml\ntransport: {type: serial}\nliveliness: acknack\n"
    outcome = resolve(text=text)
    assert outcome.messages == ()
    assert outcome.reasons("entities_xml") == ("entities: xml (microros.yaml:2)",)
    assert outcome.reasons("transport_serial") == ("transport: serial (microros.yaml:3)",)
    assert outcome.reasons("liveliness_acknack") == ("liveliness: acknack (microros.yaml:4)",)
    assert not {"entities_binary", "transport_udp", "ping"} & set(outcome.names())
    assert [(a.axis, a.value, a.reason) for a in outcome.selection.axes][:1] == [
        ("entities", "xml", "microros.yaml:2")
    ]


def test_rosout_is_a_publisher(resolve: Resolve, tmp_path: Path) -> None:
    (tmp_path / "own.yaml").write_text(
        "profile: own\nsummary: Mine\nextends: [simulation_node]\nlogging: rosout\n"
    )
    outcome = resolve("own", folder=tmp_path)
    assert {"logging", "logging_rosout", "publish"} <= set(outcome.names())
    write = next(x for x in outcome.selection.xrce_profiles if x.name == "write")
    assert write.reasons == ("publish", "logging: rosout (profile own)")


def test_a_simulation_node_has_a_ros_clock_and_says_why(resolve: Resolve) -> None:
    outcome = resolve("simulation_node")
    assert outcome.reasons("clock_ros") == ("clock: ros (profile simulation_node)",)
    assert "clock" in outcome.names()
    assert resolve("pure_sender").names().count("clock") == 0


def test_a_static_sender_refers_and_can_be_preconfigured(resolve: Resolve) -> None:
    assert resolve("static_configured_sender").selection.entities == "reference"
    text = "profiles: [static_configured_sender]\nentities: preconfigured\n"
    outcome = resolve(text=text)
    assert outcome.messages == ()
    assert outcome.selection.entities == "preconfigured"


def test_the_port_is_the_targets(resolve: Resolve) -> None:
    text = "profiles: [pure_sender]\ntarget: cortex-m4\n"
    assert not any(name.startswith("port_") for name in resolve(text=text).names())
    assert resolve(text=text, parts=("port_posix",)).reasons("port_posix") == (
        "target: cortex-m4 (microros.yaml:2)",
    )


ERRORS = {
    "nothing": ("components: [+tymers]\n", "microros-gen: error: nothing is selected. Add `profiles:"),
    "unknown component": (
        "profiles: [pure_sender]\ncomponents: [+tymers]\n",
        "microros.yaml:2:14: error: unknown component 'tymers' (components: +tymers (microros.yaml:2)). "
        "Did you mean 'timers'?",
    ),
    "unknown drop": (
        "profiles: [pure_sender]\ncomponents: [-publihs]\n",
        "microros.yaml:2:14: error: unknown component 'publihs' (components: -publihs). "
        "Did you mean 'publish'?",
    ),
    "add and drop": (
        "profiles: [pure_sender]\ncomponents:\n  - +timers\n  - -timers\n",
        "microros.yaml:4:5: error: '-timers' contradicts '+timers' (microros.yaml:3). Remove one of them",
    ),
    "dropped and needed": (
        "profiles: [pure_sender]\ncomponents: [-node]\n",
        "microros.yaml:2:14: error: '-node' drops a component that publish needs (selected by "
        "profile pure_sender (microros.yaml:1)). Drop publish too, or remove '-node'",
    ),
    "dropped and chosen by an axis": (
        "profiles: [pure_sender]\ncomponents: [-ping]\n",
        "microros.yaml:2:14: error: '-ping' drops a component that is selected by liveliness: ping "
        "(default). "
        "Change `liveliness:`, or remove '-ping'",
    ),
    "dropped and wanted by a declaration": (
        TWO_PUBLISHERS + "components: [-stream_reliable]\n",
        "microros.yaml:7:14: error: '-stream_reliable' drops a component that is selected by a reliable "
        "publisher on /imu/count (microros.yaml:6). Change that, or remove '-stream_reliable'",
    ),
    "declared and not selected": (
        "profiles: [pure_sender]\nnodes:\n  - name: a\n    timers: [{name: t, period: 1 s}]\n",
        "microros.yaml:4:14: error: a timer needs the component 'timers', which this version of microros-gen does not "
        "have yet. Remove it",
    ),
    "publisher of a profile without": (
        "profiles: [simulation_node]\nnodes:\n  - name: a\n    publishers: [{topic: t, type: a/msg/B}]\n",
        "microros.yaml:4:18: error: a publisher needs the component 'publish', which nothing selects. "
        "Add `components: [+publish]`, or a profile that has it",
    ),
    "another value's component": (
        "profiles: [pure_sender]\nentities: preconfigured\ncomponents: [+entities_xml]\n",
        "microros.yaml:3:14: error: the component 'entities_xml' (components: +entities_xml "
        "(microros.yaml:3)) "
        "belongs to entities: xml and contradicts entities: preconfigured (microros.yaml:2). "
        "Write `entities: xml` instead of it",
    ),
    "acknack without a reliable stream": (
        TWO_PUBLISHERS.rsplit("\n", 2)[0] + "\nliveliness: acknack\n",
        "microros.yaml:6:13: error: liveliness: acknack (microros.yaml:6) needs a reliable stream, "
        "and no selected component "
        "has one. Make a publisher reliable, or write `liveliness: ping`",
    ),
    "agent search over a serial line": (
        "profiles: [ad_hoc_discoverable_sender]\ntransport: {type: serial}\n",
        "microros.yaml:2:19: error: transport: serial (microros.yaml:2) contradicts the component "
        "'discovery' "
        "(profile ad_hoc_discoverable_sender (microros.yaml:1)): agents "
        "are searched "
        "for by UDP multicast. Write `transport: {type: udp}`, or drop it: `components: [-discovery]`",
    ),
    "pools of what is not selected": (
        "profiles: [pure_sender]\npools: {nodes: 2, timers: 3, services: 0, slot_size: 99}\n",
        "microros.yaml:2:19: warning: 'pools.timers' has no effect: nothing selects the component 'timers'. "
        "Remove it, or add `components: [+timers]`",
    ),
    "pools of two components": (
        "profiles: [pure_sender]\npools: {queue: 9}\n",
        "microros.yaml:2:9: warning: 'pools.queue' has no effect: nothing selects the component 'services' or "
        "'subscribe'. Remove it, or add `components: [+services]`",
    ),
    "sleep over TCP": (
        "profiles: [pure_sender]\ncomponents: [+sleep_cycles]\ntransport: {type: tcp}\n",
        "microros.yaml:3:19: error: transport: tcp (microros.yaml:3) contradicts the component 'sleep_cycles' "
        "(components: +sleep_cycles (microros.yaml:2)): the session ends with its connection. "
        "Write `transport: {type: udp}`, or drop it: `components: [-sleep_cycles]`",
    ),
    "sleep and agent search": (
        "profiles: [ad_hoc_discoverable_sender]\ncomponents: [+sleep_cycles]\n",
        "microros.yaml:1:12: error: the component 'discovery' (profile ad_hoc_discoverable_sender "
        "(microros.yaml:1)) contradicts 'sleep_cycles' (components: +sleep_cycles (microros.yaml:2)): an agent is "
        "searched for at each start. "
        'Give its address: `transport: {agent: "192.168.1.10:8888"}`',
    ),
}


@pytest.mark.parametrize("case", ERRORS)
def test_contradictions_name_both_places(case: str, resolve: Resolve) -> None:
    text, expected = ERRORS[case]
    messages = resolve(text=text).messages
    assert any(line.startswith(expected) for line in messages), messages


def test_all_contradictions_are_reported_in_one_run(resolve: Resolve) -> None:
    text = "profiles: [pure_sender]\ncomponents: [-node, -ping, +tymers]\nentities: xml\n"
    assert len([line for line in resolve(text=text).messages if ": error: " in line]) == 3


def test_a_drop_without_effect_is_a_warning(resolve: Resolve) -> None:
    messages = resolve(text="profiles: [pure_sender]\ncomponents: [-timers]\n").messages
    assert messages == (
        "microros.yaml:2:14: warning: '-timers' drops nothing: no selected profile has 'timers'",
    )


def test_dropping_what_a_profile_has(resolve: Resolve) -> None:
    text = "profiles: [ad_hoc_discoverable_sender]\ncomponents: [-discovery]\n"
    outcome = resolve(text=text)
    assert outcome.messages == ()
    assert "discovery" not in outcome.names()


def ready_errors(outcome: Outcome) -> list[str]:
    messages = Diagnostics()
    check_ready(outcome.selection, messages)
    return [without_id(d.headline()) for d in messages]


def test_a_pure_sender_is_ready(resolve: Resolve) -> None:
    assert ready_errors(resolve("pure_sender")) == []


def test_what_is_planned_is_named_with_who_asked(resolve: Resolve) -> None:
    assert ready_errors(resolve("pure_reader"))[0] == (
        "microros-gen: error: profile pure_reader needs the components subscribe, "
        "executor, cdr_decode, which this version of microros-gen does not have yet. `microros-gen profiles` "
        "shows what is ready, `microros-gen resolve` why each is needed"
    )
    assert ready_errors(resolve(text="profiles: [pure_reader]\n"))[0].startswith(
        "microros.yaml:1:12: error: "
    )
    static = ready_errors(resolve(text="profiles: [static_configured_sender]\n"))
    assert static[0].startswith(
        "microros.yaml:1:12: error: entities: reference (profile static_configured_sender)"
    )
    errors = ready_errors(resolve(text="profiles: [pure_sender]\nentities: xml\ncomponents: [+clock]\n"))
    assert [e.split(", which")[0] for e in errors] == [
        "microros.yaml:3:14: error: components: +clock (microros.yaml:3) needs the component clock",
        "microros.yaml:2:11: error: entities: xml (microros.yaml:2) needs the component entities_xml",
    ]


def test_a_users_profile_far_away_is_no_problem(resolve: Resolve, tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text("profile: mine\nextends: [pure_sender]\ncomponents: [+clock]\n")
    outcome = resolve("mine", folder=tmp_path)
    assert outcome.messages == ()
    assert outcome.selection.profiles == ("mine",)
    assert outcome.reasons("publish") == ("profile mine",)


def test_an_axis_with_several_values_brings_what_each_brings(resolve: Resolve) -> None:
    text = "profiles: [pure_sender]\nlogging: [console, {to: callback, level: warn}]\n"
    outcome = resolve(text=text)
    axes = [(a.value, a.reason) for a in outcome.selection.axes if a.axis == "logging"]
    assert axes == [(v, "microros.yaml:2") for v in ("console", "callback")]
    names = {c.component.name for c in outcome.selection.components}
    assert {"logging", "logging_console"} <= names
    logging = next(c for c in outcome.selection.components if c.component.name == "logging")
    assert "logging: callback (microros.yaml:2)" in logging.reasons
    data = selection_data(outcome.selection)["axes"]["logging"]
    assert (data["value"], [f["value"] for f in data["further"]]) == ("console", ["callback"])


def test_the_default_of_such_an_axis_selects_nothing(resolve: Resolve) -> None:
    names = {c.component.name for c in resolve("pure_sender").selection.components}
    assert not [name for name in names if name.startswith("logging")]
