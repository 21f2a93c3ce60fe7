/* SPDX-License-Identifier: Apache-2.0 */
/* A static library exports everything: these are empty, for sources that use them. */
#ifndef MICROROS_RCLC_VISIBILITY_CONTROL_H
#define MICROROS_RCLC_VISIBILITY_CONTROL_H

#define RCLC_PUBLIC
#define RCLC_LOCAL

#endif /* MICROROS_RCLC_VISIBILITY_CONTROL_H */
