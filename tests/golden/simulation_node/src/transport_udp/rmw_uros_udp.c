/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_address.h"
#include "rmw_microros/init_options.h"

rmw_ret_t rmw_uros_options_set_udp_address(
  const char * ip, const char * port, rmw_init_options_t * rmw_options)
{
  return rmw_address_set(rmw_options, ip, port);
}
