# SPDX-License-Identifier: Apache-2.0
"""The option `--workers`."""

from __future__ import annotations

from typing import Any

import click

from microros_gen.agent.workers.count import AUTO, MOST, worker_count


class _Count(click.ParamType[int]):
    """A number, or `auto`."""

    name = "count"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the number of workers."""
        count = value if isinstance(value, int) else worker_count(value)
        if count is None:
            self.fail(f"'{value}' is neither a number from 1 to {MOST} nor {AUTO}.", param, ctx)
        return count


workers_option = click.option(
    "--workers",
    type=_Count(),
    metavar="N|auto",
    help="Serve the clients in N processes, each client in one of them; auto: as many as there are processors that the"
    " agent may use. Default: 1.",
)
