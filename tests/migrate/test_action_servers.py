# SPDX-License-Identifier: Apache-2.0
"""Action servers in sources of rclc → `actions:` of a node."""

from __future__ import annotations

import pytest

from tests.support.migrate.rclc import adopted, program, reasons

OPENS = 'rclc_action_server_init_default(&server, &node, &support, ROSIDL_GET_ACTION_TYPE_SUPPORT(p, Walk), "walk");'


def test_an_action_has_its_type_and_goals() -> None:
    draft = adopted(
        program(f"{OPENS} rclc_executor_add_action_server(&e, &server, 10, r, s, g, c, 0);")
    ).draft
    (action,) = draft.nodes[0].actions
    assert (action.name, action.type, action.goals) == ("walk", "p/action/Walk", 10)
    assert "action_server" in " ".join(draft.components)
    assert "p/action/Walk" not in draft.interfaces


def test_an_action_that_is_opened_again_is_there_once() -> None:
    assert len(adopted(program(f"{OPENS} {OPENS}")).draft.nodes[0].actions) == 1


@pytest.mark.parametrize(
    ("call", "reason"),
    [
        (OPENS.replace('"walk"', "name_of(3)"), "the name of the action"),
        (
            OPENS.replace("ACTION_TYPE_SUPPORT(p, Walk)", "SRV_TYPE_SUPPORT(p, srv, Walk)"),
            "the type of the action is",
        ),
        (
            f"{OPENS} rclc_executor_add_action_server(&e, &server, count(), r, s, g, c, 0);",
            "how many goals there are at once",
        ),
    ],
)
def test_what_is_not_known_is_said(call: str, reason: str) -> None:
    assert any(reason in message for message in reasons(program(call)))
