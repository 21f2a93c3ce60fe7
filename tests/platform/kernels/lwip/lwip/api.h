/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_LWIP_API_H
#define STAND_IN_LWIP_API_H

#include "lwip/opt.h"

#include <stddef.h>
#include <stdint.h>

typedef uint8_t u8_t;
typedef uint16_t u16_t;
typedef uint32_t u32_t;
typedef int8_t err_t;

typedef struct ip4_addr {
  u32_t addr;
} ip4_addr_t;

typedef struct ip_addr {
  ip4_addr_t v4;
  u8_t type;
} ip_addr_t;

struct pbuf {
  u16_t tot_len;
};

struct tcp_pcb;

struct netconn {
  union {
    struct tcp_pcb * tcp;
  } pcb;
  u8_t flags;
};

struct netbuf {
  struct pbuf * p;
  ip_addr_t addr;
};

enum {
  ERR_OK = 0,
  ERR_MEM = -1,
  ERR_INPROGRESS = -5,
  ERR_WOULDBLOCK = -7,
  ERR_ALREADY = -9
};

enum netconn_type {
  NETCONN_TCP = 0x10,
  NETCONN_UDP = 0x20
};
#define NETCONN_TYPE_IPV6 0x08

enum netconn_evt {
  NETCONN_EVT_RCVPLUS,
  NETCONN_EVT_RCVMINUS,
  NETCONN_EVT_SENDPLUS,
  NETCONN_EVT_SENDMINUS,
  NETCONN_EVT_ERROR
};
#define NETCONN_COPY 0x01
#define NETCONN_FLAG_IN_NONBLOCKING_CONNECT 0x04

typedef void (*netconn_callback)(struct netconn * connection, enum netconn_evt event, u16_t size);

extern const ip_addr_t ip_addr_any;

#define IP4_ADDR_ANY (&ip_addr_any)
#define IP_IS_V6(address) ((address)->type != 0u)
#define ip_2_ip4(address) (&(address)->v4)
#define ip4_addr_get_u32(address) ((address)->addr)
#define netbuf_len(buffer) ((buffer)->p->tot_len)
#define netbuf_fromaddr(buffer) (&(buffer)->addr)
#define netbuf_copy(buffer, bytes, size) pbuf_copy_partial((buffer)->p, bytes, size, 0)
#define netconn_set_nonblocking(connection, is_set) ((connection)->flags = (u8_t)(is_set))
#define netconn_is_flag_set(connection, flag) (((connection)->flags & (flag)) != 0)
#define netconn_addr(connection, address, port) netconn_getaddr(connection, address, port, 1)

int ipaddr_aton(const char * text, ip_addr_t * address);
struct netconn * netconn_new_with_callback(enum netconn_type type, netconn_callback callback);
err_t netconn_delete(struct netconn * connection);
err_t netconn_bind(struct netconn * connection, const ip_addr_t * address, u16_t port);
err_t netconn_connect(struct netconn * connection, const ip_addr_t * address, u16_t port);
err_t netconn_getaddr(struct netconn * connection, ip_addr_t * address, u16_t * port, u8_t is_local);
err_t netconn_recv(struct netconn * connection, struct netbuf ** buffer);
err_t netconn_recv_tcp_pbuf(struct netconn * connection, struct pbuf ** buffer);
err_t netconn_send(struct netconn * connection, struct netbuf * buffer);
err_t netconn_sendto(struct netconn * connection, struct netbuf * buffer, const ip_addr_t * address, u16_t port);
err_t netconn_write_partly(
  struct netconn * connection, const void * bytes, size_t size, u8_t flags, size_t * written);
struct netbuf * netbuf_new(void);
void netbuf_delete(struct netbuf * buffer);
void * netbuf_alloc(struct netbuf * buffer, u16_t size);
err_t netbuf_ref(struct netbuf * buffer, const void * bytes, u16_t size);
u8_t pbuf_free(struct pbuf * buffer);
u16_t pbuf_copy_partial(const struct pbuf * buffer, void * bytes, u16_t size, u16_t offset);

#endif /* STAND_IN_LWIP_API_H */
