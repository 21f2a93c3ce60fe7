/* SPDX-License-Identifier: Apache-2.0 */
/* The reader of ros_to_microros_graph: a topic in DDS whose samples are taken piece by piece. Internal. */
#ifndef MICROROS_RMW_GRAPH_READER_H
#define MICROROS_RMW_GRAPH_READER_H

#include <stdbool.h>

#include "microros/xrce_sinks.h"
#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Opens the reader, which belongs to the node, and waits for the agent. `sink` gets its samples and outlives
 * it. RMW_RET_TIMEOUT or RMW_RET_ERROR, with a text. */
rmw_ret_t rmw_graph_reader_open(const rmw_node_t * node, const xrce_sink_t * sink);

/* Lets the agent replace the reader, which then gets the last sample once more. Does not wait. */
void rmw_graph_reader_renew(void);

void rmw_graph_reader_close(void);

bool rmw_graph_reader_is_open(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_GRAPH_READER_H */
