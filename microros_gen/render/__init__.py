# SPDX-License-Identifier: Apache-2.0
"""Turns the plan into the bytes of every file: templates print prepared views."""
