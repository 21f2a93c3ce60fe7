/* SPDX-License-Identifier: Apache-2.0 */
/* Some topic of this plan has a name in DDS that ROS does not have. Internal. */
#ifndef MICROROS_XRCE_TOPIC_PREFIX_H
#define MICROROS_XRCE_TOPIC_PREFIX_H

#include "microros/flash.h"
#include "microros/xrce_objects.h"

/* Returns what precedes the name of an endpoint's topic in DDS: nothing for a name that ROS does not have. */
static inline const MICROROS_FLASH char * xrce_topic_prefix(const xrce_endpoint_t * endpoint)
{
  return endpoint->name[0] == '/' ? MICROROS_FLASH_TEXT("rt") : MICROROS_FLASH_TEXT("");
}

/* Returns the same after the element that contains the name in XML. */
static inline const MICROROS_FLASH char * xrce_topic_prefix_xml(const xrce_endpoint_t * endpoint)
{
  return endpoint->name[0] == '/' ? MICROROS_FLASH_TEXT("<name>rt") : MICROROS_FLASH_TEXT("<name>");
}

#endif /* MICROROS_XRCE_TOPIC_PREFIX_H */
