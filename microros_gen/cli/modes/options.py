# SPDX-License-Identifier: Apache-2.0
"""What the commands on a model file share."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

model_argument = click.argument("model", metavar="SYSTEM.yaml", type=click.Path(path_type=Path))

format_option = click.option(
    "--format",
    "kind",
    type=click.Choice(("table", "json")),
    default="table",
    show_default=True,
    help="Lines for people, or JSON for programs.",
)


def json_text(data: dict[str, Any]) -> str:
    """Return data as JSON with a line end."""
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"
