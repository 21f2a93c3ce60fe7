# SPDX-License-Identifier: Apache-2.0
"""Compile, archive and link; object stamps; the emulator of a target."""
