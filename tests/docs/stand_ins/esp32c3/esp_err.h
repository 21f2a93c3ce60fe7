/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_ESP_ERR_H
#define STAND_IN_ESP_ERR_H

typedef int esp_err_t;
#define ESP_ERROR_CHECK(call) (void)(call)

#endif /* STAND_IN_ESP_ERR_H */
