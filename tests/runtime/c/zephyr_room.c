/* SPDX-License-Identifier: Apache-2.0 */
/* What a wait looks for while a connection has room or not, with sockets that only note it. */
#include "unit.h"

#include <microros/port.h>

#include <errno.h>
#include <zephyr/net/socket.h>
#include <zephyr/zvfs/eventfd.h>

enum { AGENT = 1, HANDLE = 5, OTHER = 6 };

static int events;     /* that the last wait looked for at the connection */
static ssize_t taken;  /* by the next send */
static int refusal;    /* errno of a send that takes nothing */
static int wait_ms;    /* of the last wait */
static unsigned locks; /* that were taken and not released */

void port_lock(void)
{
  ++locks;
}

void port_unlock(void)
{
  --locks;
}

int k_mutex_lock(struct k_mutex * mutex, k_timeout_t timeout)
{
  (void)mutex, (void)timeout;
  return 0;
}

int k_mutex_unlock(struct k_mutex * mutex)
{
  (void)mutex;
  return 0;
}

k_timeout_t kernel_timeout(int64_t ticks)
{
  const k_timeout_t timeout = {ticks};

  return timeout;
}

bool k_is_in_isr(void)
{
  return false;
}

int k_work_submit(struct k_work * work)
{
  (void)work;
  return 0;
}

int zvfs_eventfd(unsigned int initial, int flags)
{
  (void)initial, (void)flags;
  return 3;
}

int zvfs_eventfd_read(int descriptor, zvfs_eventfd_t * value)
{
  (void)descriptor, (void)value;
  return -1;
}

int zvfs_eventfd_write(int descriptor, zvfs_eventfd_t value)
{
  (void)descriptor, (void)value;
  return 0;
}

int port_zephyr_socket_connect(const char * host, uint16_t port, int kind, uint16_t local)
{
  (void)host, (void)port, (void)kind, (void)local;
  return HANDLE;
}

int zsock_setsockopt(int sock, int level, int name, const void * value, socklen_t size)
{
  (void)sock, (void)level, (void)name, (void)value, (void)size;
  return 0;
}

int zsock_getsockopt(int sock, int level, int name, void * value, socklen_t * size)
{
  (void)sock, (void)level, (void)name, (void)value, (void)size;
  return -1;
}

int zsock_close(int sock)
{
  (void)sock;
  return 0;
}

ssize_t zsock_recv(int sock, void * bytes, size_t size, int flags)
{
  (void)sock, (void)bytes, (void)size, (void)flags;
  return -1;
}

ssize_t zsock_send(int sock, const void * bytes, size_t size, int flags)
{
  (void)sock, (void)bytes, (void)size, (void)flags;
  errno = refusal;
  return taken;
}

int zsock_poll(struct zsock_pollfd * descriptors, int count, int timeout)
{
  CHECK(count > AGENT && locks == 0u);
  wait_ms = timeout;
  events = descriptors[AGENT].events;
  return 0;
}

static int waited(intptr_t handle)
{
  port_wait(handle, 1000);
  return events;
}

static int sent(port_tcp_t * tcp, ssize_t count)
{
  const uint8_t bytes[4] = {0};

  taken = count;
  CHECK(port_tcp_send(tcp, bytes, sizeof(bytes)) == (count < 0 ? 0 : (int32_t)count));
  return waited(tcp->handle);
}

int main(void)
{
  port_tcp_t tcp;

  refusal = EAGAIN;
  CHECK(port_tcp_open(&tcp, "192.168.1.2", 8888));
  CHECK(waited(tcp.handle) == ZSOCK_POLLIN);
  CHECK(sent(&tcp, -1) == (ZSOCK_POLLIN | ZSOCK_POLLOUT)); /* nothing was taken */
  CHECK(waited(OTHER) == ZSOCK_POLLIN);                    /* another connection */
  CHECK(waited(-1) == ZSOCK_POLLIN);
  CHECK(sent(&tcp, 3) == (ZSOCK_POLLIN | ZSOCK_POLLOUT)); /* a part was taken */
  CHECK(sent(&tcp, 4) == ZSOCK_POLLIN);                   /* everything */
  CHECK(sent(&tcp, -1) == (ZSOCK_POLLIN | ZSOCK_POLLOUT));
  port_tcp_close(&tcp);
  CHECK(waited(HANDLE) == ZSOCK_POLLIN); /* the next connection has the same descriptor */
  CHECK(wait_ms == 1000);
  refusal =
    ENOBUFS; /* the connection counts as ready to send: without a wait the task would keep the processor */
  CHECK(port_tcp_open(&tcp, "192.168.1.2", 8888) && sent(&tcp, -1) == ZSOCK_POLLIN && wait_ms == 1);
  refusal = EAGAIN;
  CHECK(sent(&tcp, -1) == (ZSOCK_POLLIN | ZSOCK_POLLOUT) && wait_ms == 1000);
  return 0;
}
