# SPDX-License-Identifier: Apache-2.0
"""Prepared views of the type support's plan, and the C files that they render to."""
