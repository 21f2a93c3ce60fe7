# SPDX-License-Identifier: Apache-2.0
"""What `parameters: {at: agent}` plans, and what it refuses."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.components.parameters.plan import ParametersPlan
from microros_gen.diagnostics import UserError
from tests.support.components.rendered import planned

HELD = """\
version: 1
profiles: [pure_sender]
components: [+parameters]
nodes:
  - name: arm
    parameters:
      at: agent
      declare: [{name: gain, type: double}, {name: mode, type: integer, default: 1, one_of: [1, 2]}]
  - {name: leg, parameters: {at: agent}}
"""


def refusals(tmp_path: Path, text: str) -> list[str]:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, text)
    return [f"{diagnostic.message}: {diagnostic.hint}" for diagnostic in caught.value.diagnostics]


def test_one_service_and_one_publisher_for_each_node(tmp_path: Path) -> None:
    runtime = planned(tmp_path, HELD).project.runtime
    services = [service.name for service in runtime.entities.services.declared]
    assert services == ["/arm/exchange_parameters", "/leg/exchange_parameters"]
    part = runtime.features.of("parameters")
    assert isinstance(part, ParametersPlan)
    assert (part.held, part.handles, part.max) == (True, 2, 2)


def test_one_holder_for_all_nodes(tmp_path: Path) -> None:
    text = HELD.replace("name: leg, parameters: {at: agent}", "name: leg, parameters: {at: device}")
    assert refusals(tmp_path, text) == [
        "the parameters of 'leg' are held by the device, those of 'arm' are not: Write at: agent at each node"
    ]


def test_the_component_alone_is_refused(tmp_path: Path) -> None:
    text = "version: 1\nprofiles: [pure_sender]\ncomponents: [+parameters_held]\nnodes: [{name: arm}]\n"
    found = refusals(tmp_path, text)
    assert any(line.endswith(": Write `parameters: {at: agent}` at each node") for line in found), found
