// SPDX-License-Identifier: Apache-2.0
// The peer's side: the callbacks behind the handle of rosidl_typesupport_fastrtps_c, called as rmw_fastrtps_cpp
// calls them (a stream object for each message, encapsulation before the body), and with the object made already.
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <rosidl_typesupport_fastrtps_cpp/message_type_support.h>

#include "codec.h"

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::CdrVersion;
using eprosima::fastcdr::EncodingAlgorithmFlag;
using eprosima::fastcdr::FastBuffer;

namespace
{
constexpr std::size_t kEncapsulation = 4;
char with_encapsulation[CODEC_BUFFER_SIZE];

const message_type_support_callbacks_t * callbacks(const rosidl_message_type_support_t * handle)
{
  return static_cast<const message_type_support_callbacks_t *>(handle->data);
}

// Over the body alone: positions count from its first byte, as behind an encapsulation.
Cdr & stream()
{
  static FastBuffer buffer(reinterpret_cast<char *>(codec_buffer), sizeof(codec_buffer));
  static Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, CdrVersion::XCDRv1);
  return cdr;
}
} // namespace

uint32_t codec_encode(const rosidl_message_type_support_t * handle, const void * message)
{
  FastBuffer buffer(with_encapsulation, sizeof(with_encapsulation));
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, CdrVersion::XCDRv1);
  cdr.set_encoding_flag(EncodingAlgorithmFlag::PLAIN_CDR);
  cdr.serialize_encapsulation();
  const bool done = callbacks(handle)->cdr_serialize(message, cdr);
  return done ? static_cast<uint32_t>(cdr.get_serialized_data_length() - kEncapsulation) : 0;
}

bool codec_decode(const rosidl_message_type_support_t * handle, uint32_t size, void * message)
{
  FastBuffer buffer(with_encapsulation, size + kEncapsulation);
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN);
  cdr.read_encapsulation();
  return callbacks(handle)->cdr_deserialize(cdr, message);
}

uint32_t codec_encode_again(const rosidl_message_type_support_t * handle, const void * message)
{
  Cdr & cdr = stream();
  cdr.reset();
  cdr.set_encoding_flag(EncodingAlgorithmFlag::PLAIN_CDR);
  return callbacks(handle)->cdr_serialize(message, cdr)
           ? static_cast<uint32_t>(cdr.get_serialized_data_length())
           : 0;
}

bool codec_decode_again(const rosidl_message_type_support_t * handle, uint32_t, void * message)
{
  Cdr & cdr = stream();
  cdr.reset();
  return callbacks(handle)->cdr_deserialize(cdr, message);
}
