# SPDX-License-Identifier: Apache-2.0
"""Decide sizes, encoding steps and storage of each message type."""
