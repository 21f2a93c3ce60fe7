# SPDX-License-Identifier: Apache-2.0
"""Scripts that are played on a model, and the nodes of a small cell."""

from __future__ import annotations

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.mode_manager.simulation import Played, simulate
from microros_gen.modes.script import parse_script
from tests.support.modes.models import model_of

CELL_NODES = """\
p: {ros__parameters: {type: node, modes: {__DEFAULT__: {ros__parameters: {v: 1}}}}}
q:
  ros__parameters:
    type: node
    modes:
      __DEFAULT__: {ros__parameters: {w: 1}}
      SLOW: {ros__parameters: {w: 0}}
"""


def play(script: str, text: str) -> Played:
    """Return what the manager of a model does when the events of a script happen; both are texts of files."""
    model, found = model_of(text), Diagnostics()
    events = parse_script(Source("s.yaml", script), model, found)
    assert not found.has_errors(), [d.render() for d in found]
    return simulate(model, events)
