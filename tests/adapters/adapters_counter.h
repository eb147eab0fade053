/* A supervisor that counts its steps and repeats its inputs, with traps. */
#ifndef ADAPTERS_COUNTER_H
#define ADAPTERS_COUNTER_H

#include <stdbool.h>
#include <stdint.h>

enum action { ACTION_NORMAL = 10, ACTION_STOP = 20, ACTION_ESTOP };

struct inputs {
  double temperature;
  struct {
    double axis[2];
    bool button;
    enum action action : 6;
  } panel;
  float charge;
  uint16_t decipercent;
};

struct outputs {
  uint8_t count;
  double v[2];
  _Bool give;
  enum action action;
  double process;
};

extern struct inputs *const in;
extern struct outputs out;

void counter_init(void);
void counter_step(struct inputs *given);

#endif
