/* SPDX-License-Identifier: Apache-2.0 */
/* board_microros_transport = custom: the application passes its functions to rmw_uros_set_custom_transport. */
