# SPDX-License-Identifier: Apache-2.0
"""What sources use that this version does not have: the component that it belongs to, and where it stands."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from microros_gen.migrate.c_program import Call
from microros_gen.migrate.draft import Remark
from microros_gen.selection.component import NOT_READY

# Names with these prefixes belong to a component that does not exist yet, unless some component declares it.
_COMPONENTS = {
    "rclc_action_": "actions",
    "rclc_executor_add_action_": "actions",
    "rcl_action_": "actions",
    "rclc_parameter_": "parameters",
    "rclc_add_parameter": "parameters",
    "rclc_set_parameter": "parameters",
    "rclc_executor_add_parameter_server": "parameters",
    "rclc_make_node_a_lifecycle_node": "lifecycle",
    "rclc_lifecycle_": "lifecycle",
    "rcl_lifecycle_": "lifecycle",
    "RCUTILS_LOG_": "logging",
    "rcutils_logging_": "logging",
    "rcutils_log": "logging",
    "rcl_count_": "graph",
    "rcl_get_client_names_and_types_by_node": "graph",
    "rcl_get_node_names": "graph",
    "rcl_get_publisher_names_and_types_by_node": "graph",
    "rcl_get_publishers_info_by_topic": "graph",
    "rcl_get_service_names_and_types": "graph",
    "rcl_get_subscriber_names_and_types_by_node": "graph",
    "rcl_get_subscriptions_info_by_topic": "graph",
    "rcl_get_topic_names_and_types": "graph",
    "rcl_get_zero_initialized_names_and_types": "graph",
    "rcl_get_zero_initialized_topic_endpoint_info_array": "graph",
    "rcl_names_and_types_": "graph",
    "rcl_node_get_graph_guard_condition": "graph",
    "rcl_publisher_get_subscription_count": "graph",
    "rcl_service_server_is_available": "graph",
    "rcl_subscription_get_publisher_count": "graph",
    "rcl_topic_endpoint_info_": "graph",
    "rcl_wait_for_publishers": "graph",
    "rcl_wait_for_subscribers": "graph",
}
_KNOWN_BUT_NOT_DECLARED = ("rosidl_runtime_c__", "rmw_uros_set_custom_transport")
_UNKNOWN = "is not in this version"
_HINT = "Remove the call and what belongs to it"


def find_missing(called: Iterable[Call], declared: Mapping[str, str]) -> list[Remark]:
    """Return a remark for each component, or function of none, that is called and not there: its first call.

    `declared` says which component declares a function.
    """
    first: dict[str, Remark] = {}
    for call in called:
        if call.name in declared or call.name.startswith(_KNOWN_BUT_NOT_DECLARED):
            continue
        component = next((name for prefix, name in _COMPONENTS.items() if call.name.startswith(prefix)), "")
        what = f"needs the component '{component}', which {NOT_READY}" if component else _UNKNOWN
        remark = Remark(f"{call.name} {what}", call.span, refused=_HINT)
        first.setdefault(component or call.name, remark)
    return list(first.values())
