/* Breadth-first search of RoverLite by hand, with parents: what a C programmer gets for one model.
 *
 *     gcc -O3 -march=native -DCOMP=28 -DK=1 [-DFACT] [-DSTOPON=16] -o bfs bfs.c && ./bfs
 *
 * FACT: the distinct successors of each part are multiplied, instead of trying every input vector.
 * STOPON: stop at a violation of these properties (bits as in model.h). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>

#include "model.h"

#ifndef STOPON
#define STOPON 0
#endif
#define MOST 1000000000ull

static Word *table, *queue;
static uint32_t *parent;
static uint64_t slots, mask, stored;

static double seconds(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return t.tv_sec + t.tv_nsec * 1e-9;
}

static inline uint64_t hash(Word w) {
    uint64_t x = (uint64_t)w;
    if (sizeof(Word) > 8) x ^= (uint64_t)(w >> 32 >> 32) * 0x9E3779B97F4A7C15ull;
    x = (x ^ x >> 32) * 0xd6e8feb86659fd93ull;
    x = (x ^ x >> 32) * 0xd6e8feb86659fd93ull;
    return x ^ x >> 32;
}

/* Zeroed memory that costs nothing until it is touched. */
static void *reserve(size_t bytes) {
    void *p = mmap(0, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (p == MAP_FAILED) {
        perror("mmap");
        exit(1);
    }
    madvise(p, bytes, MADV_HUGEPAGE);
    return p;
}

static void grow(void) {
    Word *old = table;
    uint64_t before = slots;
    slots *= 2;
    mask = slots - 1;
    table = reserve(slots * sizeof(Word));
    for (uint64_t i = 0; i < stored; i++) {
        uint64_t h = hash(queue[i]) & mask;
        while (table[h]) h = (h + 1) & mask;
        table[h] = queue[i] + 1;
    }
    munmap(old, before * sizeof(Word));
}

/* The table holds states plus one, so that zero is an empty slot. */
static inline void insert(Word w, uint64_t h, uint32_t from) {
    for (h &= mask;; h = (h + 1) & mask) {
        if (table[h] == w + 1) return;
        if (!table[h]) break;
    }
    table[h] = w + 1;
    parent[stored] = from;
    queue[stored++] = w;
}

static Word next[20480];
static uint64_t hashes[20480];

/* Add a word unless it is among the first n. */
static inline int distinct(Word *words, int n, Word w) {
    for (int i = 0; i < n; i++)
        if (words[i] == w) return n;
    words[n] = w;
    return n + 1;
}

#ifdef FACT
static inline int successors(const State *s, int *broken) {
    Word t[3] = {0}, b[3] = {0}, l[4], o[16] = {0};
    int t_status[3] = {OK}, on_after[4], n_t = !HAS_T, n_b = !HAS_B, n_l = 0, n_o = !HAS_O, n = 0;
    for (int i = 0; HAS_T && i < 3; i++) { /* critical, neither, fine */
        int status = s->t, count = s->t_count, before = n_t;
        monitor(i == 0, i == 2, T_LIMIT, &status, &count);
        n_t = distinct(t, n_t, pack_two(status, count, BITS(T_LIMIT), 0));
        if (n_t > before) t_status[before] = status;
        if (status == CRITICAL) *broken |= P4;
    }
    for (int i = 0; HAS_B && i < 3; i++) {
        int status = s->b, count = s->b_count;
        monitor(i == 0, i == 2, B_LIMIT, &status, &count);
        n_b = distinct(b, n_b, pack_two(status, count, BITS(B_LIMIT), AT_B));
    }
    for (int i = 0; i < 1 + HAS_R; i++)
        for (int j = 0; j < 1 + HAS_S; j++) {
            Word w = 0;
            int lost = 0, on = s->on, hold = s->hold;
            if (HAS_R) {
                int status = s->r, age = s->r_age, good = s->r_good;
                receive(i, &status, &age, &good);
                w |= pack_link(status, age, good, AT_R);
                lost |= status == CRITICAL;
            }
            if (HAS_S) {
                int status = s->s, age = s->s_age, good = s->s_good;
                receive(j, &status, &age, &good);
                w |= pack_link(status, age, good, AT_S);
                lost |= status == CRITICAL;
            }
            if (HAS_L) {
                relay(lost, &on, &hold);
                w |= pack_relay(on, hold);
                if (!on && lost) *broken |= P3;
            }
            on_after[n_l] = on;
            l[n_l++] = w;
        }
    for (int i = 0; HAS_O && i < 8; i++)
        for (int turned = 0; turned < 1 + (s->command != 0); turned++) {
            State u = *s;
            obstacles(i & 1 ? FAR : MID, i & 2 ? FAR : MID, i & 4 ? FAR : MID, turned, &u);
            o[n_o++] = pack_obstacles(&u);
        }
    for (int i = 0; i < n_t; i++)
        for (int j = 0; j < n_l; j++) {
            Word tl = t[i] | l[j];
            if (HAS_OBSERVER) {
                int observed = observe(s->observed, s->on, on_after[j], t_status[i]);
                if (observed && t_status[i] == CRITICAL) *broken |= P5;
                tl |= pack_observer(observed);
            }
            for (int x = 0; x < n_b; x++)
                for (int y = 0; y < n_o; y++) next[n++] = tl | b[x] | o[y];
        }
    return n;
}
#else
static inline int successors(const State *s, int *broken) {
    const int sonars = HAS_O ? 4 : 1;
    int n = 0;
    Input in;
    for (in.t = 0; in.t < (HAS_T ? 5 : 1); in.t++)
        for (in.b = 0; in.b < (HAS_B ? 4 : 1); in.b++)
            for (in.r = 0; in.r < 1 + HAS_R; in.r++)
                for (in.s = 0; in.s < 1 + HAS_S; in.s++)
                    for (in.sonar1 = 0; in.sonar1 < sonars; in.sonar1++)
                        for (in.sonar2 = 0; in.sonar2 < sonars; in.sonar2++)
                            for (in.sonar3 = 0; in.sonar3 < sonars; in.sonar3++)
                                for (in.turned = 0; in.turned < 1 + HAS_O; in.turned++) {
                                    State u = *s;
                                    *broken |= step(&u, &in);
                                    next[n++] = pack(&u);
                                }
    return n;
}
#endif

int main(void) {
    double began = seconds(CLOCK_MONOTONIC), cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
    uint64_t transitions = 0, level_end = 1, i;
    int depth = 0, broken = 0;
    State initial;
    slots = 1 << 16;
    mask = slots - 1;
    table = reserve(slots * sizeof(Word));
    queue = reserve((MOST + 100000) * sizeof(Word));
    parent = reserve((MOST + 100000) * sizeof(uint32_t));
    memset(&initial, 0, sizeof initial);
    insert(pack(&initial), hash(pack(&initial)), 0);
    for (i = 0; i < stored && stored <= MOST; i++) {
        if (i == level_end) depth++, level_end = stored;
        State s;
        memset(&s, 0, sizeof s);
        unpack(queue[i], &s);
        int n = successors(&s, &broken);
        transitions += n;
        while ((stored + n) * 10 > slots * 6) grow();
        for (int j = 0; j < n; j++) {
            hashes[j] = hash(next[j]);
            __builtin_prefetch(&table[hashes[j] & mask]);
        }
        for (int j = 0; j < n; j++) insert(next[j], hashes[j], (uint32_t)i);
        if (broken & STOPON) {
            depth++;
            break;
        }
    }
    double t = seconds(CLOCK_MONOTONIC) - began;
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    printf("COMP=%d K=%d bits=%d states=%llu trans=%llu depth=%d viol=%x t=%.4f cpu=%.4f rss=%ld%s\n", COMP, K,
           WIDTH, (unsigned long long)stored, (unsigned long long)transitions, depth, broken, t,
           seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu, used.ru_maxrss, stored > MOST ? " LIMIT" : "");
    return 0;
}
