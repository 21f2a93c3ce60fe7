# SPDX-License-Identifier: Apache-2.0
"""An application of the profile configurable_sender_with_diagnostics, with each setting of `entities`."""

from __future__ import annotations

ENTITIES = ("binary", "xml", "reference", "preconfigured")
APPLICATION = """\
version: 1
profiles: [configurable_sender_with_diagnostics]
entities: {entities}
logging: [rosout, console]
limits: {{"*": {{string: 8, sequence: 1}}}}
nodes:
  - name: device
    publishers: [{{topic: diagnostics, type: diagnostic_msgs/msg/DiagnosticArray}}]
    parameters: [{{name: gain, type: double, default: 0.5}}, {{name: label, type: string, size: 8}}]
"""
