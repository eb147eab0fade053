/*
 * File: sup_b1.c
 *
 * Monitors, fault masks, relay and safety state of Board 1.
 */
#include "sup_b1.h"

#include <math.h>
#include <string.h>

#define NUM_INTERVALS 10U

#define ESTIMATE_FROM_MS 500U /* from this age on a reading is assumed to drift */
#define LATE_MS 40U           /* mean interval above which updates are slow */
#define LOST_MS 120U          /* age above which updates are absent */
#define TEMP_HOLD_MS 4000U
#define BATT_HOLD_MS 5000U
#define RELAY_HOLD_STEPS 150U /* 3 s */

/* Children of the charts Relay and Safety; 0 before their first execution */
#define IN_NO_ACTIVE_CHILD 0U
#define IN_B1_actuating 1U
#define IN_B2_actuating 2U
#define IN_Rover_Safe_State 1U
#define IN_Rover_Degraded_State 2U
#define IN_Rover_Critical_State 3U

typedef struct {
  uint32_T since_ms;
  boolean_T running;
  boolean_T over;
} Hold;

typedef struct {
  uint32_T stamp_ms;
  uint32_T oldest_ms;
} Age;

typedef struct {
  uint32_T stamp_ms;
  uint32_T interval[NUM_INTERVALS];
  uint8_T count;
  uint8_T next;
  boolean_T updated;
} Mean;

/* Block states */
typedef struct {
  Hold temp_hold;
  Hold batt_hold;
  Age temp_age;
  Age batt_age;
  Age sup_age;
  Age rx_age;
  Mean sup_mean;
  Mean rx_mean;
  uint32_T duration_sound;
  uint8_T is_Relay;
  uint8_T is_Safety;
} DW_sup_b1_T;

ExtU_sup_b1_T rtU;
ExtY_sup_b1_T rtY;
static DW_sup_b1_T rtDW;

/* Milliseconds since a stamp; data that miss a whole turn of the clock do not become young again. */
static uint32_T age_ms(Age *age, uint32_T stamp_ms)
{
  uint32_T elapsed = rtU.now_ms - stamp_ms;
  if (stamp_ms != age->stamp_ms) {
    age->stamp_ms = stamp_ms;
    age->oldest_ms = 0U;
  }
  if (elapsed > age->oldest_ms) {
    age->oldest_ms = elapsed;
  }
  return age->oldest_ms;
}

/* Whether a condition has been true without a break for at least limit_ms. */
static boolean_T held(Hold *hold, boolean_T condition, uint32_T limit_ms)
{
  if (!condition) {
    hold->running = false;
    hold->over = false;
    return false;
  }
  if (!hold->running) {
    hold->running = true;
    hold->since_ms = rtU.now_ms;
  }
  hold->over = hold->over || (rtU.now_ms - hold->since_ms >= limit_ms);
  return hold->over;
}

/* Whether the last ten intervals between updates are longer than LATE_MS on average. */
static boolean_T slow(Mean *mean, uint32_T stamp_ms)
{
  uint32_T sum = 0U;
  uint8_T i;
  if (stamp_ms != mean->stamp_ms) {
    if (mean->updated) {
      mean->interval[mean->next] = stamp_ms - mean->stamp_ms;
      mean->next = (uint8_T)((mean->next + 1U) % NUM_INTERVALS);
      mean->count += (mean->count < NUM_INTERVALS) ? 1U : 0U;
    }
    mean->stamp_ms = stamp_ms;
    mean->updated = true;
  }
  for (i = 0U; i < NUM_INTERVALS; i++) {
    sum += mean->interval[i];
  }
  return mean->count == NUM_INTERVALS && sum > NUM_INTERVALS * LATE_MS;
}

/* Monitor_temperature */
static void monitor_temperature(void)
{
  real_T degc = rtU.health.temperature_degC;
  uint32_T age = age_ms(&rtDW.temp_age, rtU.health.temp_last_valid_ms);
  boolean_T critical = !isfinite(degc) || degc <= -15.0 || degc >= 60.0;
  boolean_T estimated = age >= ESTIMATE_FROM_MS && degc > (65000.0 - age) / 1000.0;
  if (held(&rtDW.temp_hold, critical, TEMP_HOLD_MS) || estimated) {
    rtY.temp_status = HEALTH_CRITICAL;
  } else if (critical || degc <= -5.0 || degc >= 55.0) {
    rtY.temp_status = HEALTH_DEGRADED;
  } else {
    rtY.temp_status = HEALTH_OK;
  }
}

/* Monitor_battery: from 23 to 25 the status is kept */
static void monitor_battery(void)
{
  real_T pct = rtU.health.battery_pct;
  uint32_T age = age_ms(&rtDW.batt_age, rtU.health.batt_last_valid_ms);
  boolean_T critical = !isfinite(pct) || (pct >= 0.0 && pct <= 15.0);
  boolean_T estimated = age >= ESTIMATE_FROM_MS && pct < (1500000.0 + 42.0 * age) / 100000.0;
  if (held(&rtDW.batt_hold, critical, BATT_HOLD_MS) || estimated) {
    rtY.batt_status = HEALTH_CRITICAL;
  } else if (critical || pct < 23.0) {
    rtY.batt_status = HEALTH_DEGRADED;
  } else if (pct > 25.0) {
    rtY.batt_status = HEALTH_OK;
  }
}

/* Monitor_wheel */
static HealthLevel monitor_wheel(boolean_T hasNoFeedback, boolean_T isMotionConsistent)
{
  if (hasNoFeedback && !isMotionConsistent) {
    return HEALTH_CRITICAL;
  }
  return (hasNoFeedback || !isMotionConsistent) ? HEALTH_DEGRADED : HEALTH_OK;
}

/* Monitor_heartbeat and Monitor_reception */
static HealthLevel monitor_updates(Age *age, Mean *mean, uint32_T stamp_ms)
{
  boolean_T late = slow(mean, stamp_ms);
  if (age_ms(age, stamp_ms) > LOST_MS) {
    return HEALTH_CRITICAL;
  }
  return late ? HEALTH_DEGRADED : HEALTH_OK;
}

/* Fault masks: the components at a level, one bit each */
static uint8_T mask(HealthLevel level)
{
  const HealthLevel component[8] = {
    rtY.temp_status,     rtY.batt_status,     rtY.rx_status,       rtY.wheel_status[0],
    rtY.wheel_status[1], rtY.wheel_status[2], rtY.wheel_status[3], rtY.b2_sup_status,
  };
  uint8_T bits = 0U;
  uint8_T i;
  for (i = 0U; i < 8U; i++) {
    if (component[i] == level) {
      bits |= (uint8_T)(1U << i);
    }
  }
  return bits;
}

/* Chart: Relay */
static void chart_relay(void)
{
  boolean_T sound = rtY.rx_status != HEALTH_CRITICAL && rtY.b2_sup_status != HEALTH_CRITICAL;
  switch (rtDW.is_Relay) {
   case IN_NO_ACTIVE_CHILD:
    rtDW.is_Relay = IN_B1_actuating;
    rtY.give_b2_actuation = false;
    break;
   case IN_B1_actuating:
    if (!sound) {
      rtDW.is_Relay = IN_B2_actuating;
      rtY.give_b2_actuation = true;
      rtDW.duration_sound = 0U;
    }
    break;
   default:
    if (sound && rtDW.duration_sound > RELAY_HOLD_STEPS) {
      rtDW.is_Relay = IN_B1_actuating;
      rtY.give_b2_actuation = false;
    }
    break;
  }
  if (rtDW.is_Relay == IN_B2_actuating) {
    if (!sound) {
      rtDW.duration_sound = 0U;
    } else if (rtDW.duration_sound <= RELAY_HOLD_STEPS) {
      rtDW.duration_sound++;
    }
  }
}

/* Chart: Safety, executed while Board 1 drives */
static void chart_safety(boolean_T critical, boolean_T degraded)
{
  switch (rtDW.is_Safety) {
   case IN_NO_ACTIVE_CHILD:
    rtDW.is_Safety = IN_Rover_Safe_State;
    break;
   case IN_Rover_Safe_State:
    if (critical) {
      rtDW.is_Safety = IN_Rover_Critical_State;
    } else if (degraded) {
      rtDW.is_Safety = IN_Rover_Degraded_State;
    }
    break;
   case IN_Rover_Degraded_State:
    if (!degraded) {
      rtDW.is_Safety = IN_Rover_Safe_State;
    } else if (critical) {
      rtDW.is_Safety = IN_Rover_Critical_State;
    }
    break;
   default:
    if (!critical) {
      rtDW.is_Safety = degraded ? IN_Rover_Degraded_State : IN_Rover_Safe_State;
    }
    break;
  }
  rtY.rover_safety_state = (SafetyState)(rtDW.is_Safety - IN_Rover_Safe_State);
}

/* Model step function */
void sup_b1_step(void)
{
  uint8_T i;
  monitor_temperature();
  monitor_battery();
  for (i = 0U; i < NUM_WHEELS; i++) {
    rtY.wheel_status[i] = monitor_wheel(rtU.encoder[i].hasNoFeedback, rtU.board2.isMotionConsistent);
  }
  rtY.b2_sup_status = monitor_updates(&rtDW.sup_age, &rtDW.sup_mean, rtU.last_valid_b2_ms);
  rtY.rx_status = monitor_updates(&rtDW.rx_age, &rtDW.rx_mean, rtU.board2.data_last_valid_ms);

  rtY.critical_mask = mask(HEALTH_CRITICAL);
  rtY.degraded_mask = mask(HEALTH_DEGRADED);
  rtY.b2_critical = (rtU.board2.critical_mask & 0x03U) != 0U;
  rtY.b2_degraded = (rtU.board2.critical_mask & 0x0CU) != 0U || rtU.board2.degraded_mask != 0U;

  chart_relay();
  if (!rtY.give_b2_actuation) {
    chart_safety(rtY.critical_mask != 0U || rtY.b2_critical, rtY.degraded_mask != 0U || rtY.b2_degraded);
  }
}

/* Model initialize function */
void sup_b1_initialize(void)
{
  (void)memset(&rtU, 0, sizeof(rtU));
  (void)memset(&rtY, 0, sizeof(rtY));
  (void)memset(&rtDW, 0, sizeof(rtDW));
}

/* Model terminate function */
void sup_b1_terminate(void)
{
  /* (no terminate code required) */
}
