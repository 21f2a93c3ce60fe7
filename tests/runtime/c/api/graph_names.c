/* SPDX-License-Identifier: Apache-2.0 */
/* Names of nodes that queries of the graph refuse: compiled against ROS 2's librcl and against the generated library. */
#include "tell.h"

#include <rcl/graph.h>
#include <rcl/rcl.h>

static rcl_context_t context;
static rcl_node_t node;
static rcl_allocator_t allocator;
static rcl_names_and_types_t names;

static void start(void)
{
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  rcl_node_options_t choices = rcl_node_get_default_options();

  context = rcl_get_zero_initialized_context();
  node = rcl_get_zero_initialized_node();
  names = rcl_get_zero_initialized_names_and_types();
  allocator = heap;
  TELL(rcl_init_options_init(&options, heap));
  TELL(rcl_init(0, NULL, &options, &context));
  TELL(rcl_node_init(&node, "device", "/arm", &context, &choices));
}

static void ask(const char * name, const char * namespace_)
{
  SAY("node '%s' '%s' 0\n", name == NULL ? "NULL" : name, namespace_ == NULL ? "NULL" : namespace_);
  TELL(rcl_get_publisher_names_and_types_by_node(&node, &allocator, false, name, namespace_, &names));
  TELL(rcl_get_publisher_names_and_types_by_node(&node, &allocator, true, name, namespace_, &names));
  TELL(rcl_get_subscriber_names_and_types_by_node(&node, &allocator, false, name, namespace_, &names));
  TELL(rcl_get_service_names_and_types_by_node(&node, &allocator, name, namespace_, &names));
  TELL(rcl_get_client_names_and_types_by_node(&node, &allocator, name, namespace_, &names));
}

int main(void)
{
  start();
  ask("device", "arm");
  ask("device", "x");
  ask("device", "/arm/");
  ask("device", "//");
  ask("device", "/a//b");
  ask("device", "/1a");
  ask("device", "/a b");
  ask("no%such", "/arm");
  ask("no%such", "arm");
  ask("no%such", "");
  ask("", "/arm");
  ask("", "");
  ask("1a", "/");
  ask("a/b", "/");
  ask("/device", "/");
  ask(NULL, "/arm");
  ask("device", NULL);
  TELL(rcl_get_service_names_and_types_by_node(NULL, &allocator, "no%such", "/", &names));
  TELL(rcl_get_service_names_and_types_by_node(&node, NULL, "no%such", "/", &names));
  TELL(rcl_get_service_names_and_types_by_node(&node, &allocator, "no%such", "/", NULL));
  TELL(rcl_node_fini(&node));
  TELL(rcl_shutdown(&context));
  TELL(rcl_context_fini(&context));
  return 0;
}
