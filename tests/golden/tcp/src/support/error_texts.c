/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text. Texts of the selected components, one object per text, so that the linker drops unused
 * ones; error_text.c explains the letters after %. */
#include "microros/error.h"

const MICROROS_FLASH char microros_error_argument[] = "%s: NULL or not initialized";
const MICROROS_FLASH char microros_error_context_in_use[] = "a context is open already: there is one session";
const MICROROS_FLASH char microros_error_address[] = "address %s or port %d is not valid (host: up to %m bytes)";
const MICROROS_FLASH char microros_error_name[] = "name '%s': %d";
const MICROROS_FLASH char microros_error_name_long[] = "name '%s' takes %n bytes: set pools: {name_size: %m}%y";
const MICROROS_FLASH char microros_error_node_undeclared[] = "node not declared: add to nodes:%y: {name: %s, namespace: '%d'}";
const MICROROS_FLASH char microros_error_node_open[] = "node %s is open already";
const MICROROS_FLASH char microros_error_nodes_full[] = "all %n nodes are open: set pools: {nodes: %m}%y";
const MICROROS_FLASH char microros_error_publisher_undeclared[] = "publisher not declared: add to its node's publishers:%y: {topic: %s, type: %D}";
const MICROROS_FLASH char microros_error_publisher_open[] = "publisher %s is open already";
const MICROROS_FLASH char microros_error_publishers_full[] = "all %n publishers are open: set pools: {publishers: %m}%y";
const MICROROS_FLASH char microros_error_stream_small[] = "%t takes %n bytes and its stream holds %m: declare the publisher with its qos%y";
const MICROROS_FLASH char microros_error_qos[] = "publisher %s: XRCE carries no such QoS: %d";
const MICROROS_FLASH char microros_error_entity_silent[] = "%d %s: no answer of the agent within %m ms";
const MICROROS_FLASH char microros_error_entity_refused[] = "%d %s: the agent refuses it: %a (entities%y)";
const MICROROS_FLASH char microros_error_field[] = "limit %m: set limits: {%t: {%d}}%y";
const MICROROS_FLASH char microros_error_no_session[] = "publisher %s: no session with the agent";
const MICROROS_FLASH char microros_error_not_sent[] = "publisher %s: the transport has no room for it";
const MICROROS_FLASH char microros_error_arena[] = "no memory for %n bytes: raise memory: {arena: %m}%y";
const MICROROS_FLASH char microros_error_serialized[] = "serialized message: not little endian CDR, or %n bytes above %m";
const MICROROS_FLASH char microros_error_domain[] = "domain %n is above %m";
const MICROROS_FLASH char microros_error_memory_given[] = "the allocator gives no memory for %n bytes";
const MICROROS_FLASH char microros_error_pool_full[] = "all %n %s are in use: set pools: {%s: %m}%y";
const MICROROS_FLASH char microros_error_clock[] = "clock: %s";
const MICROROS_FLASH char microros_error_field_bound[] = "%t.%d: %n, and its interface file allows %m";
const MICROROS_FLASH char microros_error_field_data[] = "%t.%d has a size, %n, and no data: NULL";
const MICROROS_FLASH char microros_error_pool_most[] = "%s: all %n places are in use, the maximum of a session";
const MICROROS_FLASH char microros_error_block_large[] = "%n bytes of a string or sequence: no sent message has more than %m: raise limits: {TYPE: {MEMBER: N}}%y";
const MICROROS_FLASH char microros_error_blocks_taken[] = "all blocks of %n bytes are in use: free one, or set memory: {messages: %m}%y";
