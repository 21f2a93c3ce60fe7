# SPDX-License-Identifier: Apache-2.0
"""Targets: what the C compiler is told, and which ports the library uses."""
