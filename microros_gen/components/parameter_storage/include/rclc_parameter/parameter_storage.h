/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Values of parameters that outlast a loss of power. They are stored in two slots of the port
 * (microros/port_storage.h), which are written in turn: a loss of power at any time leaves either the old values or
 * the new ones. Not part of rclc.
 *
 * Both functions run in the task of the server, and not in its callback. They use the buffer of its requests.
 */
#ifndef RCLC_PARAMETER_PARAMETER_STORAGE_H
#define RCLC_PARAMETER_PARAMETER_STORAGE_H

#include "rclc_parameter/rclc_parameter.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Sets the parameters of a server to the values that were saved last. Each is checked as in a set request: name,
 * type, range, and by the callback of the server, if it has one already. A parameter whose saved value fails a check
 * keeps its value; *skipped is the number of these (may be NULL). `set` distinguishes servers, from 0: a server uses
 * the slots 2 * set and 2 * set + 1.
 *
 * RCL_RET_OK also if nothing was ever saved. RCL_RET_ERROR with a text: the saved values are damaged or of another
 * version of the format; all parameters keep their values.
 *
 * If a parameter server elsewhere holds the values (parameters: {at: agent}), call this before
 * rclc_executor_add_parameter_server; later it returns RCL_RET_ERROR. The loaded values count as declared ones: values
 * that the server holds replace them.
 */
rcl_ret_t rclc_parameter_storage_load(
  rclc_parameter_server_t * parameter_server, uint32_t set, size_t * skipped);

/*
 * Saves the values of all parameters that are not read-only. Writes nothing if they equal the saved values. Waits
 * until the memory has erased and written a slot. Values of another version of the format survive the first save.
 *
 * RCL_RET_ERROR with a text: the memory refused, or its content differs from the written bytes. The previous values
 * are still saved.
 */
rcl_ret_t rclc_parameter_storage_save(rclc_parameter_server_t * parameter_server, uint32_t set);

#ifdef __cplusplus
}
#endif

#endif /* RCLC_PARAMETER_PARAMETER_STORAGE_H */
