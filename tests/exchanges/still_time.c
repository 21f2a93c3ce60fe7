/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Loaded before the C library of a POSIX image (LD_PRELOAD), it takes over the clock and the transport: time passes
 * only while the program waits, and every byte goes to a peer over the descriptor EXCHANGE_FD. So the same program
 * gives the same exchange. It serves programs with one thread.
 *
 * To the peer: "S <ms> <hex>" (sent), "T <from ms> <to ms>" (waits). The peer answers each with lines "R <ms> <hex>"
 * (data for the program, and when), then "." The program ends when EXCHANGE_MS have passed.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

enum { CHUNKS = 256, CHUNK = 2048, MOST_QUESTIONS = 1000000 };

typedef struct chunk_t {
  size_t size;
  uint8_t bytes[CHUNK];
} chunk_t;

static const int64_t start_ms = 1000000; /* a clock that has run for a while */
static int64_t now_ms;
static int64_t end_ms;
static unsigned questions; /* of the clock, since time has passed */
static FILE * peer;
static FILE * from_peer;
static int transport = -1;
static bool is_stream; /* a byte stream: chunks run together */
static chunk_t chunks[CHUNKS];
static size_t first_chunk;
static size_t waiting_chunks;

static void fail(const char * what)
{
  (void)fprintf(stderr, "still_time: %s\n", what);
  _exit(3);
}

static void begin(void)
{
  const char * descriptor = getenv("EXCHANGE_FD");
  const char * duration = getenv("EXCHANGE_MS");

  if (peer == NULL) {
    if (descriptor == NULL || duration == NULL) {
      fail("EXCHANGE_FD and EXCHANGE_MS are missing");
    }
    peer = fdopen(atoi(descriptor), "w");
    from_peer = fdopen(dup(atoi(descriptor)), "r");
    end_ms = atoll(duration);
    if (peer == NULL || from_peer == NULL) {
      fail("EXCHANGE_FD is not open");
    }
  }
}

static void take(const char * hex)
{
  chunk_t * chunk = &chunks[(first_chunk + waiting_chunks) % CHUNKS];

  if (waiting_chunks == CHUNKS) {
    fail("the program does not read");
  }
  chunk->size = 0;
  for (; hex[0] > ' ' && hex[1] > ' ' && chunk->size < CHUNK; hex += 2) {
    const char digits[3] = {hex[0], hex[1], '\0'};

    chunk->bytes[chunk->size++] = (uint8_t)strtoul(digits, NULL, 16);
  }
  ++waiting_chunks;
}

/* Returns when something came (ms), or `none` where nothing did. */
static int64_t answers(int64_t none)
{
  static char line[3 * CHUNK];
  int64_t came = none;

  (void)fflush(peer);
  while (fgets(line, sizeof(line), from_peer) != NULL && line[0] == 'R') {
    char * rest = NULL;

    came = strtoll(&line[2], &rest, 10);
    take(&rest[1]);
  }
  if (line[0] != '.') {
    _exit(0); /* the peer has seen enough */
  }
  return came;
}

static void pass(int64_t duration_ms, bool ends_with_data)
{
  const int64_t target = now_ms + duration_ms;

  begin();
  questions = 0;
  if (ends_with_data && waiting_chunks != 0u) {
    return;
  }
  do {
    (void)fprintf(peer, "T %lld %lld\n", (long long)now_ms, (long long)target);
    now_ms = answers(target);
  } while (now_ms < target && !ends_with_data);
  if (now_ms >= end_ms) {
    _exit(0);
  }
}

static void hand_over(const uint8_t * data, size_t size)
{
  begin();
  (void)fprintf(peer, "S %lld ", (long long)now_ms);
  for (size_t i = 0; i < size; ++i) {
    (void)fprintf(peer, "%02x", data[i]);
  }
  (void)fputc('\n', peer);
  (void)answers(now_ms);
}

static ssize_t receive(uint8_t * buffer, size_t capacity, bool * cut)
{
  chunk_t * chunk = &chunks[first_chunk];
  size_t size;

  if (waiting_chunks == 0u) {
    errno = EAGAIN;
    return -1;
  }
  size = chunk->size < capacity ? chunk->size : capacity;
  (void)memcpy(buffer, chunk->bytes, size);
  if (is_stream && size < chunk->size) {
    chunk->size -= size;
    (void)memmove(chunk->bytes, &chunk->bytes[size], chunk->size);
    return (ssize_t)size;
  }
  if (cut != NULL) {
    *cut = size < chunk->size;
  }
  first_chunk = (first_chunk + 1u) % CHUNKS;
  --waiting_chunks;
  return (ssize_t)size;
}

static int open_transport(bool stream)
{
  waiting_chunks = 0;
  is_stream = stream;
  transport = memfd_create("transport", 0);
  return transport;
}

static void * real(const char * name)
{
  void * function = dlsym(RTLD_NEXT, name);

  if (function == NULL) {
    fail(name);
  }
  return function;
}

int clock_gettime(clockid_t clock, struct timespec * now)
{
  const int64_t total = now_ms + (clock == CLOCK_REALTIME ? 1000 * start_ms : start_ms);

  if (++questions > MOST_QUESTIONS) {
    fail("the program asks for the time and never waits");
  }
  now->tv_sec = (time_t)(total / 1000);
  now->tv_nsec = (long)(total % 1000) * 1000000L;
  return 0;
}

int nanosleep(const struct timespec * duration, struct timespec * left)
{
  (void)left;
  pass((int64_t)duration->tv_sec * 1000 + (duration->tv_nsec + 999999) / 1000000, false);
  return 0;
}

int poll(struct pollfd * ends, nfds_t count, int timeout_ms)
{
  int ready = 0;

  pass(timeout_ms < 0 ? end_ms : timeout_ms, true);
  for (nfds_t i = 0; i < count; ++i) {
    const bool has_data = ends[i].fd >= 0 && ends[i].fd == transport && waiting_chunks != 0u;

    ends[i].revents = has_data ? POLLIN : 0;
    ready += has_data ? 1 : 0;
  }
  return ready;
}

int socket(int domain, int kind, int protocol)
{
  (void)domain;
  (void)protocol;
  return open_transport((kind & 0xF) == SOCK_STREAM);
}

int open(const char * path, int flags, ...)
{
  const uint8_t id[] = {1, 2, 3, 4};
  mode_t mode = 0;

  if ((flags & O_CREAT) != 0) {
    va_list arguments;

    va_start(arguments, flags);
    mode = va_arg(arguments, mode_t);
    va_end(arguments);
  }
  if (strncmp(path, "/dev/tty", 8) == 0) {
    return open_transport(true);
  }
  if (strcmp(path, "/dev/urandom") == 0) {
    const int handle = memfd_create("id", 0);

    (void)((ssize_t(*)(int, const void *, size_t))real("write"))(handle, id, sizeof(id));
    (void)lseek(handle, 0, SEEK_SET);
    return handle;
  }
  return ((int (*)(const char *, int, mode_t))real("open"))(path, flags, mode);
}

int connect(int handle, const struct sockaddr * address, socklen_t size)
{
  (void)handle;
  (void)address;
  (void)size;
  return 0;
}

int bind(int handle, const struct sockaddr * address, socklen_t size)
{
  return connect(handle, address, size);
}

int setsockopt(int handle, int level, int option, const void * value, socklen_t size)
{
  (void)handle;
  (void)level;
  (void)option;
  (void)value;
  (void)size;
  return 0;
}

int tcgetattr(int handle, struct termios * settings)
{
  (void)handle;
  (void)memset(settings, 0, sizeof(*settings));
  return 0;
}

int tcsetattr(int handle, int when, const struct termios * settings)
{
  (void)handle;
  (void)when;
  (void)settings;
  return 0;
}

ssize_t send(int handle, const void * data, size_t size, int flags)
{
  (void)handle;
  (void)flags;
  hand_over(data, size);
  return (ssize_t)size;
}

ssize_t sendto(
  int handle, const void * data, size_t size, int flags, const struct sockaddr * address, socklen_t length)
{
  (void)address;
  (void)length;
  return send(handle, data, size, flags);
}

ssize_t write(int handle, const void * data, size_t size)
{
  if (handle >= 0 && handle == transport) {
    return send(handle, data, size, 0);
  }
  return ((ssize_t(*)(int, const void *, size_t))real("write"))(handle, data, size);
}

ssize_t recv(int handle, void * buffer, size_t capacity, int flags)
{
  (void)handle;
  (void)flags;
  return receive(buffer, capacity, NULL);
}

ssize_t recvfrom(
  int handle, void * buffer, size_t capacity, int flags, struct sockaddr * address, socklen_t * length)
{
  const struct sockaddr_in from = {.sin_family = AF_INET, .sin_addr = {htonl(INADDR_LOOPBACK)}};

  if (address != NULL && *length >= sizeof(from)) {
    (void)memcpy(address, &from, sizeof(from));
  }
  return recv(handle, buffer, capacity, flags);
}

ssize_t recvmsg(int handle, struct msghdr * message, int flags)
{
  bool cut = false;
  const ssize_t size = receive(message->msg_iov[0].iov_base, message->msg_iov[0].iov_len, &cut);

  (void)handle;
  (void)flags;
  message->msg_flags = cut ? MSG_TRUNC : 0;
  return size;
}

ssize_t read(int handle, void * buffer, size_t capacity)
{
  if (handle >= 0 && handle == transport) {
    return receive(buffer, capacity, NULL);
  }
  return ((ssize_t(*)(int, void *, size_t))real("read"))(handle, buffer, capacity);
}
