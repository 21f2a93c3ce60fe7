/* SPDX-License-Identifier: Apache-2.0 */
/* What the library asks of a board, with functions that every core of Arduino has; and the number of the board. */
#include <Arduino.h>

#include "microros/port.h"

#if defined(ARDUINO_ARCH_ESP32)
#include <sys/time.h>
#endif

namespace
{

const uint32_t most_ms = 4000000; /* micros() starts again after 4,294,967 ms */

#if defined(MICRO_ROS_CLIENT_KEY)
uint32_t number()
{
  return MICRO_ROS_CLIENT_KEY;
}
#elif defined(ARDUINO_ARCH_ESP32)
uint32_t number()
{
  const uint64_t address = ESP.getEfuseMac();

  return static_cast<uint32_t>(address ^ (address >> 32));
}
#elif defined(ARDUINO_ARCH_ESP8266)
uint32_t number()
{
  return ESP.getChipId();
}
#elif defined(ARDUINO_ARCH_STM32)
uint32_t number()
{
  return HAL_GetUIDw0() ^ (HAL_GetUIDw1() * 2654435761u) ^ (HAL_GetUIDw2() * 2246822519u);
}
#elif defined(__IMXRT1062__)                    /* Teensy 4 */
uint32_t number()
{
  return HW_OCOTP_CFG0 ^ (HW_OCOTP_CFG1 * 2654435761u);
}
#elif defined(TEENSYDUINO) && defined(SIM_UIDL) /* Teensy 3 */
uint32_t number()
{
  return SIM_UIDL ^ (SIM_UIDML * 2654435761u);
}
#elif defined(ARDUINO_ARCH_SAMD) && defined(__SAMD21__)
/* SAM D21 data sheet, "Serial Number" */
uint32_t number()
{
  return *reinterpret_cast<const volatile uint32_t *>(0x0080A00C) ^
         (*reinterpret_cast<const volatile uint32_t *>(0x0080A040) * 2654435761u) ^
         (*reinterpret_cast<const volatile uint32_t *>(0x0080A044) * 2246822519u) ^
         (*reinterpret_cast<const volatile uint32_t *>(0x0080A048) * 3266489917u);
}
#else
#error \
  "micro_ros_platformio: give each board a number in platformio.ini: build_flags = -DMICRO_ROS_CLIENT_KEY=1"
#endif

} // namespace

extern "C" uint32_t port_time_ms(void)
{
  return static_cast<uint32_t>(millis());
}

/* micros(), continued where it starts again; milliseconds alone if an hour passes between two calls. */
extern "C" int64_t port_time_steady_ns(void)
{
  static uint32_t last_us;
  static uint32_t last_ms;
  static int64_t total_us;
  const uint32_t now_us = static_cast<uint32_t>(micros());
  const uint32_t now_ms = static_cast<uint32_t>(millis());
  const uint32_t passed_ms = now_ms - last_ms;

  total_us +=
    passed_ms > most_ms ? static_cast<int64_t>(passed_ms) * 1000 : static_cast<int64_t>(now_us - last_us);
  last_us = now_us;
  last_ms = now_ms;
  return total_us * 1000;
}

/* 0: the board does not know the time of day. `+time_sync` asks the agent (rmw_uros_epoch_nanos). */
extern "C" int64_t port_time_epoch_ns(void)
{
#if defined(ARDUINO_ARCH_ESP32)
  struct timeval now;

  if (gettimeofday(&now, nullptr) == 0 && now.tv_sec >= 946684800) { /* 2000: SNTP has set it */
    return static_cast<int64_t>(now.tv_sec) * 1000000000 + static_cast<int64_t>(now.tv_usec) * 1000;
  }
#endif
  return 0;
}

extern "C" void port_sleep_ms(uint32_t duration_ms)
{
  delay(duration_ms);
}

/* The library waits in the transport's read function. */
extern "C" void port_wake(void)
{
}

extern "C" uint32_t port_unique_id(void)
{
  const uint32_t id = number();

  return id == 0u ? 1u : id;
}
