# SPDX-License-Identifier: Apache-2.0
"""Whatever a model file has in it, the answer is a report: no exception, no endless run."""

from __future__ import annotations

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.mode_manager.simulation import simulate
from microros_gen.modes import draw, parse_model
from microros_gen.modes.script import parse_script
from microros_gen.modes.verification import check_model
from tests.support.examples import examples
from tests.support.modes.models import model_of, model_text

TEXTS = [model_text(name) for name in ("arm", "robot", "two_arms")]
WORDS = sorted(
    {word for text in TEXTS for word in text.replace(":", " ").split()} | {"~", "[]", "{}", "3", "- x"}
)
SCRIPT = "- {at: 1 s, request: arm, target: active.QUICK}\n- {at: 2 s, fail: joint, state: inactive}\n"


@st.composite
def damaged(draw: st.DrawFn, text: str) -> str:
    """Draw a text in which lines are removed or repeated, or words replaced by others of the format."""
    lines = text.splitlines()
    for _ in range(draw(st.integers(1, 3))):
        if not lines:
            break
        at = draw(st.integers(0, len(lines) - 1))
        match draw(st.integers(0, 2)):
            case 0:
                del lines[at]
            case 1:
                lines.insert(draw(st.integers(0, len(lines))), lines[at])
            case _:
                words = lines[at].split()
                if words:
                    lines[at] = lines[at].replace(
                        draw(st.sampled_from(words)), draw(st.sampled_from(WORDS)), 1
                    )
    return "\n".join(lines) + "\n"


@settings(max_examples=examples(150), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.sampled_from(TEXTS).flatmap(damaged))
def test_a_damaged_model_is_read_or_reported(text: str) -> None:
    diagnostics = Diagnostics()
    model = parse_model(Source("m.yaml", text), diagnostics)
    if model is None:
        errors = [d for d in diagnostics if d.severity.value == "error"]
        assert errors
        assert all(d.id != "MG-0002" for d in errors)
        return
    assert check_model(model, most=1000).exit_status in (0, 1, 2)
    assert draw(model).endswith("</svg>\n")


@settings(max_examples=examples(100), deadline=None)
@given(damaged(SCRIPT))
def test_a_damaged_script_is_played_or_reported(text: str) -> None:
    diagnostics, model = Diagnostics(), model_of(TEXTS[0])
    try:
        events = parse_script(Source("s.yaml", text), model, diagnostics)
    except UserError as error:  # an internal error has this class, too
        raise AssertionError(str(error)) from error
    if not diagnostics.has_errors():
        assert simulate(model, events).text()
