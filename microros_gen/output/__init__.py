# SPDX-License-Identifier: Apache-2.0
"""Writes what was rendered: atomically, only what changed, the manifest last. Compares golden copies."""
