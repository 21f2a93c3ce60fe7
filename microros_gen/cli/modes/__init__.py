# SPDX-License-Identifier: Apache-2.0
"""`microros-gen modes`."""

from microros_gen.cli.modes.command import command

__all__ = ["command"]
