/* SPDX-License-Identifier: Apache-2.0 */
/* The system calls and calls of ROS 2 that the agent makes for each message, without what ctypes and Python's sockets
 * add to them.
 *
 * A part of the compiled core (hatch_build.py). calls.py does the same in Python, and says what each function does.
 */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

enum { LARGEST_DATAGRAM = 65535 };

/* What `rcl_take_serialized_message` fills: the first members of rcutils_uint8_array_t. */
typedef struct {
  const char * buffer;
  size_t length;
} serialized_t;

typedef int (*take_t)(const void * subscription, serialized_t * message, void * info, void * allocation);

typedef struct {
  PyObject_HEAD take_t take;
  const void * subscription;
  serialized_t * message;
} Taker;

typedef struct {
  PyObject_HEAD int descriptor;
  bool rung;        /* the descriptor was written to since the last call of `arm` */
  bool held;        /* ROS 2 may call */
  uint64_t arrived; /* samples since the last call of `arrived` */
} Bell;

static PyObject * receive(PyObject * module, PyObject * descriptor)
{
  static char datagram[LARGEST_DATAGRAM]; /* Python's interpreter lock is held all the time */
  long number = PyLong_AsLong(descriptor);
  ssize_t size;

  (void)module;
  if (number == -1 && PyErr_Occurred() != NULL) {
    return NULL;
  }
  size = recv((int)number, datagram, sizeof datagram, MSG_DONTWAIT);
  if (size >= 0) {
    return PyBytes_FromStringAndSize(datagram, size);
  }
  if (errno == EAGAIN || errno == EWOULDBLOCK) {
    Py_RETURN_NONE;
  }
  return PyErr_SetFromErrno(PyExc_OSError);
}

static int taker_init(Taker * self, PyObject * arguments, PyObject * named)
{
  unsigned long long take = 0;
  unsigned long long subscription = 0;
  unsigned long long message = 0;

  (void)named;
  if (PyArg_ParseTuple(arguments, "KKK", &take, &subscription, &message) == 0) {
    return -1;
  }
  self->take = (take_t)(uintptr_t)take;
  self->subscription = (const void *)(uintptr_t)subscription;
  self->message = (serialized_t *)(uintptr_t)message;
  return 0;
}

static PyObject * taker_take(Taker * self, PyObject * nothing)
{
  int result = self->take(self->subscription, self->message, NULL, NULL);

  (void)nothing;
  if (result != 0) {
    return PyLong_FromLong(result);
  }
  return PyBytes_FromStringAndSize(self->message->buffer, (Py_ssize_t)self->message->length);
}

/* The callback of ROS 2, in one of its threads and without Python's interpreter lock. */
static void bell_ring(const void * user_data, size_t count)
{
  Bell * self = (Bell *)(uintptr_t)user_data;

  (void)__atomic_add_fetch(&self->arrived, count, __ATOMIC_SEQ_CST);
  if (!__atomic_exchange_n(&self->rung, true, __ATOMIC_SEQ_CST)) {
    (void)eventfd_write(self->descriptor, 1); /* fails only if it is readable anyway */
  }
}

static int bell_init(Bell * self, PyObject * arguments, PyObject * named)
{
  (void)named;
  return PyArg_ParseTuple(arguments, "i", &self->descriptor) != 0 ? 0 : -1;
}

static PyObject * bell_call(Bell * self, PyObject * nothing)
{
  PyObject * call =
    Py_BuildValue("(KK)", (unsigned long long)(uintptr_t)&bell_ring, (unsigned long long)(uintptr_t)self);

  (void)nothing;
  if (call != NULL && !self->held) {
    self->held = true;
    Py_INCREF(self); /* also when the interpreter ends before ROS 2 does */
  }
  return call;
}

static PyObject * bell_release(Bell * self, PyObject * nothing)
{
  (void)nothing;
  if (self->held) {
    self->held = false;
    Py_DECREF(self); /* the caller has another reference */
  }
  Py_RETURN_NONE;
}

static PyObject * bell_arm(Bell * self, PyObject * nothing)
{
  (void)nothing;
  return PyBool_FromLong(__atomic_exchange_n(&self->rung, false, __ATOMIC_SEQ_CST) ? 1 : 0);
}

static PyObject * bell_arrived(Bell * self, PyObject * nothing)
{
  (void)nothing;
  return PyLong_FromUnsignedLongLong(__atomic_exchange_n(&self->arrived, 0U, __ATOMIC_SEQ_CST));
}

static PyMethodDef taker_methods[] = {
  {"take", (PyCFunction)taker_take, METH_NOARGS, NULL},
  {NULL, NULL, 0, NULL},
};

static PyMethodDef bell_methods[] = {
  {"call", (PyCFunction)bell_call, METH_NOARGS, NULL},
  {"release", (PyCFunction)bell_release, METH_NOARGS, NULL},
  {"arm", (PyCFunction)bell_arm, METH_NOARGS, NULL},
  {"arrived", (PyCFunction)bell_arrived, METH_NOARGS, NULL},
  {NULL, NULL, 0, NULL},
};

static PyMethodDef functions[] = {
  {"receive", receive, METH_O, NULL},
  {NULL, NULL, 0, NULL},
};

static PyTypeObject taker_type = {
  PyVarObject_HEAD_INIT(NULL, 0).tp_name = "microros_gen.agent.quick_calls.Taker",
  .tp_basicsize = sizeof(Taker),
  .tp_flags = Py_TPFLAGS_DEFAULT,
  .tp_methods = taker_methods,
  .tp_init = (initproc)taker_init,
  .tp_new = PyType_GenericNew,
};

static PyTypeObject bell_type = {
  PyVarObject_HEAD_INIT(NULL, 0).tp_name = "microros_gen.agent.quick_calls.Bell",
  .tp_basicsize = sizeof(Bell),
  .tp_flags = Py_TPFLAGS_DEFAULT,
  .tp_methods = bell_methods,
  .tp_init = (initproc)bell_init,
  .tp_new = PyType_GenericNew,
};

static struct PyModuleDef definition = {
  PyModuleDef_HEAD_INIT,
  .m_name = "quick_calls",
  .m_size = -1,
  .m_methods = functions,
};

PyMODINIT_FUNC PyInit_quick_calls(void);

PyMODINIT_FUNC PyInit_quick_calls(void)
{
  PyObject * module = PyModule_Create(&definition);

  if (
    module != NULL &&
    (PyModule_AddType(module, &taker_type) != 0 || PyModule_AddType(module, &bell_type) != 0)) {
    Py_CLEAR(module);
  }
  return module;
}
