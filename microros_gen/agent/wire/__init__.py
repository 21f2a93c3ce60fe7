# SPDX-License-Identifier: Apache-2.0
"""DDS-XRCE on the wire (OMG formal/2020-02-01, clause 8): messages, submessages, CDR; without state."""
