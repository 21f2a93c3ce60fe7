# SPDX-License-Identifier: Apache-2.0
"""What the server accepts while the board is away: the same as the board and rclcpp."""

from __future__ import annotations

import math

import pytest

from microros_gen.parameter_server.declared import Declared
from microros_gen.parameter_server.values import DOUBLE, ParameterValue

OUTSIDE = "Parameter {gain} doesn't comply with floating point range."


@pytest.mark.parametrize(
    ("value", "step", "accepted"),
    [
        (math.nan, 0.0, True),  # neither below nor above
        (math.nan, 0.25, False),  # no number of steps
        (math.inf, 0.0, True),  # compared with 100 times the precision of the sum, which is infinite
        (-math.inf, 0.0, True),
        (0.0, 0.0, True),
        (10.0, 0.0, True),
        (10.001, 0.0, False),
        (-0.001, 0.0, False),
        (3.3, 0.0, True),
        (3.25, 0.25, True),
        (3.3, 0.25, False),
    ],
)
def test_doubles_of_a_range(value: float, step: float, accepted: bool) -> None:
    declared = Declared("gain", DOUBLE, range=(0.0, 10.0, step))
    assert declared.refusal_of_request(ParameterValue(DOUBLE, value)) == ("" if accepted else OUTSIDE)
