/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_PROTOCOL_EXAMPLES_COMMON_H
#define STAND_IN_PROTOCOL_EXAMPLES_COMMON_H

int example_connect(void);

#endif /* STAND_IN_PROTOCOL_EXAMPLES_COMMON_H */
