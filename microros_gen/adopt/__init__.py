# SPDX-License-Identifier: Apache-2.0
"""What people already have, and what they begin with → a proposed application file (`model/draft.py`)."""
