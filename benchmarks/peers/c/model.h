/* RoverLite by hand: the step of each part, and valuations packed into one word.
 *
 * COMP chooses the parts by its bits (1 temperature, 2 battery, 4 reception, 8 heartbeat, 16 relay,
 * 32 obstacles, 64 observer of P5); K divides the timers. */
#include <stdint.h>

#ifndef K
#define K 1
#endif
#ifndef COMP
#define COMP 3
#endif

#define HAS_T (COMP & 1)
#define HAS_B ((COMP >> 1) & 1)
#define HAS_R ((COMP >> 2) & 1)
#define HAS_S ((COMP >> 3) & 1)
#define HAS_L ((COMP >> 4) & 1)
#define HAS_O ((COMP >> 5) & 1)
#define HAS_OBSERVER ((COMP >> 6) & 1)

#define STEPS(n) ((n) / K > 0 ? (n) / K : 1)
#define T_LIMIT STEPS(200)
#define B_LIMIT STEPS(250)
#define GOOD STEPS(50)
#define HOLD STEPS(150)
#define WINDOW STEPS(150)

/* Bits for 0..n */
#define BITS(n) ((n) < 2 ? 1 : (n) < 4 ? 2 : (n) < 8 ? 3 : (n) < 16 ? 4 : (n) < 32 ? 5 : (n) < 64 ? 6 : (n) < 128 ? 7 : 8)
#define BITS_T (HAS_T * (2 + BITS(T_LIMIT)))
#define BITS_B (HAS_B * (2 + BITS(B_LIMIT)))
#define BITS_R (HAS_R * (5 + BITS(GOOD)))
#define BITS_S (HAS_S * (5 + BITS(GOOD)))
#define BITS_L (HAS_L * (1 + BITS(HOLD)))
#define BITS_O (HAS_O * (5 + 4 * BITS(WINDOW)))
#define AT_B BITS_T
#define AT_R (AT_B + BITS_B)
#define AT_S (AT_R + BITS_R)
#define AT_L (AT_S + BITS_S)
#define AT_O (AT_L + BITS_L)
#define AT_OBSERVER (AT_O + BITS_O)
#define WIDTH (AT_OBSERVER + HAS_OBSERVER)

/* Parts that need more than 64 bits together. */
#if (COMP & 32) && (COMP & 31) && K < 3
typedef unsigned __int128 Word;
#else
typedef uint64_t Word;
#endif

enum { OK, DEGRADED, CRITICAL };
enum { NEAR, MID, FAR, NONE };
enum { P1 = 1, P2 = 2, P3 = 4, P4 = 8, P5 = 16 };

typedef struct {
    int t, t_count, b, b_count;           /* status and streak of temperature and battery */
    int r, r_age, r_good, s, s_age, s_good; /* status, age, good steps of reception and heartbeat */
    int on, hold;                         /* relay */
    int far1, far2, far3, w12, w21, w23, w32, command;
    int observed;
} State;

/* t: cold critical, cold, fine, hot, hot critical; b: critical low, low, fine, over */
typedef struct {
    int t, b, r, s, sonar1, sonar2, sonar3, turned;
} Input;

static inline void monitor(int critical, int fine, int limit, int *status, int *count) {
    int streak = critical ? (*count + 1 < limit ? *count + 1 : limit) : 0;
    if (*status == CRITICAL)
        *status = fine ? OK : CRITICAL;
    else if (critical)
        *status = streak >= limit ? CRITICAL : DEGRADED;
    else
        *status = fine ? OK : DEGRADED;
    *count = *status == CRITICAL ? 0 : streak;
}

static inline void receive(int new, int *status, int *age, int *good) {
    *age = new ? 0 : (*age < 7 ? *age + 1 : 7);
    *good = *age <= 2 ? (*good < GOOD ? *good + 1 : GOOD) : 0;
    if (*age > 6)
        *status = CRITICAL;
    else if (*status == OK)
        *status = *age > 2 ? DEGRADED : OK;
    else if (*status == DEGRADED)
        *status = *age <= 2 && *good >= GOOD ? OK : DEGRADED;
    else
        *status = *good >= GOOD ? OK : CRITICAL;
    if (*status == OK)
        *good = 0;
}

static inline void relay(int critical, int *on, int *hold) {
    if (critical) {
        *on = 1;
        *hold = 0;
    } else if (*on) {
        if (*hold + 1 >= HOLD)
            *on = *hold = 0;
        else
            ++*hold;
    }
}

static inline int window(int opened, int left) { return opened ? WINDOW : left > 0 ? left - 1 : 0; }

static inline void obstacles(int sonar1, int sonar2, int sonar3, int turned, State *s) {
    int far1 = sonar1 == FAR, far2 = sonar2 == FAR, far3 = sonar3 == FAR;
    int left1 = s->far1 & !far1, left2 = s->far2 & !far2, left3 = s->far3 & !far3;
    int clear = 1;
    if (s->command) {
        if (turned)
            s->command = 0;
    } else if (s->w12 > 0 && far2)
        s->command = 1;
    else if (s->w21 > 0 && far1)
        s->command = 2;
    else if (s->w23 > 0 && far3)
        s->command = 1;
    else if (s->w32 > 0 && far2)
        s->command = 2;
    else
        clear = 0;
    if (clear) {
        s->w12 = s->w21 = s->w23 = s->w32 = 0;
    } else {
        s->w12 = window(left1, s->w12);
        s->w21 = window(left2, s->w21);
        s->w23 = window(left2, s->w23);
        s->w32 = window(left3, s->w32);
    }
    s->far1 = far1;
    s->far2 = far2;
    s->far3 = far3;
}

static inline int observe(int observed, int was_on, int on, int t) {
    return observed | (was_on && !on && t == OK);
}

/* One step; the bits of the properties that are broken after it. */
static inline int step(State *s, const Input *in) {
    int was_on = s->on, near = 0, stop = 0;
    if (HAS_T) monitor(in->t == 0 || in->t == 4, in->t == 2, T_LIMIT, &s->t, &s->t_count);
    if (HAS_B) monitor(in->b == 0 || in->b == 3, in->b == 2, B_LIMIT, &s->b, &s->b_count);
    if (HAS_R) receive(in->r, &s->r, &s->r_age, &s->r_good);
    if (HAS_S) receive(in->s, &s->s, &s->s_age, &s->s_good);
    int lost = (HAS_R && s->r == CRITICAL) || (HAS_S && s->s == CRITICAL);
    if (HAS_L) relay(lost, &s->on, &s->hold);
    if (HAS_O) {
        obstacles(in->sonar1, in->sonar2, in->sonar3, in->turned, s);
        near = in->sonar1 == NEAR || in->sonar2 == NEAR || in->sonar3 == NEAR;
        stop = (near ? 3 : s->command) == 3;
    }
    int hot = HAS_T && s->t == CRITICAL, critical = hot || (HAS_B && s->b == CRITICAL) || lost;
    int moving = !critical && !stop;
    if (HAS_OBSERVER) s->observed = observe(s->observed, was_on, s->on, s->t);
    return (near && !stop ? P1 : 0) | (critical && moving ? P2 : 0) | (HAS_L && !s->on && lost ? P3 : 0)
         | (hot ? P4 : 0) | (HAS_OBSERVER && s->observed && hot ? P5 : 0);
}

/* --- packing: each part has its own bits, so that words of parts can be joined with | ------------- */

#define PUT(value, bits) (w |= (Word)(value) << at, at += (bits))
#define GET(bits) (at += (bits), (int)((w >> (at - (bits))) & ((1u << (bits)) - 1)))

static inline Word pack_two(int status, int count, int bits, int at) {
    Word w = 0;
    PUT(status, 2);
    PUT(count, bits);
    return w;
}

static inline Word pack_link(int status, int age, int good, int at) {
    Word w = 0;
    PUT(status, 2);
    PUT(age, 3);
    PUT(good, BITS(GOOD));
    return w;
}

static inline Word pack_relay(int on, int hold) {
    Word w = 0;
    int at = AT_L;
    PUT(on, 1);
    PUT(hold, BITS(HOLD));
    return w;
}

static inline Word pack_obstacles(const State *s) {
    Word w = 0;
    int at = AT_O;
    PUT(s->far1, 1);
    PUT(s->far2, 1);
    PUT(s->far3, 1);
    PUT(s->command, 2);
    PUT(s->w12, BITS(WINDOW));
    PUT(s->w21, BITS(WINDOW));
    PUT(s->w23, BITS(WINDOW));
    PUT(s->w32, BITS(WINDOW));
    return w;
}

static inline Word pack_observer(int observed) { return (Word)observed << AT_OBSERVER; }

static inline Word pack(const State *s) {
    Word w = 0;
    if (HAS_T) w |= pack_two(s->t, s->t_count, BITS(T_LIMIT), 0);
    if (HAS_B) w |= pack_two(s->b, s->b_count, BITS(B_LIMIT), AT_B);
    if (HAS_R) w |= pack_link(s->r, s->r_age, s->r_good, AT_R);
    if (HAS_S) w |= pack_link(s->s, s->s_age, s->s_good, AT_S);
    if (HAS_L) w |= pack_relay(s->on, s->hold);
    if (HAS_O) w |= pack_obstacles(s);
    if (HAS_OBSERVER) w |= pack_observer(s->observed);
    return w;
}

static inline void unpack(Word w, State *s) {
    int at = 0;
    if (HAS_T) s->t = GET(2), s->t_count = GET(BITS(T_LIMIT));
    if (HAS_B) s->b = GET(2), s->b_count = GET(BITS(B_LIMIT));
    if (HAS_R) s->r = GET(2), s->r_age = GET(3), s->r_good = GET(BITS(GOOD));
    if (HAS_S) s->s = GET(2), s->s_age = GET(3), s->s_good = GET(BITS(GOOD));
    if (HAS_L) s->on = GET(1), s->hold = GET(BITS(HOLD));
    if (HAS_O) {
        s->far1 = GET(1), s->far2 = GET(1), s->far3 = GET(1), s->command = GET(2);
        s->w12 = GET(BITS(WINDOW)), s->w21 = GET(BITS(WINDOW));
        s->w23 = GET(BITS(WINDOW)), s->w32 = GET(BITS(WINDOW));
    }
    if (HAS_OBSERVER) s->observed = GET(1);
}
