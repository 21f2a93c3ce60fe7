# SPDX-License-Identifier: Apache-2.0
"""Decide entities, streams, queues, names and times of the client."""
