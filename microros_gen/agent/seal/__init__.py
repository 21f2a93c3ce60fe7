# SPDX-License-Identifier: Apache-2.0
"""Sealed messages: Noise sessions with clients that share a key with the agent (docs/howto/seal.md)."""
