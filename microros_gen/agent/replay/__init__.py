# SPDX-License-Identifier: Apache-2.0
"""Replay of recordings: one side of each conversation is played, and answers are compared."""
