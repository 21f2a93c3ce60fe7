# SPDX-License-Identifier: Apache-2.0
"""Systems of nodes with modes, in the format of the package system_modes: read, prove, draw.

`read_model` returns a `Model`, `check` what is proven of it, `read_script` the events of a script, `draw` a picture.
Nothing here starts a node.
"""

from microros_gen.modes.inference import Inference
from microros_gen.modes.manager import Manager, Step
from microros_gen.modes.model import Command, Mode, Model, Part, Rule, Status, Value
from microros_gen.modes.picture import draw
from microros_gen.modes.reader import parse_model, read_model
from microros_gen.modes.report import Property, Report
from microros_gen.modes.script import Event, read_script
from microros_gen.modes.verification import check

__all__ = [
    "Command",
    "Event",
    "Inference",
    "Manager",
    "Mode",
    "Model",
    "Part",
    "Property",
    "Report",
    "Rule",
    "Status",
    "Step",
    "Value",
    "check",
    "draw",
    "parse_model",
    "read_model",
    "read_script",
]
