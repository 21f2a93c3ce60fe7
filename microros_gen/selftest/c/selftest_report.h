/* SPDX-License-Identifier: Apache-2.0 */
/* Results of checks: each call prints a line and counts. `name` has no spaces. Called by one task only. */
#ifndef SELFTEST_REPORT_H
#define SELFTEST_REPORT_H

#include <stdbool.h>
#include <stdint.h>

/* PASS if `seen` is that; `unit` follows the number of a FAIL. */
void selftest_equal(const char * name, int64_t seen, int64_t expected, const char * unit);
void selftest_at_least(const char * name, int64_t seen, int64_t least, const char * unit);
void selftest_at_most(const char * name, int64_t seen, int64_t most, const char * unit);

/* PASS if `is_right`; else FAIL with what was seen and expected, in words. */
void selftest_true(const char * name, bool is_right, const char * seen, const char * expected);

void selftest_skip(const char * name, const char * why);

/* Prints the last line; returns how many failed. */
uint32_t selftest_end(void);

/* Returns the shortest of some calls, milliseconds: what another task or an interrupt took does not count. */
uint32_t selftest_shortest_ms(void (*call)(void));

#endif /* SELFTEST_REPORT_H */
