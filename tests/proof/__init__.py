# SPDX-License-Identifier: Apache-2.0
"""Frama-C's proofs of the C code, and that they can fail."""
