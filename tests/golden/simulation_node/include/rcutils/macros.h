/* SPDX-License-Identifier: Apache-2.0 */
/* Small macros of rcutils. */
#ifndef MICROROS_RCUTILS_MACROS_H
#define MICROROS_RCUTILS_MACROS_H

#define RCUTILS_WARN_UNUSED
#define RCUTILS_EXPAND(x) x
#define RCUTILS_STRINGIFY_IMPL(x) #x
#define RCUTILS_STRINGIFY(x) RCUTILS_STRINGIFY_IMPL(x)
#define RCUTILS_UNUSED(x) (void)(x)
#define RCUTILS_JOIN_IMPL(arg1, arg2) arg1##arg2
#define RCUTILS_JOIN(arg1, arg2) RCUTILS_JOIN_IMPL(arg1, arg2)
#define RCUTILS_LIKELY(x) (x)
#define RCUTILS_UNLIKELY(x) (x)

#endif /* MICROROS_RCUTILS_MACROS_H */
