/* SPDX-License-Identifier: Apache-2.0 */
/* Service type as the runtime sees it: its name, and the types of its messages. */
#ifndef MICROROS_SERVICE_TYPE_H
#define MICROROS_SERVICE_TYPE_H

#include "microros/message_type.h"

typedef struct microros_service_type_t {
  const MICROROS_FLASH char *
    dds_type_name; /* "std_srvs::srv::dds_::SetBool_"; Request_ or Response_ is appended for its messages */
  const microros_message_type_t * request;
  const microros_message_type_t * response;
} microros_service_type_t;

#endif /* MICROROS_SERVICE_TYPE_H */
