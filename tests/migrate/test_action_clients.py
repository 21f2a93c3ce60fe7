# SPDX-License-Identifier: Apache-2.0
"""Action clients in sources of rclc → `action_clients:` of a node."""

from __future__ import annotations

import pytest

from tests.support.migrate.rclc import adopted, program, reasons

OPENS = 'rclc_action_client_init_default(&client, &node, ROSIDL_GET_ACTION_TYPE_SUPPORT(p, Walk), "walk");'
SERVES = OPENS.replace("client_init", "server_init").replace("&node,", "&node, &support,")


def test_a_client_has_its_type_and_goals() -> None:
    adds = "rclc_executor_add_action_client(&e, &client, 10, &r, &f, g, h, i, j, 0);"
    draft = adopted(program(f"{OPENS} {adds}")).draft
    (action,) = draft.nodes[0].actions
    assert (action.name, action.type, action.goals, action.is_client) == ("walk", "p/action/Walk", 10, True)
    assert "action_client" in " ".join(draft.components)
    assert "action_server" not in " ".join(draft.components)
    assert "p/action/Walk" not in draft.interfaces


def test_a_client_that_is_opened_again_is_there_once_and_next_to_a_server() -> None:
    actions = adopted(program(f"{OPENS} {OPENS} {SERVES}")).draft.nodes[0].actions
    assert [action.is_client for action in actions] == [True, False]


@pytest.mark.parametrize(
    ("call", "reason"),
    [
        (OPENS.replace('"walk"', "name_of(3)"), "the name of the action"),
        (
            f"{OPENS} rclc_executor_add_action_client(&e, &client, count(), &r, &f, g, h, i, j, 0);",
            "how many goals there are at once",
        ),
    ],
)
def test_what_is_not_known_is_said(call: str, reason: str) -> None:
    assert any(reason in message for message in reasons(program(call)))


def test_whether_a_server_is_there_needs_the_graph() -> None:
    asks = "rcl_action_server_is_available(&node, &client.rcl_handle, &available);"
    draft = adopted(program(f"{OPENS} {asks}")).draft
    assert {"+action_client", "+graph"} <= set(draft.components)
