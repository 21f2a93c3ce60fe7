# SPDX-License-Identifier: Apache-2.0
"""Profiles, components and axes → what is selected, and why."""
