# SPDX-License-Identifier: Apache-2.0
"""`microros-gen doctor`: what is missing on this machine for each way to build and run."""

from microros_gen.cli.doctor.command import command

__all__ = ["command"]
