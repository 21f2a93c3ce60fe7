# SPDX-License-Identifier: Apache-2.0
"""A board that reports on itself, with a check and a measured callback: the application file of c/diagnosis.c."""

from __future__ import annotations

APPLICATION = """\
version: 1
profiles: [pure_sender]
errors: code
session: {connect_timeout: 60 s, create_timeout: 60 s, liveliness_timeout: 20 s}
nodes:
  - name: device
    namespace: /arm
    timers: [{name: tick, period: 20 ms}]
components: [+timers, +executor, +diagnosis]
memory: {stack: 8 KiB}
diagnosis:
  period: 500 ms
  stack: {warn: 35, error: 90}
  checks: [{name: heat, above: {error: 80}}]
  callbacks: [{name: tick, limit: 5 ms}]
"""
