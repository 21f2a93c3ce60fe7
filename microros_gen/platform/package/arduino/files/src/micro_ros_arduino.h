/* SPDX-License-Identifier: Apache-2.0 */
/*
 * micro-ROS for sketches: the functions that choose a transport. Call one of them in setup(), before
 * rclc_support_init.
 *
 * An object that is passed (a Stream, UDP or Client) belongs to the sketch and must exist as long as the session does: make
 * it a global variable. The functions return false if the plan of the library excludes the transport, or an address is
 * wrong; rcl_get_error_string() says why. None of them takes memory from the heap.
 */
#ifndef MICRO_ROS_ARDUINO_H
#define MICRO_ROS_ARDUINO_H

#include <Arduino.h>
#include <Client.h>
#include <IPAddress.h>
#include <Stream.h>
#include <Udp.h>

#include <rmw_microros/rmw_microros.h>
#include <uxr/client/transport.h>

#if defined(__AVR__)
typedef unsigned int uint; /* sketches for other boards use it, and avr-libc does not define it */
#endif

/* The agent at the other end of any stream of bytes that was begun: a UART, USB CDC, a radio's serial mode. */
bool set_microros_stream_transport(Stream & stream);

/* The agent at an address, by UDP: EthernetUDP, WiFiUDP or any other class of that kind. The network is up. The same
 * port is used on this side. */
bool set_microros_udp_transport(UDP & udp, IPAddress agent_ip, uint16_t agent_port);

/* The agent at an address, by TCP: EthernetClient, WiFiClient or any other class of that kind. The network is up. */
bool set_microros_tcp_transport(Client & client, IPAddress agent_ip, uint16_t agent_port);

/* The four functions of set_microros_transports. A sketch replaces them if it defines all four. */
extern "C" bool arduino_transport_open(struct uxrCustomTransport * transport);
extern "C" bool arduino_transport_close(struct uxrCustomTransport * transport);
extern "C" size_t arduino_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buffer, size_t length, uint8_t * error);
extern "C" size_t arduino_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buffer, size_t length, int timeout, uint8_t * error);

/* The agent at the other end of Serial, at 115,200 baud. */
static inline void set_microros_transports()
{
  (void)rmw_uros_set_custom_transport(
    true, NULL, arduino_transport_open, arduino_transport_close, arduino_transport_write,
    arduino_transport_read);
}

/* Boards whose network library is known. With another one: its headers first, then the header that is included here. */
#if defined(TARGET_STM32F4)
#include <LwIP.h>
#include <STM32Ethernet.h>
#include <EthernetUdp.h>
#include <micro_ros_arduino_ethernet.h>
#elif defined(ARDUINO_TEENSY41)
#include <NativeEthernet.h>
#include <micro_ros_arduino_ethernet.h>
#elif defined(TARGET_PORTENTA_H7_M7)
#include <PortentaEthernet.h>
#include <EthernetUdp.h>
#include <micro_ros_arduino_ethernet.h>
#endif

#if defined(ESP32) || defined(TARGET_PORTENTA_H7_M7)
#include <WiFi.h>
#include <WiFiUdp.h>
#include <micro_ros_arduino_wifi.h>
#elif defined(ARDUINO_NANO_RP2040_CONNECT)
#include <SPI.h>
#include <WiFiNINA.h>
#include <micro_ros_arduino_wifi.h>
#elif defined(ARDUINO_WIO_TERMINAL)
#include <rpcWiFi.h>
#include <WiFiUdp.h>
#include <micro_ros_arduino_wifi.h>
#elif defined(BOARD_WITH_ESP_AT)
#include <WiFiEspAT.h>
#include <micro_ros_arduino_wifi.h>
#endif

#endif /* MICRO_ROS_ARDUINO_H */
