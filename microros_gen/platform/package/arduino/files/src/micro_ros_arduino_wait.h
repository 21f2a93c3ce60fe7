/* SPDX-License-Identifier: Apache-2.0 */
/* Waiting of the transports. Not for sketches. */
#ifndef MICRO_ROS_ARDUINO_WAIT_H
#define MICRO_ROS_ARDUINO_WAIT_H

#include <Arduino.h>

#include <microros/port_arduino.h>

/* Returns whether to look again: the time is not up, and nobody ended the wait. Meanwhile other tasks run, also those of
 * the lowest priority, which yield() would not let run (the idle task of FreeRTOS feeds a watchdog). */
static inline bool arduino_wait(uint32_t start_ms, int timeout_ms)
{
  if (timeout_ms <= 0 || (uint32_t)millis() - start_ms >= (uint32_t)timeout_ms || port_arduino_woken()) {
    return false;
  }
  delay(1);
  return true;
}

#endif /* MICRO_ROS_ARDUINO_WAIT_H */
