/* SPDX-License-Identifier: Apache-2.0 */
/* The groups time and UDP of microros/port.h over ESP-IDF: FreeRTOS, esp_timer and lwIP. */
#include <microros/port.h>

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include <esp_timer.h>
#include <freertos/FreeRTOS.h>
#include <freertos/task.h>
#include <lwip/inet.h>
#include <lwip/sockets.h>

enum { US_PER_MS = 1000 };

uint32_t port_time_ms(void)
{
  return (uint32_t)((uint64_t)esp_timer_get_time() / US_PER_MS);
}

/* One tick more, since the one that is under way counts for nothing. */
void port_sleep_ms(uint32_t duration_ms)
{
  vTaskDelay(duration_ms == 0u ? 0u : pdMS_TO_TICKS(duration_ms) + 1u);
}

static bool udp_connect(int handle, const char * host, uint16_t port)
{
  struct sockaddr_in agent;

  (void)memset(&agent, 0, sizeof(agent));
  agent.sin_family = AF_INET;
  agent.sin_port = htons(port);
  return inet_pton(AF_INET, host, &agent.sin_addr) == 1 && fcntl(handle, F_SETFL, O_NONBLOCK) == 0 &&
         connect(handle, (const struct sockaddr *)&agent, sizeof(agent)) == 0;
}

bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port)
{
  const int handle = socket(AF_INET, SOCK_DGRAM, 0);

  if (handle >= 0 && !udp_connect(handle, host, port)) {
    (void)close(handle);
    return false;
  }
  udp->handle = handle;
  return handle >= 0;
}

void port_udp_close(port_udp_t * udp)
{
  (void)close((int)udp->handle);
}

bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size)
{
  return send((int)udp->handle, data, size, 0) == (ssize_t)size;
}

int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity)
{
  struct iovec part = {buffer, capacity};
  struct msghdr message;
  ssize_t size;

  (void)memset(&message, 0, sizeof(message));
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  size = recvmsg((int)udp->handle, &message, 0);
  if (size < 0) {
    return 0; /* nothing there */
  }
  return (message.msg_flags & MSG_TRUNC) != 0 ? -1 : (int32_t)size;
}
