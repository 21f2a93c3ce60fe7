# SPDX-License-Identifier: Apache-2.0
"""Recordings of XRCE messages in pcapng files."""
