/* SPDX-License-Identifier: Apache-2.0 */
/* A static library exports everything: these are empty, and exist for sources that write them. */
#ifndef MICROROS_RMW_VISIBILITY_CONTROL_H
#define MICROROS_RMW_VISIBILITY_CONTROL_H

#define RMW_PUBLIC
#define RMW_PUBLIC_TYPE
#define RMW_LOCAL

#endif /* MICROROS_RMW_VISIBILITY_CONTROL_H */
