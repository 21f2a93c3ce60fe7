# SPDX-License-Identifier: Apache-2.0
"""Boards with an action server and an action client: the application files of c/actions.c and c/action_client.c."""

from __future__ import annotations

SERVER = """\
version: 1
components: [+action_server]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    namespace: /arm
    actions: [{name: fibonacci, type: test_msgs/action/Fibonacci, goals: 2}]
limits: {"*": {sequence: 16}}
"""
CLIENT = """\
version: 1
components: [+action_client]
errors: code
session: {connect_timeout: 20 s, create_timeout: 20 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    namespace: /arm
    action_clients: [{name: fibonacci, type: test_msgs/action/Fibonacci, goals: 2, response_timeout: 1 s}]
limits: {"*": {sequence: 16}}
"""
