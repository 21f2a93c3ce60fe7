/* SPDX-License-Identifier: Apache-2.0 */
#include <rcl/rcl.h>

int client_serve(char ** word, rcl_node_t * node_list);

int client_serve(char ** word, rcl_node_t * node_list)
{
  (void)word;
  (void)node_list;
  return -1;
}
