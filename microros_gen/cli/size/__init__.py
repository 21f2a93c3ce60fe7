# SPDX-License-Identifier: Apache-2.0
"""`microros-gen size`."""

from microros_gen.cli.size.command import command

__all__ = ["command"]
