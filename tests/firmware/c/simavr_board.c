/* SPDX-License-Identifier: Apache-2.0 */
/* Runs an image on a simulated AVR whose first UART is a pseudo-terminal; prints the terminal's name. At its end, and when it
 * gets SIGUSR1, it prints the least value of the stack pointer: `stack BYTES`.
 *
 * simavr_board MCU CLOCK_HZ IMAGE.elf */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

enum { BAUD = 115200, BITS_OF_A_BYTE = 10 };

static volatile sig_atomic_t is_asked;
static volatile sig_atomic_t is_ending;
static int line = -1;
static bool takes_input = true;

static void on_signal(int number)
{
  if (number == SIGUSR1) {
    is_asked = 1;
  } else {
    is_ending = 1;
  }
}

static void on_output(struct avr_irq_t * irq, uint32_t value, void * context)
{
  const uint8_t byte = (uint8_t)value;

  (void)irq;
  (void)context;
  if (write(line, &byte, 1) != 1 && errno != EAGAIN) {
    is_ending = 1;
  }
}

static void on_flow(struct avr_irq_t * irq, uint32_t value, void * context)
{
  (void)irq;
  (void)value;
  takes_input = context != NULL;
}

static void open_line(void)
{
  struct termios settings;
  int other;

  line = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  if (line < 0 || grantpt(line) != 0 || unlockpt(line) != 0) {
    perror("pseudo-terminal");
    exit(1);
  }
  other = open(ptsname(line), O_RDWR | O_NOCTTY); /* kept open: no hang-up while nobody else has it */
  if (other < 0 || tcgetattr(other, &settings) != 0) {
    perror("pseudo-terminal");
    exit(1);
  }
  cfmakeraw(&settings);
  (void)tcsetattr(other, TCSANOW, &settings);
}

static void connect_line(avr_t * avr)
{
  uint32_t flags = 0;
  static int on = 1;

  avr_ioctl(avr, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
  flags &= ~(uint32_t)AVR_UART_FLAG_STDIO;
  avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  avr_irq_register_notify(
    avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), on_output, NULL);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUT_XON), on_flow, &on);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUT_XOFF), on_flow, NULL);
}

/* The stack pointer is written in two halves, the upper one first, with interrupts off: in between it means nothing. */
static bool is_halfway(const avr_t * avr, bool was)
{
  const uint16_t code = (uint16_t)(avr->flash[avr->pc] | avr->flash[avr->pc + 1u] << 8);
  const uint16_t target = (uint16_t)((code >> 5 & 0x30) | (code & 0x0f));

  if ((code & 0xf800) != 0xb800) { /* OUT */
    return was;
  }
  return target == 0x3e || (was && target != 0x3d);
}

static void report(const avr_t * avr, uint16_t lowest)
{
  printf("stack %u\n", (unsigned)(avr->ramend - lowest));
  (void)fflush(stdout);
}

int main(int count, char ** arguments)
{
  elf_firmware_t image = {0};
  avr_irq_t * input;
  avr_t * avr;
  uint16_t lowest = UINT16_MAX;
  int state = cpu_Running;
  bool halfway = false;
  avr_cycle_count_t next_input = 0;
  uint8_t byte;

  if (count != 4 || elf_read_firmware(arguments[3], &image) != 0) {
    (void)fprintf(stderr, "simavr_board MCU CLOCK_HZ IMAGE.elf\n");
    return 2;
  }
  avr = avr_make_mcu_by_name(arguments[1]);
  if (avr == NULL) {
    return 2;
  }
  avr_init(avr);
  avr->frequency = (uint32_t)strtoul(arguments[2], NULL, 10);
  avr_load_firmware(avr, &image);
  open_line();
  connect_line(avr);
  input = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
  (void)signal(SIGUSR1, on_signal);
  (void)signal(SIGTERM, on_signal);
  printf("line %s\n", ptsname(line));
  (void)fflush(stdout);
  while (state != cpu_Done && state != cpu_Crashed && !is_ending) {
    uint16_t pointer;

    halfway = is_halfway(avr, halfway);
    state = avr_run(avr);
    pointer = (uint16_t)(avr->data[R_SPL] | avr->data[R_SPH] << 8);
    lowest = pointer != 0u && !halfway && pointer < lowest ? pointer : lowest;
    if (avr->cycle >= next_input && takes_input && read(line, &byte, 1) == 1) {
      avr_raise_irq(input, byte);
      next_input = avr->cycle + (avr_cycle_count_t)avr->frequency * BITS_OF_A_BYTE / BAUD; /* as fast as the line */
    }
    if (is_asked) {
      is_asked = 0;
      report(avr, lowest);
    }
  }
  report(avr, lowest);
  return state == cpu_Crashed ? 3 : 0;
}
