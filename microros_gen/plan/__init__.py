# SPDX-License-Identifier: Apache-2.0
"""Decides everything before anything is written: capacities, sizes, ids, names, streams, pools."""
