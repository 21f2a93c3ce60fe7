# SPDX-License-Identifier: Apache-2.0
"""Tasks of fixed priority on one processor: their priorities, and whether each meets its deadline."""
