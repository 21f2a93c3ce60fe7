# SPDX-License-Identifier: Apache-2.0
"""The parameter server of D1.4 (4.7.4, 4.7.11): holds the parameters of nodes whose boards come and go."""
