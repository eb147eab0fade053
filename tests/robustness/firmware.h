#include <stdbool.h>
#include <stdint.h>

struct inputs {
  uint32_t now, heartbeat;
  double degrees, charge, yaw, y;
  uint8_t cmd;
  uint32_t mask;
};

struct outputs {
  double v, angle;
  uint8_t cmd, mask;
  bool give, emergency;
};

extern struct inputs in;
extern struct outputs out;

void sup_init(void);
void sup_step(void);
