/* SPDX-License-Identifier: Apache-2.0 */
/* All topics of this plan are topics of ROS. Internal. */
#ifndef MICROROS_XRCE_TOPIC_PREFIX_H
#define MICROROS_XRCE_TOPIC_PREFIX_H

#include "microros/flash.h"
#include "microros/xrce_objects.h"

/* Returns what precedes the name of an endpoint's topic in DDS. */
static inline const MICROROS_FLASH char * xrce_topic_prefix(const xrce_endpoint_t * endpoint)
{
  (void)endpoint;
  return MICROROS_FLASH_TEXT("rt");
}

/* Returns the same after the element that contains the name in XML. */
static inline const MICROROS_FLASH char * xrce_topic_prefix_xml(const xrce_endpoint_t * endpoint)
{
  (void)endpoint;
  return MICROROS_FLASH_TEXT("<name>rt");
}

#endif /* MICROROS_XRCE_TOPIC_PREFIX_H */
