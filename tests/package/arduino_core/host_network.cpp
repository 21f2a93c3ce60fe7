/* SPDX-License-Identifier: Apache-2.0 */
#include "HostNetwork.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

static sockaddr_in place(const IPAddress & ip, uint16_t port)
{
  sockaddr_in found = {};

  found.sin_family = AF_INET;
  found.sin_port = htons(port);
  found.sin_addr.s_addr = htonl((uint32_t)ip[0] << 24 | (uint32_t)ip[1] << 16 | (uint32_t)ip[2] << 8 | ip[3]);
  return found;
}

uint8_t HostUDP::begin(uint16_t)
{
  stop();
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0);
  return socket_ >= 0 ? 1 : 0;
}

void HostUDP::stop()
{
  if (socket_ >= 0) {
    close(socket_);
  }
  socket_ = -1;
  input_size_ = input_at_ = 0;
}

int HostUDP::beginPacket(IPAddress ip, uint16_t port)
{
  to_ = ip;
  to_port_ = port;
  output_size_ = 0;
  return socket_ >= 0 ? 1 : 0;
}

int HostUDP::endPacket()
{
  const sockaddr_in to = place(to_, to_port_);

  return sendto(socket_, output_, output_size_, 0, (const sockaddr *)&to, sizeof(to)) ==
         (ssize_t)output_size_;
}

size_t HostUDP::write(uint8_t value)
{
  return write(&value, 1);
}

size_t HostUDP::write(const uint8_t * data, size_t size)
{
  const size_t room = sizeof(output_) - output_size_;
  const size_t count = size < room ? size : room;

  memcpy(&output_[output_size_], data, count);
  output_size_ += count;
  return count;
}

int HostUDP::parsePacket()
{
  sockaddr_in from = {};
  socklen_t size = sizeof(from);
  const ssize_t count = recvfrom(socket_, input_, sizeof(input_), 0, (sockaddr *)&from, &size);
  const uint32_t address = ntohl(from.sin_addr.s_addr);

  input_at_ = 0;
  input_size_ = count > 0 ? (size_t)count : 0;
  from_ = IPAddress(address >> 24, (address >> 16) & 255, (address >> 8) & 255, address & 255);
  from_port_ = ntohs(from.sin_port);
  return (int)input_size_;
}

int HostUDP::available()
{
  return (int)(input_size_ - input_at_);
}

int HostUDP::read()
{
  return available() > 0 ? input_[input_at_++] : -1;
}

int HostUDP::read(unsigned char * buffer, size_t size)
{
  const size_t left = input_size_ - input_at_;
  const size_t count = size < left ? size : left;

  memcpy(buffer, &input_[input_at_], count);
  input_at_ += count;
  return (int)count;
}

int HostUDP::peek()
{
  return available() > 0 ? input_[input_at_] : -1;
}

IPAddress HostUDP::remoteIP()
{
  return from_;
}

uint16_t HostUDP::remotePort()
{
  return from_port_;
}

int HostClient::connect(IPAddress ip, uint16_t port)
{
  const sockaddr_in to = place(ip, port);

  stop();
  socket_ = socket(AF_INET, SOCK_STREAM, 0);
  if (::connect(socket_, (const sockaddr *)&to, sizeof(to)) != 0) {
    stop();
    return 0;
  }
  return 1;
}

void HostClient::stop()
{
  if (socket_ >= 0) {
    close(socket_);
  }
  socket_ = -1;
}

uint8_t HostClient::connected()
{
  char value;

  if (socket_ < 0) {
    return 0;
  }
  const ssize_t found = recv(socket_, &value, 1, MSG_PEEK | MSG_DONTWAIT);
  return found > 0 || (found < 0 && errno == EAGAIN) ? 1 : 0;
}

size_t HostClient::write(uint8_t value)
{
  return write(&value, 1);
}

size_t HostClient::write(const uint8_t * data, size_t size)
{
  const ssize_t count = send(socket_, data, size, MSG_NOSIGNAL);

  return count > 0 ? (size_t)count : 0;
}

int HostClient::available()
{
  int count = 0;

  return socket_ >= 0 && ioctl(socket_, FIONREAD, &count) == 0 ? count : 0;
}

int HostClient::read()
{
  uint8_t value;

  return read(&value, 1) == 1 ? value : -1;
}

int HostClient::read(uint8_t * buffer, size_t size)
{
  return (int)recv(socket_, buffer, size, MSG_DONTWAIT);
}

int HostClient::peek()
{
  return -1;
}
