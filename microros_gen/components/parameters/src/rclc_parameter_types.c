/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The types of the six services, whose messages are the server: they decode into the store and encode from it. On the
 * wire the name of a service is enough; the names of its messages occur only in error texts.
 */
#include "microros/error.h"
#include "microros/rclc_parameter_reply.h"
#include "microros/rclc_parameters.h"
#include "microros/service_type.h"

static const microros_message_type_t get_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::GetParameters_Request_"),
  .max_encoded_size = rcl_interfaces__srv__GetParameters_Request__MAX_ENCODED_SIZE,
  .decode = rclc_parameter_decode_names};
static const microros_message_type_t get_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::GetParameters_Response_"),
  .max_encoded_size = rcl_interfaces__srv__GetParameters_Response__MAX_ENCODED_SIZE,
  .encode = rclc_parameter_reply_values};
static const microros_service_type_t get_service = {
  .dds_type_name = MICROROS_FLASH_NAME("rcl_interfaces::srv::dds_::GetParameters_"),
  .request = &get_request,
  .response = &get_response};
const rosidl_service_type_support_t rclc_parameter_get_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &get_service};

static const microros_message_type_t get_types_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::GetParameterTypes_Request_"),
  .max_encoded_size = rcl_interfaces__srv__GetParameterTypes_Request__MAX_ENCODED_SIZE,
  .decode = rclc_parameter_decode_names};
static const microros_message_type_t get_types_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::GetParameterTypes_Response_"),
  .max_encoded_size = rcl_interfaces__srv__GetParameterTypes_Response__MAX_ENCODED_SIZE,
  .encode = rclc_parameter_reply_types};
static const microros_service_type_t get_types_service = {
  .dds_type_name = MICROROS_FLASH_NAME("rcl_interfaces::srv::dds_::GetParameterTypes_"),
  .request = &get_types_request,
  .response = &get_types_response};
const rosidl_service_type_support_t rclc_parameter_get_types_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &get_types_service};

static const microros_message_type_t set_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::SetParameters_Request_"),
  .max_encoded_size = rcl_interfaces__srv__SetParameters_Request__MAX_ENCODED_SIZE,
  .decode = rclc_parameter_decode_parameters};
static const microros_message_type_t set_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::SetParameters_Response_"),
  .max_encoded_size = rcl_interfaces__srv__SetParameters_Response__MAX_ENCODED_SIZE,
  .encode = rclc_parameter_reply_results};
static const microros_service_type_t set_service = {
  .dds_type_name = MICROROS_FLASH_NAME("rcl_interfaces::srv::dds_::SetParameters_"),
  .request = &set_request,
  .response = &set_response};
const rosidl_service_type_support_t rclc_parameter_set_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &set_service};

static const microros_message_type_t set_atomically_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::SetParametersAtomically_Request_"),
  .max_encoded_size = rcl_interfaces__srv__SetParametersAtomically_Request__MAX_ENCODED_SIZE,
  .decode = rclc_parameter_decode_parameters};
static const microros_message_type_t set_atomically_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::SetParametersAtomically_Response_"),
  .max_encoded_size = rcl_interfaces__srv__SetParametersAtomically_Response__MAX_ENCODED_SIZE,
  .encode = rclc_parameter_reply_result};
static const microros_service_type_t set_atomically_service = {
  .dds_type_name = MICROROS_FLASH_NAME("rcl_interfaces::srv::dds_::SetParametersAtomically_"),
  .request = &set_atomically_request,
  .response = &set_atomically_response};
const rosidl_service_type_support_t rclc_parameter_set_atomically_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &set_atomically_service};

static const microros_message_type_t list_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::ListParameters_Request_"),
  .max_encoded_size = rcl_interfaces__srv__ListParameters_Request__MAX_ENCODED_SIZE,
  .decode = rclc_parameter_decode_list};
static const microros_message_type_t list_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::ListParameters_Response_"),
  .max_encoded_size = rcl_interfaces__srv__ListParameters_Response__MAX_ENCODED_SIZE,
  .encode = rclc_parameter_reply_list};
static const microros_service_type_t list_service = {
  .dds_type_name = MICROROS_FLASH_NAME("rcl_interfaces::srv::dds_::ListParameters_"),
  .request = &list_request,
  .response = &list_response};
const rosidl_service_type_support_t rclc_parameter_list_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &list_service};

static const microros_message_type_t describe_request = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::DescribeParameters_Request_"),
  .max_encoded_size = rcl_interfaces__srv__DescribeParameters_Request__MAX_ENCODED_SIZE,
  .decode = rclc_parameter_decode_names};
static const microros_message_type_t describe_response = {
  .dds_type_name = MICROROS_ERROR_TYPE("rcl_interfaces::srv::dds_::DescribeParameters_Response_"),
  .max_encoded_size = rcl_interfaces__srv__DescribeParameters_Response__MAX_ENCODED_SIZE,
  .encode = rclc_parameter_reply_descriptors};
static const microros_service_type_t describe_service = {
  .dds_type_name = MICROROS_FLASH_NAME("rcl_interfaces::srv::dds_::DescribeParameters_"),
  .request = &describe_request,
  .response = &describe_response};
const rosidl_service_type_support_t rclc_parameter_describe_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &describe_service};
