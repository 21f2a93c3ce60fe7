# SPDX-License-Identifier: Apache-2.0
"""Prepared views of the client's plan, and the files that they render to."""
