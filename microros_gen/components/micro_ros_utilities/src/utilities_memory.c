/* SPDX-License-Identifier: Apache-2.0 */
/* Sizes, creation and destruction: each is one walk over the same members in the same order. */
#include "microros/arena.h"
#include "microros/error.h"
#include "microros/message_pools.h"
#include "microros/utilities_walk.h"

#include <string.h>

/* Largest alignment of any member on any target, in bytes. */
enum { ALIGNMENT_MOST = 8 };

typedef enum memory_mode_t {
  MEMORY_COUNT,   /* count the bytes requested from an allocator */
  MEMORY_MEASURE, /* count the bytes taken from a buffer */
  MEMORY_ALLOCATE,
  MEMORY_PLACE /* place in the buffer */
} memory_mode_t;

typedef struct memory_t {
  memory_mode_t mode;
  const micro_ros_utilities_memory_conf_t * conf;
  rcutils_allocator_t allocator; /* for MEMORY_ALLOCATE */
  uint8_t * buffer;              /* for MEMORY_PLACE: its first aligned byte */
  size_t used;                   /* bytes so far */
  size_t alignment;              /* alignment that the buffer needs so far */
} memory_t;

static memory_t memory_begin(memory_mode_t mode, const micro_ros_utilities_memory_conf_t * conf)
{
  memory_t memory;

  (void)memset(&memory, 0, sizeof(memory));
  memory.mode = mode;
  memory.conf = conf;
  memory.alignment = 1;
  return memory;
}

/*
 * Returns the largest power of two that divides the size of an element: its size is a multiple of its
 * alignment, so this is one, too. */
static size_t memory_alignment(size_t element)
{
  const size_t power = element & (~element + 1u);

  return power < (size_t)ALIGNMENT_MOST ? power : (size_t)ALIGNMENT_MOST;
}

static size_t memory_aligned(size_t position, size_t alignment)
{
  return (position + (alignment - 1u)) & ~(alignment - 1u);
}

static bool memory_allocate(
  const memory_t * memory, const microros_pool_t * pool, size_t size, uint8_t ** given)
{
  size_t room = size;

  if (
    memory->allocator.allocate ==
    microros_arena_allocate) { /* the default one: messages have separate storage */
    *given = microros_memory_take(pool, &room);
    return *given != NULL;
  }
  *given = memory->allocator.allocate(size, memory->allocator.state);
  if (*given == NULL) {
    microros_error_set(microros_error_memory_given, NULL, NULL, (uint32_t)size, 0);
    return false;
  }
  (void)memset(*given, 0, size);
  return true;
}

/* Takes memory for `count` elements; *given is NULL if `count` is 0, or if only sizes are counted. */
static bool memory_take(
  memory_t * memory, const microros_pool_t * pool, size_t count, size_t element, uint8_t ** given)
{
  const size_t alignment = memory_alignment(element);
  size_t start = memory->used;

  *given = NULL;
  if (count == 0u) {
    return true;
  }
  if (count > ((SIZE_MAX - (size_t)2u * ALIGNMENT_MOST) - start) / element) {
    microros_error_set(microros_error_memory_given, NULL, NULL, UINT32_MAX, 0);
    return false;
  }
  if (memory->mode == MEMORY_MEASURE || memory->mode == MEMORY_PLACE) {
    start = memory_aligned(start, alignment);
    memory->alignment = alignment > memory->alignment ? alignment : memory->alignment;
  }
  memory->used = start + count * element;
  if (memory->mode == MEMORY_PLACE) {
    *given = &memory->buffer[start];
  }
  return memory->mode != MEMORY_ALLOCATE || memory_allocate(memory, pool, count * element, given);
}

/*
 * Takes memory for one string or sequence and stores its address at `place`; *given is the memory of the
 * elements. */
static bool memory_provide(
  memory_t * memory, const microros_pool_t * pool, uint8_t * place, size_t count, size_t element,
  uint8_t ** given)
{
  if (!memory_take(memory, pool, count, element, given)) {
    return false;
  }
  if (place != NULL) {
    const microros_type_sequence_t sequence = {*given, 0, count};

    (void)memcpy(place, &sequence, sizeof(sequence));
  }
  return true;
}

/* Returns element `index`; NULL if `elements` is. */
static uint8_t * memory_element(uint8_t * elements, size_t index, size_t size)
{
  return elements == NULL ? NULL : &elements[index * size];
}

static size_t memory_unit(const microros_type_member_t * member)
{
  return member->type == (uint8_t)MICROROS_MEMBER_WSTRING ? sizeof(uint_least16_t) : 1u;
}

/* Returns the pool of the characters of a string. */
static const microros_pool_t * memory_text_pool(const microros_type_member_t * member)
{
  return member->type == (uint8_t)MICROROS_MEMBER_WSTRING ? MICROROS_POOL_u16text : MICROROS_POOL_text;
}

/* Returns the pool of the elements of a sequence. */
static const microros_pool_t * memory_pool(const microros_type_member_t * member)
{
  static const microros_pool_t * const pools[] = {
    [MICROROS_MEMBER_FLOAT] = MICROROS_POOL_float,     [MICROROS_MEMBER_DOUBLE] = MICROROS_POOL_double,
    [MICROROS_MEMBER_CHAR] = MICROROS_POOL_char,       [MICROROS_MEMBER_WCHAR] = MICROROS_POOL_wchar,
    [MICROROS_MEMBER_BOOLEAN] = MICROROS_POOL_boolean, [MICROROS_MEMBER_OCTET] = MICROROS_POOL_octet,
    [MICROROS_MEMBER_UINT8] = MICROROS_POOL_uint8,     [MICROROS_MEMBER_INT8] = MICROROS_POOL_int8,
    [MICROROS_MEMBER_UINT16] = MICROROS_POOL_uint16,   [MICROROS_MEMBER_INT16] = MICROROS_POOL_int16,
    [MICROROS_MEMBER_UINT32] = MICROROS_POOL_uint32,   [MICROROS_MEMBER_INT32] = MICROROS_POOL_int32,
    [MICROROS_MEMBER_UINT64] = MICROROS_POOL_uint64,   [MICROROS_MEMBER_INT64] = MICROROS_POOL_int64,
    [MICROROS_MEMBER_STRING] = MICROROS_POOL_string,   [MICROROS_MEMBER_WSTRING] = MICROROS_POOL_u16string};

  return member->nested != NULL ? member->nested->pool : pools[member->type];
}

/* Allocates the current member and enters its nested messages. */
static bool memory_of_member(memory_t * memory, utilities_walk_t * walk)
{
  const microros_type_member_t * member = walk->member;
  const size_t size = utilities_element_size(member);
  uint8_t * elements = walk->place;
  size_t count = (size_t)member->count;

  if (utilities_is_sequence(member)) {
    count = utilities_sequence_capacity(walk, memory->conf);
    if (!memory_provide(memory, memory_pool(member), walk->place, count, size, &elements)) {
      return false;
    }
  }
  if (utilities_is_text(member)) {
    const size_t capacity = utilities_text_capacity(walk, memory->conf);

    for (size_t i = 0; i < count; ++i) {
      uint8_t * characters;

      if (!memory_provide(
            memory, memory_text_pool(member), memory_element(elements, i, size), capacity,
            memory_unit(member), &characters)) {
        return false;
      }
    }
  } else if (member->nested != NULL) {
    utilities_walk_enter(walk, elements, count);
  } else {
    /* numbers */
  }
  return true;
}

static bool memory_walk(memory_t * memory, const microros_type_members_t * type, uint8_t * message)
{
  utilities_walk_t walk;
  utilities_event_t event;

  utilities_walk_begin(&walk, type, message);
  do {
    event = utilities_walk_next(&walk);
    if (event == UTILITIES_MEMBER && !memory_of_member(memory, &walk)) {
      return false;
    }
  } while (event != UTILITIES_END);
  return true;
}

/* Returns the table of the type; NULL if the type or a rule is invalid. */
static const microros_type_members_t * memory_type(
  const rosidl_message_type_support_t * type_support, const micro_ros_utilities_memory_conf_t * conf)
{
  const microros_type_members_t * type = utilities_type(type_support);

  return type != NULL && utilities_rules_check(type, conf) ? type : NULL;
}

/*
 * Returns the size of the message, in an allocator or a buffer, starting at an aligned address; 0 on
 * failure. */
static memory_t memory_sized(
  const rosidl_message_type_support_t * type_support, const micro_ros_utilities_memory_conf_t * conf,
  memory_mode_t mode)
{
  const microros_type_members_t * type = memory_type(type_support, conf);
  memory_t memory = memory_begin(mode, conf);

  if (type == NULL || !memory_walk(&memory, type, NULL)) {
    memory.used = 0;
    memory.alignment = 1;
  }
  return memory;
}

size_t micro_ros_utilities_get_dynamic_size(
  const rosidl_message_type_support_t * type_support, const micro_ros_utilities_memory_conf_t conf)
{
  return memory_sized(type_support, &conf, MEMORY_COUNT).used;
}

/* Returns the size of a buffer of any alignment. */
static size_t memory_buffer_size(const memory_t * memory)
{
  return memory->used + (memory->alignment - 1u);
}

size_t micro_ros_utilities_get_static_size(
  const rosidl_message_type_support_t * type_support, const micro_ros_utilities_memory_conf_t conf)
{
  const memory_t memory = memory_sized(type_support, &conf, MEMORY_MEASURE);

  return memory_buffer_size(&memory);
}

/* Frees the memory of the string or sequence at `place`. */
static void memory_free(
  const rcutils_allocator_t * allocator, const microros_pool_t * pool, const uint8_t * place)
{
  microros_type_sequence_t sequence;

  (void)memcpy(&sequence, place, sizeof(sequence));
  if (allocator->deallocate == microros_arena_deallocate) {
    microros_memory_give_back(pool, sequence.data);
  } else if (sequence.data != NULL) {
    allocator->deallocate(sequence.data, allocator->state);
  } else {
    /* nothing allocated */
  }
}

/* Returns the elements of the current member: in the message, or in the memory of the sequence. */
static uint8_t * memory_elements(const utilities_walk_t * walk, size_t * count)
{
  *count = (size_t)walk->member->count;
  if (utilities_is_sequence(walk->member)) {
    microros_type_sequence_t sequence;

    (void)memcpy(&sequence, walk->place, sizeof(sequence));
    *count = sequence.data == NULL ? 0u : sequence.capacity;
    return sequence.data;
  }
  return walk->place;
}

/* Frees the strings of the member that ends, then its elements. */
static void memory_free_member(const rcutils_allocator_t * allocator, const utilities_walk_t * walk)
{
  const size_t size = utilities_element_size(walk->member);
  size_t count;
  const uint8_t * elements = memory_elements(walk, &count);

  if (utilities_is_text(walk->member)) {
    for (size_t i = 0; i < count; ++i) {
      memory_free(allocator, memory_text_pool(walk->member), &elements[i * size]);
    }
  }
  if (utilities_is_sequence(walk->member)) {
    memory_free(allocator, memory_pool(walk->member), walk->place);
  }
}

static void memory_free_all(
  const rcutils_allocator_t * allocator, const microros_type_members_t * type, uint8_t * message)
{
  utilities_walk_t walk;
  utilities_event_t event;

  utilities_walk_begin(&walk, type, message);
  do {
    event = utilities_walk_next(&walk);
    if (event == UTILITIES_MEMBER && walk.member->nested != NULL) {
      size_t count;
      uint8_t * elements = memory_elements(&walk, &count);

      utilities_walk_enter(&walk, elements, count);
    } else if (event == UTILITIES_AFTER) {
      memory_free_member(allocator, &walk);
    } else {
      /* nothing to enter, or the end */
    }
  } while (event != UTILITIES_END);
  (void)memset(message, 0, (size_t)type->size);
}

/* Returns the allocator of the configuration; false, with the error set, if it is invalid. */
static bool memory_allocator(const micro_ros_utilities_memory_conf_t * conf, rcutils_allocator_t * allocator)
{
  *allocator = conf->allocator == NULL ? rcutils_get_default_allocator() : *conf->allocator;
  if (allocator->allocate == NULL || allocator->deallocate == NULL) {
    (void)microros_error_refuse(0, "conf.allocator");
    return false;
  }
  return true;
}

static bool memory_is_message(const void * ros_msg)
{
  if (ros_msg == NULL) {
    (void)microros_error_refuse(0, "ros_msg");
  }
  return ros_msg != NULL;
}

bool micro_ros_utilities_create_message_memory(
  const rosidl_message_type_support_t * type_support, void * ros_msg,
  const micro_ros_utilities_memory_conf_t conf)
{
  const microros_type_members_t * type = memory_type(type_support, &conf);
  memory_t memory = memory_begin(MEMORY_ALLOCATE, &conf);

  if (type == NULL || !memory_is_message(ros_msg) || !memory_allocator(&conf, &memory.allocator)) {
    return false;
  }
  (void)memset(ros_msg, 0, (size_t)type->size);
  if (!memory_walk(&memory, type, ros_msg)) {
    memory_free_all(&memory.allocator, type, ros_msg);
    return false;
  }
  return true;
}

bool micro_ros_utilities_destroy_message_memory(
  const rosidl_message_type_support_t * type_support, void * ros_msg,
  const micro_ros_utilities_memory_conf_t conf)
{
  const microros_type_members_t * type = utilities_type(type_support);
  rcutils_allocator_t allocator;

  if (type == NULL || !memory_is_message(ros_msg) || !memory_allocator(&conf, &allocator)) {
    return false;
  }
  memory_free_all(&allocator, type, ros_msg);
  return true;
}

bool micro_ros_utilities_create_static_message_memory(
  const rosidl_message_type_support_t * type_support, void * ros_msg,
  const micro_ros_utilities_memory_conf_t conf, uint8_t * buffer, size_t buffer_len)
{
  const microros_type_members_t * type = memory_type(type_support, &conf);
  memory_t memory = memory_begin(MEMORY_MEASURE, &conf);
  size_t size;

  if (type == NULL || !memory_is_message(ros_msg) || !memory_walk(&memory, type, NULL)) {
    return false;
  }
  size = memory_buffer_size(&memory);
  if (buffer == NULL && size != 0u) {
    (void)microros_error_refuse(0, "buffer");
    return false;
  }
  if (size > buffer_len) {
    microros_error_set(microros_error_memory_buffer, NULL, NULL, (uint32_t)buffer_len, (uint32_t)size);
    return false;
  }
  (void)memset(ros_msg, 0, (size_t)type->size);
  if (size != 0u) {
    const size_t address = (size_t)(uintptr_t)buffer;

    (void)memset(buffer, 0, size);
    memory.buffer = &buffer[memory_aligned(address, memory.alignment) - address];
  }
  memory.mode = MEMORY_PLACE;
  memory.used = 0;
  return memory_walk(&memory, type, ros_msg);
}
