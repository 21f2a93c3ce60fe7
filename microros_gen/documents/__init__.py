# SPDX-License-Identifier: Apache-2.0
"""Texts that users write and read: files with limits, YAML with positions, JSON Schema, templates."""
