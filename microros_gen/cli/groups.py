# SPDX-License-Identifier: Apache-2.0
"""Commands that are groups of commands."""

from __future__ import annotations

import click

from microros_gen.diagnostics import nearest


class CommandGroup(click.Group):
    """Commands of which a wrong name gets the nearest one."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Return the command that the arguments begin with; UsageError with a proposal for a wrong name."""
        if args and not args[0].startswith("-") and args[0] not in self.commands:
            hint = nearest(args[0], self.commands) or f"Available: {', '.join(self.commands)}"
            raise click.UsageError(f"unknown command '{args[0]}'. {hint}", ctx)
        return super().resolve_command(ctx, args)
