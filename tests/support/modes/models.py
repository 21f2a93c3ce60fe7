# SPDX-License-Identifier: Apache-2.0
"""The model files of tests/modes/models, and models from texts."""

from __future__ import annotations

from microros_gen.diagnostics import Diagnostic, Diagnostics, Source
from microros_gen.modes import Model, parse_model
from tests.support.paths import TESTS

MODELS = TESTS / "modes" / "models"


def model_text(name: str) -> str:
    return (MODELS / f"{name}.yaml").read_text(encoding="utf-8")


def model_of(text: str) -> Model:
    """Return the model of a text without mistakes."""
    model, found = parsed(text)
    assert model is not None, [d.render() for d in found]
    return model


def parsed(text: str) -> tuple[Model | None, list[Diagnostic]]:
    diagnostics = Diagnostics()
    return parse_model(Source("m.yaml", text), diagnostics), list(diagnostics)


def changed(text: str, old: str, new: str) -> str:
    """Return a text with one part of it replaced, which has to be in it."""
    assert old in text, old
    return text.replace(old, new, 1)
