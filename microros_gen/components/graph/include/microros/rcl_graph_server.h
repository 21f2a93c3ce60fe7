/* SPDX-License-Identifier: Apache-2.0 */
/* Exchange with the graph server. Internal. */
#ifndef MICROROS_RCL_GRAPH_SERVER_H
#define MICROROS_RCL_GRAPH_SERVER_H

#include "microros/rcl_graph.h"
#include "microros_graph_msgs/msg/name.h"
#include "microros_graph_msgs/srv/list_endpoints.h"
#include "microros_graph_msgs/srv/list_names.h"
#include "rcl/client.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Clients of the server's services; invalid while their node is closed. Another task may close it at any time: read them with
 * rcl_graph_source_client. */
extern rcl_client_t rcl_graph_names_client;
extern rcl_client_t rcl_graph_endpoints_client;

/* Returns a client as it is now. What it refers to stays when its node is closed; its calls then fail. */
rcl_client_t rcl_graph_source_client(const rcl_client_t * client);

/* --- rcl_graph_ask.c --- */

/* Names and types of the response that is read; one query is made at a time. */
extern char rcl_graph_texts[MICROROS_GRAPH_TEXTS][MICROROS_GRAPH_NAME_SIZE];

/* What an exchange does before it reads a response into memory. */
typedef void (*rcl_graph_bind_t)(void * response);

/*
 * Sends a request, once more if it gets no answer in half of the time, and waits for the response, not longer than
 * `limit`; NULL: no limit. RCL_RET_TIMEOUT or RCL_RET_ERROR, with a text. */
rcl_ret_t rcl_graph_ask(
  const rcl_client_t * client, const void * request, void * response, rcl_graph_bind_t bind,
  const rcl_waiting_t * limit);

/* Returns the code for a `status` of a response, with a text about `kind` and `name`. */
rcl_ret_t rcl_graph_status(uint8_t status, const char * kind, const char * name);

/* Sets `string` to a text of others, which is only read; NULL: to an empty one. */
void rcl_graph_lend(rosidl_runtime_c__String * string, char * text);

/* Gives `string` the memory of text `index`. */
void rcl_graph_bind_text(rosidl_runtime_c__String * string, size_t index);

/* A page of a response, whatever its items are. */
typedef struct rcl_graph_page_t {
  uint32_t version;
  uint32_t total;
  uint32_t next;
  size_t size;
  bool truncated;
} rcl_graph_page_t;

/* How a list is read. `list` is the caller's. A function that returns an error has set a text. */
typedef struct rcl_graph_reader_t {
  /* The page from item `first` on; its version is that of the page before, 0 for the first one. */
  rcl_ret_t (*ask)(void * list, uint32_t first, rcl_graph_page_t * page);
  rcl_ret_t (*make)(void * list, size_t size);              /* makes room for that many items */
  rcl_ret_t (*put)(void * list, size_t item, size_t index); /* stores an item of the page as item `index` */
  void (*drop)(void * list);                                /* frees what `make` and `put` allocated */
} rcl_graph_reader_t;

/* Reads all pages, and begins again if the graph changes meanwhile. On an error the list is dropped. */
rcl_ret_t rcl_graph_read(const rcl_graph_reader_t * reader, void * list);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GRAPH_SERVER_H */
