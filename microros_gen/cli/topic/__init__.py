# SPDX-License-Identifier: Apache-2.0
"""`microros-gen topic`."""

from microros_gen.cli.topic.command import command

__all__ = ["command"]
