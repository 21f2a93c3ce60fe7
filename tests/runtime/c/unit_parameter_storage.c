/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parameters in a simulated flash that loses power at every unit that it writes or erases, with a unit that is written half.
 * What is loaded afterwards is the old set or the new one. Then damaged bytes, other versions, the wrap of the number of a
 * save, and firmware with other parameters.
 */
#include "microros/port_storage.h"
#include "microros/rclc_parameter_storage_slot.h"
#include "rcl/error_handling.h"
#include "rclc_parameter/parameter_storage.h"

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SLOTS = 4, SLOT_SIZE = 2048, UNIT = 8, CUTS_MOST = 4000 };

static uint8_t flash[SLOTS][SLOT_SIZE];
static uint32_t slot_size = SLOT_SIZE;
static long units_left = -1; /* negative: the power stays */
static long units_written;
static bool is_worn; /* writes do nothing */
static jmp_buf power;
static rclc_parameter_server_t server;
static rcl_node_t node;
static bool refuses;

static void expect(bool is_true, const char * what, long place)
{
  if (!is_true) {
    printf("%s, %ld: %s\n", what, place, rcl_get_error_string().str);
    exit(1);
  }
}

static void lose_power(void)
{
  if (units_left == 0) {
    units_left = -1;
    longjmp(power, 1);
  }
  units_left -= units_left > 0 ? 1 : 0;
}

bool port_storage_erase(uint32_t slot)
{
  if (slot >= SLOTS) {
    return false;
  }
  for (uint32_t at = 0; at < SLOT_SIZE; at += UNIT) {
    if (at % 256u == 0u) {
      lose_power();
    }
    memset(&flash[slot][at], 0xff, UNIT);
  }
  return true;
}

bool port_storage_write(uint32_t slot, uint32_t offset, const uint8_t * bytes, uint32_t size)
{
  if (slot >= SLOTS || offset + size > slot_size) {
    return false;
  }
  expect(offset % UNIT == 0u && size % UNIT == 0u && size != 0u, "units", offset);
  for (uint32_t at = 0; at < size; at += UNIT) {
    uint8_t * const unit = &flash[slot][offset + at];

    for (uint32_t i = 0; i < UNIT; ++i) {
      expect(unit[i] == 0xff, "written twice", offset + at);
    }
    ++units_written;
    if (units_left == 0) {
      memcpy(unit, &bytes[at], UNIT / 2u); /* half of it */
    }
    lose_power();
    if (!is_worn) {
      memcpy(unit, &bytes[at], UNIT);
    }
  }
  return true;
}

bool port_storage_read(uint32_t slot, uint32_t offset, uint8_t * bytes, uint32_t size)
{
  if (slot >= SLOTS || offset + size > SLOT_SIZE) {
    return false;
  }
  memcpy(bytes, &flash[slot][offset], size);
  return true;
}

static bool on_parameter(const Parameter * old_param, const Parameter * new_param, void * context)
{
  (void)old_param;
  (void)new_param;
  (void)context;
  return !refuses;
}

static void ok(rcl_ret_t result, const char * what)
{
  expect(result == RCL_RET_OK, what, (long)result);
}

/* As rclc_parameter_server_init and the application leave it, without services. */
static void boot(void)
{
  memset(&server, 0, sizeof(server));
  server.node = &node;
  server.max_params = MICROROS_PARAMETERS_MAX;
  ok(rclc_add_parameter(&server, "gain", RCLC_PARAMETER_DOUBLE), "gain");
  ok(rclc_add_parameter_constraint_double(&server, "gain", 0.0, 100.0, 0.0), "range");
  ok(rclc_add_parameter(&server, "label", RCLC_PARAMETER_STRING), "label");
  ok(rclc_add_parameter(&server, "ports", RCLC_PARAMETER_INT_ARRAY), "ports");
  ok(rclc_add_parameter(&server, "on", RCLC_PARAMETER_BOOL), "on");
}

/* Sets all four to values that belong to `number`. */
static void set(int64_t number)
{
  const int64_t ports[2] = {number, -number};
  char label[12];

  (void)snprintf(label, sizeof(label), "set %d", (int)number);
  ok(rclc_parameter_set_double(&server, "gain", (double)number), "set gain");
  ok(rclc_parameter_set_string(&server, "label", label), "set label");
  ok(rclc_parameter_set_int_array(&server, "ports", ports, 2), "set ports");
  ok(rclc_parameter_set_bool(&server, "on", number % 2 == 1), "set on");
}

/* Returns the number of the set, 0 for that of the start; ends where values belong to several. */
static int64_t number_of(long place)
{
  double gain = 0.0;
  const char * label = NULL;
  const int64_t * ports = NULL;
  size_t count = 0;
  bool on = false;
  char expected[12] = "";
  int64_t number;

  ok(rclc_parameter_get_double(&server, "gain", &gain), "get gain");
  ok(rclc_parameter_get_string(&server, "label", &label), "get label");
  ok(rclc_parameter_get_int_array(&server, "ports", &ports, &count), "get ports");
  ok(rclc_parameter_get_bool(&server, "on", &on), "get on");
  number = (int64_t)gain;
  if (number != 0) {
    (void)snprintf(expected, sizeof(expected), "set %d", (int)number);
  }
  expect(strcmp(label, expected) == 0, "label", place);
  expect(on == (number % 2 == 1), "on", place);
  expect(
    number == 0 ? count == 0u : count == 2u && ports[0] == number && ports[1] == -number, "ports", place);
  return number;
}

static int64_t loaded(long place)
{
  size_t skipped = 9;

  boot();
  ok(rclc_parameter_storage_load(&server, 0, &skipped), "load");
  expect(skipped == 0u, "skipped", place);
  return number_of(place);
}

/* Saves a set; returns whether the power was lost on the way. */
static bool save_until_cut(int64_t number, long units)
{
  boot();
  set(number);
  units_left = units;
  if (setjmp(power) != 0) {
    return true;
  }
  ok(rclc_parameter_storage_save(&server, 0), "save");
  units_left = -1;
  return false;
}

static void erase_all(void)
{
  memset(flash, 0xff, sizeof(flash));
}

/* The power is lost at each unit of the third save; the fourth one works, and so does the one before. */
static long cut_everywhere(void)
{
  long cuts = 0;
  bool is_cut = true;
  long old_seen = 0;
  long new_seen = 0;

  for (; is_cut && cuts < CUTS_MOST; ++cuts) {
    int64_t number;

    erase_all();
    expect(!save_until_cut(1, -1), "first", cuts);
    expect(!save_until_cut(2, -1), "second", cuts);
    is_cut = save_until_cut(3, cuts);
    number = loaded(cuts);
    expect(number == 2 || number == 3, "old or new", cuts);
    expect(is_cut || number == 3, "new", cuts);
    old_seen += number == 2 ? 1 : 0;
    new_seen += number == 3 ? 1 : 0;
    expect(!save_until_cut(4, -1), "fourth", cuts);
    expect(loaded(cuts) == 4, "after the fourth", cuts);
  }
  expect(old_seen > 10 && new_seen > 0, "both", cuts);
  return cuts;
}

/* The first save of all leaves the values of the start, or its own. */
static void cut_the_first(void)
{
  bool is_cut = true;

  for (long cut = 0; is_cut && cut < CUTS_MOST; ++cut) {
    rcl_ret_t result;

    erase_all();
    is_cut = save_until_cut(1, cut);
    boot();
    result = rclc_parameter_storage_load(&server, 0, NULL);
    expect(result == RCL_RET_OK || (result == RCL_RET_ERROR && is_cut), "result", cut);
    expect(number_of(cut) == (is_cut ? 0 : 1), "first", cut);
    rcl_reset_error();
    expect(!save_until_cut(2, -1), "second", cut);
    expect(loaded(cut) == 2, "after the second", cut);
  }
}

/* Each byte of the newest slot is damaged in turn: the old set is there. With both damaged it is an error. */
static void damage(void)
{
  for (uint32_t at = 0; at < 320u; ++at) {
    int64_t number;

    erase_all();
    expect(!save_until_cut(1, -1), "first", at);
    expect(!save_until_cut(2, -1), "second", at);
    flash[1][at] ^= 0x10u;
    number = loaded(at);
    expect(number == 1 || (number == 2 && at > 200u), "damaged", at); /* behind the records nothing counts */
    flash[0][at % 24u] ^= 0x10u;
    flash[1][0] ^= 0x01u;
    boot();
    expect(rclc_parameter_storage_load(&server, 0, NULL) == RCL_RET_ERROR, "both", at);
    expect(strstr(rcl_get_error_string().str, "damaged") != NULL, "text", at);
    rcl_reset_error();
    expect(number_of(at) == 0, "values of the start", at);
  }
}

static void write_header(uint32_t slot, uint32_t sequence, uint32_t version)
{
  storage_header_t header;
  uint8_t room[UNIT];

  expect(microros_storage_look(slot, &header, room, sizeof(room)) == STORAGE_GOOD, "slot", slot);
  header.sequence = sequence;
  header.version = version;
  header.checksum =
    microros_storage_checksum(0u, (const uint8_t *)&header, sizeof(header) - sizeof(header.checksum));
  memcpy(flash[slot], &header, sizeof(header));
}

static void wrap_and_version(void)
{
  static uint8_t later[SLOT_SIZE];

  erase_all();
  expect(!save_until_cut(1, -1), "first", 0);
  write_header(0, UINT32_MAX, STORAGE_VERSION);
  for (int64_t number = 2; number < 6; ++number) {
    expect(!save_until_cut(number, -1), "wrap", (long)number);
    expect(loaded((long)number) == number, "after the wrap", (long)number);
  }
  erase_all();
  expect(!save_until_cut(1, -1), "first", 1);
  write_header(0, 0, STORAGE_VERSION + 1);
  boot();
  expect(rclc_parameter_storage_load(&server, 0, NULL) == RCL_RET_ERROR, "version", 1);
  expect(strstr(rcl_get_error_string().str, "version") != NULL, "text of the version", 1);
  rcl_reset_error();
  expect(number_of(1) == 0, "values of the start", 1);
  memcpy(later, flash[0], SLOT_SIZE);
  set(2);
  ok(rclc_parameter_storage_save(&server, 0), "save beside the other version");
  expect(loaded(1) == 2, "own version", 1);
  expect(memcmp(later, flash[0], SLOT_SIZE) == 0, "the later firmware still has its values", 1);
}

/* The same values are not written again; a memory that refuses or forgets is told, and the old set stays. */
static void memory_that_fails(void)
{
  long before;

  erase_all();
  expect(!save_until_cut(1, -1), "first", 0);
  before = units_written;
  expect(!save_until_cut(1, -1), "the same", 0);
  expect(units_written == before, "nothing is written", units_written);
  boot();
  set(2);
  slot_size = 64;
  expect(rclc_parameter_storage_save(&server, 0) == RCL_RET_ERROR, "too small", 0);
  rcl_reset_error();
  slot_size = SLOT_SIZE;
  is_worn = true;
  expect(rclc_parameter_storage_save(&server, 0) == RCL_RET_ERROR, "worn", 0);
  expect(strstr(rcl_get_error_string().str, "other bytes") != NULL, "text", 0);
  rcl_reset_error();
  is_worn = false;
  expect(loaded(0) == 1, "the old set", 0);
  expect(rclc_parameter_storage_save(&server, SLOTS) == RCL_RET_ERROR, "no such slot", 0);
  rcl_reset_error();
  ok(rclc_parameter_storage_load(&server, SLOTS, NULL), "a set that was never saved");
  ok(rclc_parameter_storage_save(&server, 1), "another server");
  expect(loaded(0) == 1, "sets are apart", 0);
}

static size_t skipped_by_load(void)
{
  size_t skipped = 0;

  ok(rclc_parameter_storage_load(&server, 0, &skipped), "load");
  return skipped;
}

/* Firmware whose parameters changed keeps what still fits. */
static void other_firmware(void)
{
  double gain = 0.0;
  bool on = false;

  erase_all();
  expect(!save_until_cut(3, -1), "save", 0);
  boot();
  ok(rclc_add_parameter_constraint_double(&server, "gain", 0.0, 2.0, 0.0), "smaller range");
  ok(rclc_delete_parameter(&server, "ports"), "fewer");
  ok(rclc_delete_parameter(&server, "on"), "type");
  ok(rclc_add_parameter(&server, "on", RCLC_PARAMETER_INT), "other type");
  expect(skipped_by_load() == 3u, "three are skipped", 0);
  ok(rclc_parameter_get_double(&server, "gain", &gain), "gain");
  expect(gain == 0.0, "outside the range", 0);
  boot();
  ok(rclc_set_parameter_read_only(&server, "on", true), "read only");
  expect(skipped_by_load() == 1u, "read only", 0);
  ok(rclc_parameter_get_bool(&server, "on", &on), "on");
  expect(!on, "its value", 0);
  boot();
  server.on_modification = on_parameter;
  refuses = true;
  expect(skipped_by_load() == 4u, "the callback", 0);
  refuses = false;
  expect(skipped_by_load() == 0u, "accepts", 0);
  server.on_callback = true;
  expect(rclc_parameter_storage_load(&server, 0, NULL) != RCL_RET_OK, "load in the callback", 0);
  expect(rclc_parameter_storage_save(&server, 0) != RCL_RET_OK, "save in the callback", 0);
  expect(rclc_parameter_storage_load(NULL, 0, NULL) == RCL_RET_INVALID_ARGUMENT, "NULL", 0);
  rcl_reset_error();
}

/* A shutdown in the wrong order loses no value. */
static void save_after_the_end(void)
{
  size_t skipped = 0;

  memset(flash, 0xff, sizeof(flash));
  boot();
  set(7);
  ok(rclc_parameter_storage_save(&server, 0), "save");
  (void)rclc_parameter_server_fini(&server, &node); /* the node of this program was never opened */
  expect(rclc_parameter_storage_save(&server, 0) != RCL_RET_OK, "saved without parameters", 0);
  rcl_reset_error();
  boot();
  ok(rclc_parameter_storage_load(&server, 0, &skipped), "load");
  expect(skipped == 0u && number_of(0) == 7, "values", (long)skipped);
}

int main(void)
{
  const long cuts = cut_everywhere();

  cut_the_first();
  damage();
  wrap_and_version();
  memory_that_fails();
  other_firmware();
  save_after_the_end();
  printf("%ld cuts\n", cuts);
  return 0;
}
