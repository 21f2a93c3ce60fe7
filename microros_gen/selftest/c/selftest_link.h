/* SPDX-License-Identifier: Apache-2.0 */
/* What the checks of links have in common: after a link is up again, its transport works again. */
#ifndef SELFTEST_LINK_H
#define SELFTEST_LINK_H

#include <stdbool.h>

/* Whether it opened, and whether something came back over it. */
typedef struct selftest_link_t {
  bool opens;
  bool is_answered;
} selftest_link_t;

/* Opens and asks, for 2 s at most, until both succeed: the first of them may have gone with the link. Once is enough where
 * nobody answered before (`was_answered`). */
selftest_link_t selftest_link_again(bool (*open)(void), bool (*is_answered)(void), bool was_answered);

#endif /* SELFTEST_LINK_H */
