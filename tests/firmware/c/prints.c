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
  for (;;) {
    rclc_sleep_ms(100);
  }
}
