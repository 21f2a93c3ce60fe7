# SPDX-License-Identifier: Apache-2.0
"""`microros-gen completion SHELL`: the script with which a shell completes the command line."""

from __future__ import annotations

import click

PROGRAM = "microros-gen"
_VARIABLE = "_MICROROS_GEN_COMPLETE"
"""The variable by which click is asked for completions: derived from the program's name."""


@click.command()
@click.argument("shell", type=click.Choice(("bash", "zsh", "fish")))
@click.pass_context
def command(ctx: click.Context, shell: str) -> None:
    """Print a script for SHELL that completes commands, options, and names of profiles, targets and interfaces.

    Load it in the start-up file of the shell; bash must be 4.4 or newer.

    \b
    microros-gen completion bash > ~/.local/share/bash-completion/completions/microros-gen
    microros-gen completion zsh > ~/.zfunc/_microros-gen
    microros-gen completion fish > ~/.config/fish/completions/microros-gen.fish
    """
    from click.shell_completion import get_completion_class

    completion = get_completion_class(shell)
    assert completion is not None
    click.echo(completion(ctx.find_root().command, {}, PROGRAM, _VARIABLE).source(), nl=False)
