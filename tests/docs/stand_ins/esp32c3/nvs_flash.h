/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_NVS_FLASH_H
#define STAND_IN_NVS_FLASH_H

int nvs_flash_init(void);

#endif /* STAND_IN_NVS_FLASH_H */
