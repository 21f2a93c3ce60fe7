# SPDX-License-Identifier: Apache-2.0
"""Plans of the images of a chip, each in a folder of its name below one folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.components.local_delivery.plan import LocalPlan
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder
from tests.support.ids import without_id


def planned(folder: Path, board: str = "first") -> compiler.Planned:
    """Plan an image."""
    options = compiler.Options(config=folder / board / "microros.yaml", interface_paths=(shipped_folder(),))
    return compiler.plan(compiler.resolve(compiler.read(options)))


def part(folder: Path, board: str) -> LocalPlan:
    """Return what an image has for local delivery."""
    found = planned(folder, board).project.runtime.features.of("local_delivery")
    assert isinstance(found, LocalPlan)
    return found


def refused(folder: Path, board: str = "first") -> str:
    """Return why an image is refused, without the folder and the id."""
    with pytest.raises(UserError) as caught:
        planned(folder, board)
    return without_id(str(caught.value)).replace(f"{folder}/", "")
