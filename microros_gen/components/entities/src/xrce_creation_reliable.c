/* SPDX-License-Identifier: Apache-2.0 */
/*
 * creation: reliable. A request is a message of the reliable stream: it takes the sequence number after
 * the last acknowledged one, and the stream holds back the application's messages until STATUS arrives. A
 * repetition has the same number and bytes, so the agent executes it once. In a new session the first
 * requests precede all stored messages of the stream.
 */
#include "microros/xrce_client.h"
#include "microros/xrce_creation_stream.h"
#include "microros/xrce_wire.h"

uint8_t * xrce_creation_room(xrce_client_t * client)
{
  return &client->creation[XRCE_MESSAGE_HEADER];
}

void xrce_creation_send(xrce_client_t * client, size_t size)
{
  xrce_put_header(client->creation, XRCE_SESSION_ID, XRCE_STREAM_RELIABLE, client->reliable.first);
  (void)xrce_session_send(&client->session, client->creation, XRCE_MESSAGE_HEADER + size);
}

void xrce_creation_end(xrce_client_t * client)
{
  ++client->reliable.first;
}
