/*
 * File: sup_b1.h
 *
 * Supervisor of Board 1, without the motion references, in the style of code generated from a model: inputs,
 * outputs and state are global structures, sup_b1_initialize() is called once and sup_b1_step() every 20 ms.
 */
#ifndef SUP_B1_H
#define SUP_B1_H

#include <stdbool.h>
#include <stdint.h>

typedef double real_T;
typedef uint8_t uint8_T;
typedef uint32_t uint32_T;
typedef unsigned char boolean_T;

typedef enum { HEALTH_OK = 0, HEALTH_DEGRADED = 1, HEALTH_CRITICAL = 2 } HealthLevel;

typedef enum { SAFETY_OK = 0, SAFETY_DEGRADED = 1, SAFETY_CRITICAL = 2 } SafetyState;

/* Wheels are front left, front right, rear left, rear right. */
#define NUM_WHEELS 4

typedef struct {
  real_T temperature_degC;
  real_T battery_pct;
  uint32_T temp_last_valid_ms;
  uint32_T batt_last_valid_ms;
} BusHealth;

typedef struct {
  uint32_T data_last_valid_ms;
  uint8_T critical_mask;
  uint8_T degraded_mask;
  boolean_T isMotionConsistent;
} BusBoard2;

typedef struct {
  boolean_T hasNoFeedback;
} BusEncoder;

/* External inputs */
typedef struct {
  uint32_T now_ms;
  uint32_T last_valid_b2_ms;
  BusBoard2 board2;
  BusHealth health;
  BusEncoder encoder[NUM_WHEELS];
} ExtU_sup_b1_T;

/* External outputs */
typedef struct {
  uint8_T critical_mask;
  uint8_T degraded_mask;
  boolean_T give_b2_actuation;
  boolean_T b2_critical;
  boolean_T b2_degraded;
  SafetyState rover_safety_state;
  HealthLevel temp_status;
  HealthLevel batt_status;
  HealthLevel b2_sup_status;
  HealthLevel rx_status;
  HealthLevel wheel_status[NUM_WHEELS];
} ExtY_sup_b1_T;

extern ExtU_sup_b1_T rtU;
extern ExtY_sup_b1_T rtY;

extern void sup_b1_initialize(void);
extern void sup_b1_step(void);
extern void sup_b1_terminate(void);

#endif /* SUP_B1_H */
