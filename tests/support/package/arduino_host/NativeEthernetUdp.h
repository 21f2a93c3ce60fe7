/* SPDX-License-Identifier: Apache-2.0 */
#include "WiFiUdp.h"

typedef WiFiUDP EthernetUDP;
