/* SPDX-License-Identifier: Apache-2.0 */
#ifndef ARDUINO_HOST_WIFI_H
#define ARDUINO_HOST_WIFI_H

enum { WL_CONNECTED = 3 };

typedef int arduino_event_id_t;
typedef arduino_event_id_t WiFiEvent_t;
enum { ARDUINO_EVENT_ETH_GOT_IP = 20 };

struct HostWiFi {
  int begin(const char *, const char *)
  {
    return WL_CONNECTED;
  }
  int status()
  {
    return WL_CONNECTED;
  }
  void onEvent(void (*)(WiFiEvent_t))
  {
  }
};

static HostWiFi WiFi __attribute__((unused));

#endif /* ARDUINO_HOST_WIFI_H */
