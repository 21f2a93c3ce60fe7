# SPDX-License-Identifier: Apache-2.0
"""`init --from` on sources that use what executors have beyond rclc: each call selects its component."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.migrate.proposals import Init

SOURCE = """\
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rclc/executor.h>
#include <std_msgs/msg/int32.h>
#include <example_interfaces/srv/add_two_ints.h>
%(header)s
int main(void)
{
  rclc_node_init_default(&node, "device", "arm", &support);
  rclc_subscription_init_default(
    &subscription, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "numbers");
  rclc_client_init_default(
    &client, &node, ROSIDL_GET_SRV_TYPE_SUPPORT(example_interfaces, srv, AddTwoInts), "/sum");
  rclc_executor_init(&executor, &support.context, 2, &allocator);
  rclc_executor_add_subscription(&executor, &subscription, &message, on_message, ON_NEW_DATA);
  %(call)s
}
"""
CALLS = {
    "rclc_executor_call_service(&executor, &client, &request, &response, timeout);": "service_call",
    "rclc_executor_remove_node(&executor, &node);": "executor_nodes",
    "rcl_subscription_set_on_new_message_callback(&subscription, on_new, NULL);": "new_data_callbacks",
    "rcl_client_set_on_new_response_callback(&client, on_new, NULL);": "new_data_callbacks",
    "rcl_subscription_event_init(&event, &subscription, RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED);": "qos_events",
    "rclc_stamp(&clock, &stamp.sec, &stamp.nanosec);": "clock_stamp",
    "rmw_uros_epoch_stamp(&stamp.sec, &stamp.nanosec);": "time_sync",
}
HEADERS = {
    "service_call": "#include <rclc/service_call.h>",
    "executor_nodes": "#include <rclc/executor_nodes.h>",
    "qos_events": "#include <rcl/event.h>",
    "clock_stamp": "#include <rclc/stamp.h>",
    "time_sync": "#include <rmw_microros/rmw_microros.h>",
}


@pytest.mark.parametrize("call", CALLS, ids=lambda call: call.partition("(")[0])
def test_a_call_selects_its_component(call: str, init: Init, tmp_path: Path) -> None:
    component = CALLS[call]
    others = set(CALLS.values()) - {component}
    sources = tmp_path / "sources"
    sources.mkdir()
    text = SOURCE % {"header": HEADERS.get(component, ""), "call": call}
    (sources / "main.c").write_text(text, encoding="utf-8")
    status, out, err = init("app", "--from", str(sources))
    assert status == 0, out + err
    proposed = (tmp_path / "app/microros.yaml").read_text(encoding="utf-8")
    assert f"+{component}" in proposed, proposed
    assert not any(f"+{other}" in proposed for other in others), proposed
