/* SPDX-License-Identifier: Apache-2.0 */
/* What a network library brings: classes of the kinds UDP and Client. */
#ifndef HOST_NETWORK_H
#define HOST_NETWORK_H

#include "Client.h"
#include "Udp.h"

class HostUDP : public UDP
{
public:
  uint8_t begin(uint16_t port) override; /* the agent has this port on the same machine: it takes any */
  void stop() override;
  int beginPacket(IPAddress ip, uint16_t port) override;
  int endPacket() override;
  size_t write(uint8_t value) override;
  size_t write(const uint8_t * data, size_t size) override;
  int parsePacket() override;
  int available() override;
  int read() override;
  int read(unsigned char * buffer, size_t size) override;
  int peek() override;
  IPAddress remoteIP() override;
  uint16_t remotePort() override;

private:
  int socket_ = -1;
  IPAddress to_;
  uint16_t to_port_ = 0;
  uint8_t output_[2048];
  size_t output_size_ = 0;
  uint8_t input_[2048];
  size_t input_size_ = 0;
  size_t input_at_ = 0;
  IPAddress from_;
  uint16_t from_port_ = 0;
};

class HostClient : public Client
{
public:
  int connect(IPAddress ip, uint16_t port) override;
  void stop() override;
  uint8_t connected() override;
  size_t write(uint8_t value) override;
  size_t write(const uint8_t * data, size_t size) override;
  int available() override;
  int read() override;
  int read(uint8_t * buffer, size_t size) override;
  int peek() override;

private:
  int socket_ = -1;
};

#endif /* HOST_NETWORK_H */
