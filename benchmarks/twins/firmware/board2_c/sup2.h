/* Supervisor of Board 2.  Call sup2_init() at power-up, then sup2_task() every 20 ms. */
#ifndef SUP2_H
#define SUP2_H

#include <stdbool.h>
#include <stdint.h>

enum level { OK, DEGRADED, CRITICAL };
enum command { NORMAL, ROTATE_180, GO_LEFT, GO_RIGHT, AVOID_RIGHT, AVOID_LEFT, STOP, ESTOP };
enum decision { READY, HALT, TO_S1, TO_S2, TO_S3, DEG_MOVE, DEG_HALT };
enum safety { SAFE, SAFE_DEGRADED, SAFE_CRITICAL };

/* What the drivers hold; the interrupt routines write it. */
struct sensors {
    uint32_t now;
    uint32_t b1_alive;          /* counts the executions of Board 1 */
    uint32_t b1_frame_at;
    uint32_t imu_at;
    uint32_t ble_at;
    double yaw, gz;
    double x, y;
    bool btn1, btn2;
    double dist[3];
    double rpm[4];
    uint8_t b1_critical, b1_degraded;
};

struct actuators {
    enum decision decision;
    enum command command;       /* for Board 1 */
    enum command cmd;           /* for our own motion */
    enum command action;
    double v, omega;
    double left_rpm, right_rpm;
    uint8_t critical_mask, degraded_mask;
    enum level b1_sup, esp, imu, rx;
    enum safety safety;
    bool b2_emergency, b1_requests_switch, b1_emergency;
    bool authorized;
    bool backward;
    bool emergency_stop;
    bool consistent;
    bool deg_b1;
    bool stop_pin;
    bool sends;
};

extern struct sensors sensors;
extern struct actuators out;

void sup2_init(void);
void sup2_task(void);

#endif
