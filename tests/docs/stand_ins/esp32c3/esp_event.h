/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_ESP_EVENT_H
#define STAND_IN_ESP_EVENT_H

int esp_event_loop_create_default(void);

#endif /* STAND_IN_ESP_EVENT_H */
