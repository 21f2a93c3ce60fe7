# SPDX-License-Identifier: Apache-2.0
"""`microros-gen agent`."""

from microros_gen.cli.agent.command import command

__all__ = ["command"]
