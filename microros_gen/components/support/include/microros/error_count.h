/* SPDX-License-Identifier: Apache-2.0 */
/* Who counts errors: nobody, unless a component replaces this header. Internal. */
#ifndef MICROROS_ERROR_COUNT_H
#define MICROROS_ERROR_COUNT_H

/* Called under the lock for each error that is set. */
static inline void microros_error_count(void)
{
}

#endif /* MICROROS_ERROR_COUNT_H */
