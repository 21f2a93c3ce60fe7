# SPDX-License-Identifier: Apache-2.0
"""Measure and explain an image: ELF, DWARF, linker map, stack bounds, budgets."""
