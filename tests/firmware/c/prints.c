/* SPDX-License-Identifier: Apache-2.0 */
/* Prints with the C library's own functions, from a program that also has a session's library below it. */
#include <rclc/rclc.h>

#include <stdio.h>

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  (void)printf("%s %d %x", "number", 42, 255u);
  (void)puts(" and text");
  (void)fprintf(stderr, "allocator %s\n", rcutils_allocator_is_valid(&allocator) ? "there" : "lost");
  for (unsigned i = 0; i < 3u; ++i) {
    (void)printf("line %u\n", i);
  }
#ifdef PRINTS_FLOATS
  static const double numbers[] = {-3.140625, 1.0e-300, 1.0e15, 2.25e-308};

  for (unsigned i = 0; i < sizeof(numbers) / sizeof(numbers[0]); ++i) {
    (void)printf("%.3f %e\n", numbers[i], numbers[i]);
  }
#endif
  for (;;) {
    rclc_sleep_ms(100);
  }
}
