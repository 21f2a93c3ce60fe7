# SPDX-License-Identifier: Apache-2.0
"""What the generated main.c runs with an executor: declared handles, timers and timeouts, and what it omits."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.client.plan.project import Project
from microros_gen.client.views.example import ExampleView, example_view
from microros_gen.client.views.example_running import RunningView
from microros_gen.diagnostics import Source, UserError

HEAD = "version: 1\nprofiles: [pure_sender, pure_reader]\nlimits: {'*': {string: 16}}\n"
NODE = """\
nodes:
  - name: arm
    publishers: [{topic: state, type: std_msgs/msg/Int32}, {topic: beat, type: std_msgs/msg/Int32}]
    subscriptions: [{topic: order, type: std_msgs/msg/Int32}, {topic: stop, type: std_msgs/msg/Bool}]
"""
TIMERS = "    timers: [{name: fast, period: 20 ms}, {name: slow, period: 1500 us}]\n"


def project_of(text: str, folder: Path) -> Project:
    request = compiler.read_source(Source(str(folder / "microros.yaml"), text), folder)
    return compiler.plan(compiler.resolve(request)).project


def viewed(text: str, folder: Path) -> ExampleView:
    return example_view(project_of(text, folder))


def running(text: str, folder: Path) -> RunningView:
    view = viewed(text, folder).running
    assert view is not None
    return view


def calls(view: RunningView) -> list[list[str]]:
    """Return what each executor is given, without the library's prefix and the other arguments."""
    found = []
    for executor in view.executors:
        words = [" ".join(call.split()).removeprefix("rclc_executor_") for call in executor.calls]
        found.append([word.replace("( ", "(").replace(f"&{executor.variable}, ", "") for word in words])
    return found


@pytest.mark.parametrize(
    ("handles", "places"),
    [("power", 2), ("power, order", 3), ("order, stop", 2)],
)
def test_a_name_of_two_things_has_two_places(handles: str, places: int, tmp_path: Path) -> None:
    """A service and its client may have one name; the library's table of handles has room for both."""
    services = "".join(
        f"    {kind}: [{{name: power, type: std_srvs/srv/SetBool}}]\n" for kind in ("services", "clients")
    )
    executors = f"    executors: [{{name: a, handles: [{handles}]}}]\n"
    planned = project_of(
        HEAD + "components: [+executor, +services]\n" + NODE + services + executors, tmp_path
    )
    assert planned.runtime.executor.handles_max == places


def test_a_publisher_is_nothing_that_an_executor_runs(tmp_path: Path) -> None:
    text = HEAD + "components: [+executor]\n" + NODE + "    executors: [{name: a, handles: [beat]}]\n"
    with pytest.raises(UserError, match="the node has no timer, subscription or service 'beat'"):
        project_of(text, tmp_path)


def test_an_example_without_an_executor_has_a_loop(tmp_path: Path) -> None:
    assert viewed("version: 1\nprofiles: [pure_sender]\n", tmp_path).running is None


def test_declared_executors_run_their_handles_in_their_order(tmp_path: Path) -> None:
    executors = "    executors: [{name: a, handles: [stop, fast], timeout: 5 ms}, {name: b, handles: [order, slow]}]\n"
    view = running(HEAD + "components: [+timers]\n" + NODE + TIMERS + executors, tmp_path)
    assert calls(view) == [
        [
            "set_timeout(RCL_MS_TO_NS(5))",
            "add_subscription(&subscription_1, &bool_received_1, on_bool_received_1, ON_NEW_DATA)",
            "add_timer(&timer_0)",
        ],
        [
            "set_timeout(RCL_MS_TO_NS(10))",  # one task: none waits for long while the other has work
            "add_subscription(&subscription_0, &int32_received_0, on_int32_received_0, ON_NEW_DATA)",
            "add_timer(&timer_1)",
        ],
    ]
    assert [executor.handles for executor in view.executors] == [2, 2]
    assert [timer.period for timer in view.timers] == ["RCL_MS_TO_NS(20)", "RCL_US_TO_NS(1500)"]
    assert [[sent.what for sent in timer.sends] for timer in view.timers] == [["state"], ["beat"]]
    assert (view.sends, view.left_out) == ((), ())


def test_what_no_executor_has_is_said(tmp_path: Path) -> None:
    executors = "    executors: [{name: a, handles: [order, fast]}]\n"
    view = running(HEAD + "components: [+timers]\n" + NODE + TIMERS + executors, tmp_path)
    assert set(view.left_out) == {"topic stop", "timer slow"}
    assert [received.topic for received in view.received] == ["order"]
    assert [[sent.what for sent in timer.sends] for timer in view.timers] == [["state", "beat"]]


def test_everything_is_run_where_nothing_is_declared(tmp_path: Path) -> None:
    services = "    services: [{name: power, type: std_srvs/srv/SetBool}]\n"
    view = running(HEAD + "components: [+timers, +services]\n" + NODE + services + TIMERS, tmp_path)
    assert [call.partition("(")[0] for call in calls(view)[0]] == [
        "add_timer",
        "add_timer",
        "add_subscription",
        "add_subscription",
        "add_service",
    ]


@pytest.mark.parametrize(
    ("text", "period", "sends"),
    [
        (HEAD + "components: [+timers]\n" + NODE, "RCL_MS_TO_NS(EXAMPLE_PERIOD_MS)", ("state", "beat")),
        (
            "version: 1\nprofiles: [pure_sender]\ncomponents: [+timers]\n",
            "RCL_MS_TO_NS(EXAMPLE_PERIOD_MS)",
            ("int32",),
        ),
    ],
)
def test_a_place_for_an_undeclared_timer_is_used(
    text: str, period: str, sends: tuple[str, ...], tmp_path: Path
) -> None:
    (timer,) = running(text, tmp_path).timers
    assert (timer.period, tuple(sent.what for sent in timer.sends)) == (period, sends)


def test_without_timers_publishers_go_out_between_the_rounds(tmp_path: Path) -> None:
    view = running(HEAD + "components: [+executor]\n" + NODE, tmp_path)
    assert (view.timers, [sent.what for sent in view.sends]) == ((), ["state", "beat"])


def test_a_timer_of_the_hardware_is_left_to_the_application(tmp_path: Path) -> None:
    """Its port_hardware_timer_start is not there to be linked."""
    text = HEAD + "components: [+timers]\n" + NODE + "    timers: [{name: a, period: 1 s, kind: hardware}]\n"
    view = running(text, tmp_path)
    assert (view.timers, view.left_out) == ((), ("timer a (port_hardware_timer_start is yours to write)",))
    assert [sent.what for sent in view.sends] == ["state", "beat"]
