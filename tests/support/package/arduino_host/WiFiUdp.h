/* SPDX-License-Identifier: Apache-2.0 */
#ifndef ARDUINO_HOST_WIFIUDP_H
#define ARDUINO_HOST_WIFIUDP_H

#include "Udp.h"

/* A socket; a packet is collected until it ends. ARDUINO_AGENT_PORT is the port in the place of 8888. */
class WiFiUDP : public UDP
{
public:
  uint8_t begin(uint16_t port) override;
  void stop() override;
  int beginPacket(IPAddress address, uint16_t port) override;
  int endPacket() override;
  size_t write(uint8_t value) override;
  size_t write(const uint8_t * buffer, size_t size) override;
  int parsePacket() override;
  int available() override;
  int read() override;
  int read(unsigned char * buffer, size_t size) override;
  int peek() override;

private:
  int udp = -1;
  IPAddress peer;
  uint16_t peer_port = 0;
  uint8_t output[2048];
  size_t output_size = 0;
  uint8_t input[2048];
  int input_size = 0;
};

#endif /* ARDUINO_HOST_WIFIUDP_H */
