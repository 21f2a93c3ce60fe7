/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/wake.h"

volatile uint32_t microros_news;
