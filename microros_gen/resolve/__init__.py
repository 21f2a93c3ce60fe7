# SPDX-License-Identifier: Apache-2.0
"""Resolves names: interfaces to their closure; profiles, axes and components to a selection, with reasons."""
