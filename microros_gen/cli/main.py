# SPDX-License-Identifier: Apache-2.0
"""The program `microros-gen`: picks the command, prints diagnostics, sets the exit status."""

from __future__ import annotations

import gc
import importlib
import os
import sys
import traceback
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from microros_gen import __version__
from microros_gen.cli.terminal import echo_found
from microros_gen.diagnostics import TRACEBACK, UserError, internal_error, nearest

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

# Command → one line of help; each is the object `command` of the module of the same name (`_` for `-`), imported when
# used.
_COMMANDS = {
    "build": "Generate, compile to lib/libmicroros.a and link the profile's example.",
    "generate": "Write the C sources of a selection, without compiling.",
    "package": "Write the sources of a plan as a package of another build system.",
    "check": "Compare what would be generated with a golden copy.",
    "size": "Show flash, RAM and stack of what was built, per component and entity.",
    "schedule": "Show whether the tasks of what was built meet their deadlines.",
    "stacks": "Show the stack that each task of an image needs, and write the sizes.",
    "locks": "Show for how long each task of an image holds the library's lock.",
    "explain": "Show why a symbol, file or component is in the image, and what would remove it.",
    "resolve": "Print components, XRCE profiles, pools and sizes, each with its reason.",
    "profiles": "List the profiles, or show what one of them selects.",
    "interfaces": "List packages and types, or show one of them.",
    "targets": "List the targets, or show one of them.",
    "init": "Write a new application folder, from a profile or from existing sources.",
    "doctor": "Show what this machine lacks for each way to build and run, and how to get it.",
    "schema": "List the JSON Schemas of the YAML files for editors, or print one of them.",
    "completion": "Print the script with which a shell completes commands, options and names.",
    "run": "Start a built image together with an agent.",
    "system": "Check the boards of a system file together.",
    "modes": "Check, simulate, draw and manage systems of nodes with modes.",
    "agent": "Connect XRCE clients to ROS 2.",
    "topic": "List, print, publish, measure and record topics.",
    "bag": "Play and describe recordings of topics.",
    "service": "List and call services.",
    "action": "List actions and send goals.",
    "param": "Show, set and delete parameters of nodes.",
    "node": "List nodes and show what they have.",
    "lifecycle": "Show and change the states of nodes with a life cycle.",
    "graph": "Draw the nodes of a ROS graph and what they exchange.",
    "graph-server": "Answer queries of the ROS graph for firmware.",
    "parameter-server": "Hold the parameters of firmware.",
    "time-server": "Publish the time of a simulation, which stands still, jumps, or runs at another speed.",
}


# They end soon and make few cycles: collecting these takes 5 to 14 % of a run and frees 2 MB of 96 for 1000 messages.
_UNCOLLECTED = ("generate", "build", "check")


class _LazyGroup(click.Group):
    """Imports a command's module only when that command is used: start-up time is part of every build."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _COMMANDS:
            return None
        module = importlib.import_module(f"microros_gen.cli.{cmd_name.replace('-', '_')}")
        command: click.Command = module.command
        return command

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem[str]]:
        """Offer the commands with their help, without importing them; options where the text begins with a dash."""
        if incomplete.startswith("-"):
            return super().shell_complete(ctx, incomplete)
        from click.shell_completion import CompletionItem

        return [CompletionItem(n, help=h) for n, h in _COMMANDS.items() if n.startswith(incomplete)]

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if args and not args[0].startswith("-") and args[0] not in _COMMANDS:
            hint = nearest(args[0], _COMMANDS)
            raise click.UsageError(f"unknown command '{args[0]}'. {hint or ''}".rstrip(), ctx)
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(_COMMANDS.items()))


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="microros-gen")
def cli() -> None:
    """Turn ROS 2 interfaces and YAML profiles into static, allocation-free C99 for microcontrollers.

    \b
    microros-gen build --profile pure_sender      creates build/pure_sender/lib/libmicroros.a
    microros-gen agent udp4 --port 8888           connects firmware to ROS 2

    Exit status: 0 success; 1 a check differs, a build fails or a budget is exceeded; 2 invalid usage or input.
    """


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit; shows a traceback only where MICROROS_GEN_TRACEBACK asks for one.

    `arguments` come from a caller in the same process, whose garbage collection goes on; None: this is the program.
    """
    uncollected = arguments is None and sys.argv[1:2] and sys.argv[1] in _UNCOLLECTED
    if uncollected:
        gc.disable()
    status = _status(arguments)
    if uncollected and hasattr(gc, "freeze"):
        gc.freeze()  # what exists now is not searched for cycles at the end, either: 30 to 50 ms
    sys.exit(status)


def _status(arguments: Sequence[str] | None) -> int:
    try:
        result = cli.main(args=arguments, prog_name="microros-gen", standalone_mode=False)
    except UserError as error:
        if error.__cause__ is not None and os.environ.get(TRACEBACK):
            traceback.print_exception(error.__cause__)
        echo_found("".join(f"{diagnostic.render()}\n" for diagnostic in error.diagnostics))
        return error.status
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except (click.Abort, KeyboardInterrupt):
        click.echo("microros-gen: interrupted", err=True)
        return 130
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        click.echo(f"microros-gen: error: {place}{error.strerror or error}", err=True)
        return 1
    except Exception as error:
        if os.environ.get(TRACEBACK):
            raise
        echo_found(f"{internal_error(error).render()}\n")
        return 2
    return result if isinstance(result, int) else 0
