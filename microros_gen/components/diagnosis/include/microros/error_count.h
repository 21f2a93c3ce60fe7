/* SPDX-License-Identifier: Apache-2.0 */
/* Counts the errors that rcl_get_error_string returns the last one of. Internal. */
#ifndef MICROROS_ERROR_COUNT_H
#define MICROROS_ERROR_COUNT_H

#ifdef __cplusplus
extern "C" {
#endif

/* Called under the lock for each error that is set. */
void microros_error_count(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_ERROR_COUNT_H */
