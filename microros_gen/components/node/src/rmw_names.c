/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_names.h"

#include "microros/text.h"

enum { PARTS = 4 };

rmw_name_t rmw_name_of_namespace(const char * namespace_)
{
  const rmw_name_t name = {{namespace_[0] == '/' ? "" : "/", namespace_, "", ""}};

  return name;
}

rmw_name_t rmw_name_of_topic(const char * topic, const char * node, const char * namespace_)
{
  rmw_name_t name = {{topic, "", "", ""}};

  if (topic[0] != '/') {
    name.part[0] = namespace_[1] == '\0' ? "" : namespace_;
    name.part[1] = "/";
    if (topic[0] == '~') {
      name.part[2] = node;
      name.part[3] = topic + 1;
    } else {
      name.part[2] = topic;
    }
  }
  return name;
}

bool rmw_name_equals(const rmw_name_t * name, const char * text)
{
  for (size_t i = 0; i < PARTS; ++i) {
    for (const char * at = name->part[i]; *at != '\0'; ++at, ++text) {
      if (*at != *text) {
        return false;
      }
    }
  }
  return *text == '\0';
}

size_t rmw_name_size(const rmw_name_t * name)
{
  size_t size = 0;

  for (size_t i = 0; i < PARTS; ++i) {
    size += microros_text_size(name->part[i]);
  }
  return size;
}

void rmw_name_copy(const rmw_name_t * name, char * buffer)
{
  for (size_t i = 0; i < PARTS; ++i) {
    for (const char * at = name->part[i]; *at != '\0'; ++at) {
      *buffer++ = *at;
    }
  }
  *buffer = '\0';
}
