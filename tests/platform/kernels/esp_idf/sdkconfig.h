/* SPDX-License-Identifier: Apache-2.0 */
/* Settings of menuconfig. */
#ifdef __clang__
#define CONFIG_IDF_TARGET_LINUX 1
#endif
