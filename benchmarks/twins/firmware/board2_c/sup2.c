/* Supervisor of Board 2: obstacles, monitors, who drives, motion, coherence, motors. */
#include "sup2.h"

#include <math.h>
#include <string.h>

#define STEPS(ms) ((ms) / 20)

struct sensors sensors;
struct actuators out;

/* The inputs of this step */
static struct {
    struct sensors s;
    uint32_t b1_alive_at;       /* when the counter of Board 1 last changed */
    uint32_t alive;
} in;

/* ---- obstacles while Board 1 is healthy ---- */

struct pair {
    int fallen;                 /* waits for the neighbour */
    int steps;                  /* since the fall */
};

static struct {
    bool stop;
    bool stopped;               /* the emergency was told, its end not yet */
    bool close[3];
    bool detected[3];
    struct pair pair[4];
    enum decision decision;
    double target;
    int straight;
} obst;

static double angle_error(double yaw, double target)
{
    double e = fmod(target - yaw + 180.0, 360.0);
    return (e < 0.0 ? e + 360.0 : e) - 180.0;
}

static void decide(enum decision d)
{
    obst.decision = d;
    if (d == TO_S1) {
        obst.target = in.s.yaw - 45.0;
        if (obst.target < 0.0)
            obst.target += 360.0;
    } else if (d == TO_S3) {
        obst.target = in.s.yaw + 45.0;
        if (obst.target > 360.0)
            obst.target -= 360.0;
    } else if (d == TO_S2) {
        obst.straight = 0;
    }
}

/* One execution of the decision; event is a decision to take, READY for "safe", -1 for none. */
static void decisions(int event, bool degraded_before)
{
    bool over;

    switch (obst.decision) {
    case READY:
        if (event > 0)
            decide((enum decision)event);
        break;
    case HALT:
        if (event == READY)
            decide(READY);
        break;
    default:
        if (event == HALT) {
            decide(HALT);
            break;
        }
        if (obst.decision == TO_S2)
            over = obst.straight >= STEPS(500);
        else if (obst.decision == TO_S1)
            over = angle_error(in.s.yaw, obst.target) >= 0.0;
        else
            over = angle_error(in.s.yaw, obst.target) <= 0.0;
        if (over || degraded_before)
            decide(READY);
        break;
    }
}

static void pairs(int fall, bool degraded_before)
{
    static const struct {
        int fall, neighbour;
        enum decision move;
    } of[4] = {
        {0, 1, TO_S1},
        {1, 0, TO_S2},
        {1, 2, TO_S2},
        {2, 1, TO_S3},
    };
    int i;

    for (i = 0; i < 4; i++) {
        struct pair *p = &obst.pair[i];

        if (!p->fallen) {
            if (fall == of[i].fall) {
                p->fallen = 1;
                p->steps = 0;
            }
        } else if (p->steps >= STEPS(3000)) {
            p->fallen = 0;
        } else if (obst.detected[of[i].neighbour]) {
            decisions(of[i].move, degraded_before);
            p->fallen = 0;
        }
    }
}

static bool within(double limit)
{
    return in.s.dist[0] <= limit || in.s.dist[1] <= limit || in.s.dist[2] <= limit;
}

static void obstacles(bool degraded_before)
{
    int i;

    for (i = 0; i < 4; i++)
        obst.pair[i].steps++;
    obst.straight++;

    if (obst.stop && !obst.stopped) {
        decisions(HALT, degraded_before);
        obst.stopped = true;
    } else if (!obst.stop && obst.stopped) {
        decisions(READY, degraded_before);
        obst.stopped = false;
    }
    obst.stop = within(70.0);

    for (i = 0; i < 3; i++) {
        if (!obst.stop) {
            if (obst.close[i]) {
                obst.detected[i] = true;
            } else if (obst.detected[i]) {
                obst.detected[i] = false;
                pairs(i, degraded_before);
            }
        }
        obst.close[i] = in.s.dist[i] > 100.0 && in.s.dist[i] <= 300.0;
    }
    pairs(-1, degraded_before);
    decisions(-1, degraded_before);
}

/* ---- selection ---- */

static bool degraded_started;

static void selection(void)
{
    static const enum command command_of[] = {NORMAL, ESTOP, GO_LEFT, NORMAL, GO_RIGHT, NORMAL, ESTOP};
    bool before = out.deg_b1;
    enum decision degraded = DEG_MOVE;

    out.deg_b1 = in.s.b1_degraded != 0 || in.s.b1_critical != 0 || out.authorized;
    obstacles(before);
    if (degraded_started && within(300.0))
        degraded = DEG_HALT;
    degraded_started = true;
    out.decision = out.deg_b1 ? degraded : obst.decision;
    out.command = command_of[out.decision];
}

/* ---- monitors ---- */

struct monitor {
    enum level level;
    bool started;
    bool slow;
    bool has_stamp;
    uint32_t stamp;             /* of the gaps */
    uint32_t gap[10];
    int gaps, next;
    uint32_t seen;              /* of the age */
    bool has_seen, old;
    int fine;                   /* steps without slow updates since the state was entered */
};

static struct monitor mon_sup, mon_esp, mon_imu, mon_rx;

static bool too_old(struct monitor *m, uint32_t stamp, uint32_t limit)
{
    if (!m->has_seen || stamp != m->seen) {
        m->seen = stamp;
        m->has_seen = true;
        m->old = false;
    }
    if (in.s.now - stamp > limit)
        m->old = true;
    return m->old;
}

static bool slow_updates(struct monitor *m, uint32_t stamp, uint32_t mean)
{
    uint32_t sum = 0;
    int i;

    if (!m->has_stamp) {
        m->has_stamp = true;
        m->stamp = stamp;
    }
    if (stamp != m->stamp) {
        m->gap[m->next] = stamp - m->stamp;
        m->next = (m->next + 1) % 10;
        if (m->gaps < 10)
            m->gaps++;
        m->stamp = stamp;
    }
    for (i = 0; i < m->gaps; i++)
        sum += m->gap[i];
    return sum > (uint32_t)m->gaps * mean;
}

static enum level monitor(struct monitor *m, uint32_t stamp, uint32_t mean, uint32_t limit, int recovery)
{
    bool old = too_old(m, stamp, limit);
    int enter = -1;

    if (m->slow)
        m->fine = 0;
    if (!m->started) {
        m->started = true;
        enter = OK;
    } else if (m->level == CRITICAL) {
        if (m->fine > recovery)
            enter = OK;
    } else if (m->level == OK && m->slow) {
        enter = DEGRADED;
    } else if (m->level == DEGRADED && m->fine > STEPS(1000)) {
        enter = OK;
    } else if (old) {
        enter = CRITICAL;
    }
    if (enter >= 0) {
        m->level = (enum level)enter;
        m->fine = 0;
    } else {
        m->slow = slow_updates(m, stamp, mean);
    }
    m->fine = m->slow ? 0 : m->fine + 1;
    return m->level;
}

static void monitors(void)
{
    out.b1_sup = monitor(&mon_sup, in.b1_alive_at, 60, 150, STEPS(2000));
    out.esp = monitor(&mon_esp, in.s.ble_at, 40, 120, STEPS(1000));
    out.imu = monitor(&mon_imu, in.s.imu_at, 100, 200, STEPS(1000));
    out.rx = monitor(&mon_rx, in.s.b1_frame_at, 40, 120, STEPS(1000));
}

static uint8_t mask(enum level level)
{
    uint8_t bits = 0;

    if (out.esp == level)
        bits |= 0x01;
    if (out.imu == level)
        bits |= 0x02;
    if (out.rx == level)
        bits |= 0x04;
    if (out.b1_sup == level)
        bits |= 0x08;
    return bits;
}

/* ---- who drives ---- */

static struct {
    bool started;
    int sound;                  /* steps without a reason to drive */
} authority;

static void check_board1(void)
{
    bool failed = out.b1_requests_switch || out.rx == CRITICAL || out.b1_sup == CRITICAL;

    if (!authority.started) {
        authority.started = true;
    } else if (!out.authorized) {
        if (failed) {
            out.authorized = true;
            authority.sound = 0;
        }
    } else if (!failed && authority.sound > STEPS(3000)) {
        out.authorized = false;
    }
    authority.sound = failed ? 0 : authority.sound + 1;
}

/* ---- driving: only while Board 2 is authorized ---- */

static bool driving_obstacles_started;

static struct {
    int state;
    int steps;                  /* since the last press */
    bool btn1, btn2;
} presses;

static enum { INITIAL, RUNNING, TURNING, BRAKING, STANDING } motion;
static struct {
    double v_user;
    bool invert;
    bool rotating;
    bool recover;
    bool stopped;
    double target, error;
    double limit;
    int braking;                /* steps since braking began */
    int still;                  /* steps at a standstill */
} mot;

static void safety(bool emergency)
{
    if (out.safety == SAFE)
        out.safety = SAFE_DEGRADED;
    else
        out.safety = emergency ? SAFE_CRITICAL : SAFE_DEGRADED;
}

static void own_command(void)
{
    out.cmd = driving_obstacles_started && within(300.0) ? ESTOP : NORMAL;
    driving_obstacles_started = true;
}

static void backward_toggle(void)
{
    bool rise1 = in.s.btn1 && !presses.btn1;
    bool rise2 = in.s.btn2 && !presses.btn2;
    bool centred = in.s.x == 0.0 && in.s.y == 0.0;
    int next = presses.state;

    presses.btn1 = in.s.btn1;
    presses.btn2 = in.s.btn2;
    presses.steps++;
    if (presses.state == 0) {
        if (rise1 && centred)
            next = 1;
    } else if (!centred) {
        next = 0;
    } else if (presses.state == 1 && rise1) {
        next = 2;
    } else if (presses.state == 2 && rise2) {
        next = 3;
    } else if (presses.state == 3 && rise2) {
        out.backward = !out.backward;
        next = 0;
    } else if (presses.steps >= STEPS(1000)) {
        next = 0;
    }
    if (next != presses.state) {
        presses.state = next;
        presses.steps = 0;
    }
}

static void update_user(void)
{
    mot.limit = out.safety == SAFE_CRITICAL ? 0.0 : 0.5;
    mot.v_user = in.s.y * mot.limit;
    if (mot.invert) {
        if (mot.v_user >= 0.0)
            mot.invert = false;
        else
            mot.v_user = -mot.v_user;
    }
}

static void enter_running(void)
{
    motion = RUNNING;
    out.action = NORMAL;
}

static void enter_braking(void)
{
    mot.rotating = false;
    mot.invert = false;
    mot.recover = false;
    mot.braking = 0;
    mot.still = 0;
    motion = BRAKING;
    out.action = ESTOP;
    out.v = 0.0;
    out.omega = 0.0;
    out.emergency_stop = true;
}

static void run_normally(void)
{
    if (in.s.y < -0.5 && !out.backward) {
        motion = TURNING;
        out.action = ROTATE_180;
        mot.rotating = true;
        mot.target = in.s.yaw + 180.0;
        if (mot.target > 360.0)
            mot.target -= 360.0;
        mot.error = angle_error(in.s.yaw, mot.target);
        return;
    }
    out.v = out.backward || in.s.y > 0.0 ? mot.v_user : 0.0;
    out.omega = in.s.x * mot.limit;
}

static void half_turn(void)
{
    if (fabs(mot.error) < 7.5) {
        if (mot.v_user < 0.0)
            mot.invert = true;
        mot.rotating = false;
        enter_running();
        return;
    }
    mot.error = angle_error(in.s.yaw, mot.target);
    if (fabs(mot.error) > 45.0)
        out.omega = mot.error < 0.0 ? mot.limit : -mot.limit;
}

static bool wheels_stand(void)
{
    int i;

    for (i = 0; i < 4; i++)
        if (!(fabs(in.s.rpm[i]) < 2.5))
            return false;
    return true;
}

static void move(void)
{
    bool critical = out.safety == SAFE_CRITICAL;

    mot.braking++;
    switch (motion) {
    case INITIAL:
        update_user();
        enter_running();
        break;
    case RUNNING:
    case TURNING:
        if ((out.cmd == ESTOP && mot.v_user > 0.0 && !mot.rotating) || critical) {
            enter_braking();
            break;
        }
        update_user();
        if (motion == RUNNING)
            run_normally();
        else
            half_turn();
        break;
    case BRAKING:
    case STANDING:
        if (!critical && mot.recover) {
            out.emergency_stop = false;
            update_user();
            enter_running();
        } else if (motion == BRAKING) {
            if (!mot.stopped)
                mot.still = 0;
            if ((out.rx == CRITICAL && mot.braking >= STEPS(2000)) || mot.still > STEPS(1000)) {
                motion = STANDING;
                out.action = STOP;
                mot.recover = true;
            } else {
                mot.stopped = wheels_stand();
            }
        }
        break;
    }
    mot.still = mot.stopped ? mot.still + 1 : 0;
}

/* ---- coherence of wheels and IMU ---- */

struct window {
    uint32_t start;
    double imu, wheels;         /* thousandths of a degree */
};

static struct {
    bool started;
    uint32_t wheels_at, imu_at;
    struct window fast, slow;
    bool hit[10];
    int next;
} coh;

static uint32_t gap(uint32_t stamp, uint32_t *last)
{
    uint32_t g = stamp - *last;

    *last = stamp;
    return g < 100 ? g : 0;
}

static void clear_window(struct window *w, uint32_t start)
{
    w->start = start;
    w->imu = 0.0;
    w->wheels = 0.0;
}

static void coherence(void)
{
    double left = (in.s.rpm[0] + in.s.rpm[2]) / 2.0, right = (in.s.rpm[1] + in.s.rpm[3]) / 2.0;
    double rate = 0.83 * 2.0 * 0.07 * 180.0 / (60.0 * 0.38) * (left - right);
    uint32_t wheels_gap, imu_gap;
    int i, hits = 0;

    out.consistent = true;
    if (!coh.started) {
        coh.started = true;
        coh.wheels_at = in.b1_alive_at;
        coh.imu_at = in.s.imu_at;
        clear_window(&coh.fast, in.s.imu_at);
        clear_window(&coh.slow, in.s.imu_at);
        return;
    }
    wheels_gap = gap(in.b1_alive_at, &coh.wheels_at);
    imu_gap = gap(in.s.imu_at, &coh.imu_at);
    coh.fast.wheels += rate * wheels_gap;
    coh.slow.wheels += rate * wheels_gap;
    coh.fast.imu += in.s.gz * imu_gap;
    coh.slow.imu += in.s.gz * imu_gap;
    if (in.s.imu_at - coh.fast.start >= 100) {
        coh.hit[coh.next] = fabs(coh.fast.imu) >= 1000.0 && fabs(coh.fast.imu - coh.fast.wheels) >= 1000.0;
        coh.next = (coh.next + 1) % 10;
        for (i = 0; i < 10; i++)
            hits += coh.hit[i];
        if (hits >= 8)
            out.consistent = false;
        clear_window(&coh.fast, in.s.imu_at);
    }
    if (in.s.imu_at - coh.slow.start >= 3000) {
        if (fabs(coh.slow.imu - coh.slow.wheels) >= 5000.0)
            out.consistent = false;
        clear_window(&coh.slow, in.s.imu_at);
    }
}

/* ---- motors ---- */

static struct {
    bool authorized;
    bool initialised;
} drive;

static double ramp(double last, double reference)
{
    double wanted = fmin(fmax(160.0 * reference, -80.0), 80.0);

    return fmin(fmax(wanted, last - 4.0), last + 4.0);
}

static void actuate(void)
{
    bool resumed = out.authorized && !drive.authorized;

    drive.authorized = out.authorized;
    out.sends = false;
    if (resumed) {
        out.left_rpm = 0.0;
        out.right_rpm = 0.0;
    }
    if (!out.authorized)
        return;
    if (!drive.initialised) {
        drive.initialised = true;
        return;
    }
    out.stop_pin = out.emergency_stop;
    out.left_rpm = ramp(out.left_rpm, out.v - out.omega);
    out.right_rpm = ramp(out.right_rpm, out.v + out.omega);
    out.sends = true;
}

/* ---- the task ---- */

static void snapshot(void)
{
    in.s = sensors;
    if (in.s.b1_alive != in.alive) {
        in.alive = in.s.b1_alive;
        in.b1_alive_at = in.s.now;
    }
}

void sup2_task(void)
{
    snapshot();
    selection();
    monitors();
    out.critical_mask = mask(CRITICAL);
    out.degraded_mask = mask(DEGRADED);
    out.b2_emergency = (out.critical_mask & 0x03) != 0;
    out.b1_requests_switch = (in.s.b1_critical & 0x84) != 0;
    out.b1_emergency = (in.s.b1_critical & ~0x84) != 0;
    check_board1();
    if (out.authorized) {
        safety(out.b1_emergency || out.b2_emergency);
        own_command();
        backward_toggle();
        move();
    }
    actuate();
    coherence();
}

void sup2_init(void)
{
    memset(&sensors, 0, sizeof sensors);
    memset(&out, 0, sizeof out);
    memset(&in, 0, sizeof in);
    memset(&obst, 0, sizeof obst);
    memset(&mon_sup, 0, sizeof mon_sup);
    memset(&mon_esp, 0, sizeof mon_esp);
    memset(&mon_imu, 0, sizeof mon_imu);
    memset(&mon_rx, 0, sizeof mon_rx);
    memset(&authority, 0, sizeof authority);
    memset(&presses, 0, sizeof presses);
    memset(&mot, 0, sizeof mot);
    memset(&coh, 0, sizeof coh);
    memset(&drive, 0, sizeof drive);
    motion = INITIAL;
    degraded_started = driving_obstacles_started = false;
    presses.btn1 = presses.btn2 = true;
    out.stop_pin = true;
}
