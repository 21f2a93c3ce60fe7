/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_loan.h"

#include "microros/cdr_loan.h"
#include "microros/lock.h"
#include "microros/rmw_decode.h"
#include "microros/rmw_receiver.h"
#include "microros/rmw_subscription.h"
#include "microros/xrce_client.h"
#include "microros/xrce_loan.h"
#include "microros/xrce_queue_memory.h"
#include "microros/xrce_read.h"

#include <string.h>

static bool loan_is_little_endian_here(void)
{
  const uint16_t number = 1u;

  return *(const uint8_t *)&number != 0u;
}

static size_t loan_index(const rmw_subscription_t * subscription)
{
  const xrce_endpoint_t * endpoint = subscription->data;

  return (size_t)endpoint->index - MICROROS_PUBLISHERS_MAX;
}

bool rmw_loan_is_possible(const rmw_subscription_t * subscription)
{
  return rmw_subscription_is_open(subscription) && rmw_loans[loan_index(subscription)].message != NULL;
}

/* Decodes a sample where it is. */
static rmw_ret_t loan_decode(
  const xrce_endpoint_t * endpoint, const xrce_sample_t * sample, const rmw_loan_t * loan)
{
  /* A multiple of four: numbers of 8 bytes are off by 4 at most. */
  uint8_t * body = xrce_queue_at((uint32_t)(sample->data - xrce_queue_at(0)));
  const bool swap = sample->big_endian == loan_is_little_endian_here();
  cdr_fault_t fault; /* set if the body is refused */

  (void)memset(loan->message, 0, loan->size);
  return cdr_loan_decode(endpoint->type, body, sample->size, swap, loan->message, &fault)
           ? RMW_RET_OK
           : rmw_decode_refuse(endpoint->type, &fault);
}

static rmw_ret_t loan_take(const xrce_endpoint_t * endpoint, size_t index, void ** message)
{
  xrce_sample_t sample;
  rmw_ret_t result;

  if (rmw_receiver_report(endpoint)) {
    return RMW_RET_ERROR;
  }
  if (!xrce_read_peek(endpoint, &sample)) {
    return RMW_RET_OK;
  }
  result = loan_decode(endpoint, &sample, &rmw_loans[index]);
  if (result != RMW_RET_OK) {
    xrce_read_pop(endpoint, true);
    return result;
  }
  endpoint->client->loaned[index] = true;
  *message = rmw_loans[index].message;
  return RMW_RET_OK;
}

rmw_ret_t rmw_loan_take(const rmw_subscription_t * subscription, void ** message)
{
  rmw_ret_t result;

  microros_lock();
  result = loan_take(subscription->data, loan_index(subscription), message);
  microros_unlock();
  return result;
}

bool rmw_loan_return(const rmw_subscription_t * subscription, const void * message)
{
  const xrce_endpoint_t * endpoint = subscription->data;
  const size_t index = loan_index(subscription);
  bool is_out;

  microros_lock();
  is_out = endpoint->client->loaned[index] && message == rmw_loans[index].message;
  if (is_out) {
    endpoint->client->loaned[index] = false;
    xrce_read_pop(endpoint, false);
  }
  microros_unlock();
  return is_out;
}
