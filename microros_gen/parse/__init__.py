# SPDX-License-Identifier: Apache-2.0
"""Turns text into the model: .msg files, YAML with positions, JSON Schemas."""
