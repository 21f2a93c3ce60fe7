# SPDX-License-Identifier: Apache-2.0
"""Files that configure the agent: its configuration file and the entities of preconfigured clients."""
