/* A supervisor that expects nothing of its inputs; the tests plant faults in it, line by line. */
#include "firmware.h"

struct inputs in;
struct outputs out;

static const uint8_t weight[8] = { 0, 1, 1, 1, 1, 1, 2, 2 };

void sup_init(void)
{
  out.cmd = 0U;
}

static int usable(double x)
{
  return x >= -1.0 && x <= 1.0;
}

static double heading(double yaw)
{
  if (!(yaw >= -720.0 && yaw <= 720.0)) {
    return 0.0;
  }
  while (yaw >= 180.0) {
    yaw -= 360.0;
  }
  while (yaw < -180.0) {
    yaw += 360.0;
  }
  return yaw;
}

static int ones(uint32_t mask)
{
  return mask == 0U ? 0 : (int)(mask & 1U) + ones(mask >> 1);
}

void sup_step(void)
{
  uint32_t age = in.now - in.heartbeat;
  uint32_t share = in.charge >= 1.0 && in.charge <= 100.0 ? 1000U / (uint32_t)in.charge : 0U;
  int32_t scaled = in.degrees > -1000.0 && in.degrees < 1000.0 ? (int32_t)in.degrees * 1000 : 0;
  uint8_t cmd = in.cmd < 8U ? in.cmd : 7U;
  out.angle = heading(in.yaw);
  out.v = usable(in.y) ? in.y * 0.5 : 0.0;
  out.cmd = (uint8_t)(weight[cmd] == 2U ? 7U : cmd);
  out.mask = (uint8_t)((ones(in.mask) > 2) | ((share > 50U) << 1) | ((scaled > 60000) << 2));
  out.give = age > 120U;
  out.emergency = !usable(in.y) || in.cmd > 7U;
}
