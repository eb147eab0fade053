/*
 * File: sup1.c
 *
 * Code generated for Simulink model 'sup1'.
 *
 * Model version                  : 4.117
 * Target selection: ert.tlc
 */
#include "sup1.h"

#include <math.h>
#include <string.h>

/* Named constants for Chart: '<S4>/Relay' */
#define sup1_IN_B1_actuating           ((uint8_T)1U)
#define sup1_IN_B2_actuating           ((uint8_T)2U)

/* Named constants for Chart: '<S4>/Safety_state' */
#define sup1_IN_Rover_Critical_State   ((uint8_T)1U)
#define sup1_IN_Rover_Degraded_State   ((uint8_T)2U)
#define sup1_IN_Rover_Safe_State       ((uint8_T)3U)

/* Named constants for Chart: '<S5>/Backward_mode_toggle' */
#define sup1_IN_StartingPoint          ((uint8_T)0U)
#define sup1_IN_Step2                  ((uint8_T)1U)
#define sup1_IN_Step3                  ((uint8_T)2U)
#define sup1_IN_Step4                  ((uint8_T)3U)

/* Named constants for Chart: '<S5>/Motion_Supervision' */
#define sup1_IN_NO_ACTIVE_CHILD        ((uint8_T)0U)
#define sup1_IN_Procedura_emergency_st ((uint8_T)1U)
#define sup1_IN_Stato_marcia_rover     ((uint8_T)2U)
#define sup1_IN_Evita_destra           ((uint8_T)1U)
#define sup1_IN_Evita_sinistra         ((uint8_T)2U)
#define sup1_IN_Normale_marcia         ((uint8_T)3U)
#define sup1_IN_Retromarcia_180        ((uint8_T)4U)
#define sup1_IN_Schivata_a_destra      ((uint8_T)5U)
#define sup1_IN_Schivata_a_sinistra    ((uint8_T)6U)
#define sup1_IN_In_frenata_di_emergenz ((uint8_T)1U)
#define sup1_IN_Motori_fermi           ((uint8_T)2U)

/* Block signals and states (default storage) */
static DW_sup1_T sup1_DW;

/* External inputs (root inport signals with default storage) */
ExtU_sup1_T sup1_U;

/* External outputs (root outports fed by signals with default storage) */
ExtY_sup1_T sup1_Y;

/* Output and update for atomic system: '<S2>/Age' */
static uint32_T sup1_Age(uint32_T rtu_stamp, DW_Age_T *localDW)
{
  uint32_T elapsed = sup1_U.now_ms - rtu_stamp;
  if (rtu_stamp != localDW->Stamp) {
    localDW->Stamp = rtu_stamp;
    localDW->Elapsed = 0U;
  }

  if (elapsed > localDW->Elapsed) {
    localDW->Elapsed = elapsed;
  }

  return localDW->Elapsed;
}

/* Output and update for atomic system: '<S2>/Debounce' */
static boolean_T sup1_Debounce(boolean_T rtu_cond, uint32_T rtp_limit, DW_Debounce_T *localDW)
{
  if (!rtu_cond) {
    localDW->Running = false;
    localDW->Over = false;
  } else {
    if (!localDW->Running) {
      localDW->Running = true;
      localDW->Since = sup1_U.now_ms;
    }

    if (sup1_U.now_ms - localDW->Since >= rtp_limit) {
      localDW->Over = true;
    }
  }

  return localDW->Over;
}

/* Output and update for atomic system: '<S2>/Mean_interval' */
static boolean_T sup1_Mean_interval(uint32_T rtu_stamp, DW_MeanInterval_T *localDW)
{
  uint32_T sum = 0U;
  int32_T i;
  if (rtu_stamp != localDW->Last) {
    if (localDW->Updated) {
      localDW->Interval[localDW->Index] = rtu_stamp - localDW->Last;
      localDW->Index = (uint8_T)((localDW->Index + 1U) % 10U);
      if (localDW->Count < 10U) {
        localDW->Count++;
      }
    }

    localDW->Last = rtu_stamp;
    localDW->Updated = true;
  }

  if (localDW->Count < 10U) {
    return false;
  }

  for (i = 0; i < 10; i++) {
    sum += localDW->Interval[i];
  }

  return (boolean_T)(sum > 400U);
}

/* Chart: '<S2>/Monitor_temperature' */
static void sup1_Monitor_temperature(void)
{
  real_T u = sup1_U.temperature_degC;
  uint32_T age = sup1_Age(sup1_U.temp_last_valid_ms, &sup1_DW.Temperature_age);
  boolean_T critical = (boolean_T)((u <= -15.0) || (u >= 60.0));
  boolean_T held = sup1_Debounce(critical, 4000U, &sup1_DW.Temperature_debounce);
  boolean_T estimated = (boolean_T)((age >= 500U) && (u > (65000.0 - (real_T)age) / 1000.0));
  if (held || estimated) {
    sup1_Y.temp_status = Level_CRITICAL;
  } else if ((u <= -5.0) || (u >= 55.0)) {
    sup1_Y.temp_status = Level_DEGRADED;
  } else {
    sup1_Y.temp_status = Level_OK;
  }
}

/* Chart: '<S2>/Monitor_battery' */
static void sup1_Monitor_battery(void)
{
  real_T u = sup1_U.battery_pct;
  uint32_T age = sup1_Age(sup1_U.batt_last_valid_ms, &sup1_DW.Battery_age);
  boolean_T held = sup1_Debounce((boolean_T)(u <= 15.0), 5000U, &sup1_DW.Battery_debounce);
  boolean_T estimated = (boolean_T)((age >= 500U) && (u < (1500000.0 + 42.0 * (real_T)age) / 100000.0));
  if (held || estimated) {
    sup1_Y.batt_status = Level_CRITICAL;
  } else if (u < 23.0) {
    sup1_Y.batt_status = Level_DEGRADED;
  } else if (u > 25.0) {
    sup1_Y.batt_status = Level_OK;
  }
}

/* Chart: '<S2>/Monitor_wheel' */
static Level sup1_Monitor_wheel(boolean_T rtu_noFeedback, boolean_T rtu_consistent)
{
  Level rty_status = Level_OK;
  if (rtu_noFeedback && (!rtu_consistent)) {
    rty_status = Level_CRITICAL;
  } else if (rtu_noFeedback || (!rtu_consistent)) {
    rty_status = Level_DEGRADED;
  }

  return rty_status;
}

/* Chart: '<S2>/Monitor_heartbeat' */
static void sup1_Monitor_heartbeat(void)
{
  uint32_T age = sup1_Age(sup1_U.last_valid_b2_ms, &sup1_DW.Heartbeat_age);
  boolean_T slow = sup1_Mean_interval(sup1_U.last_valid_b2_ms, &sup1_DW.Heartbeat_mean);
  if (age > 120U) {
    sup1_Y.b2_sup_status = Level_CRITICAL;
  } else if (slow) {
    sup1_Y.b2_sup_status = Level_DEGRADED;
  } else {
    sup1_Y.b2_sup_status = Level_OK;
  }
}

/* Chart: '<S2>/Monitor_reception' */
static void sup1_Monitor_reception(void)
{
  uint32_T age = sup1_Age(sup1_U.b2_data_last_valid_ms, &sup1_DW.Reception_age);
  boolean_T slow = sup1_Mean_interval(sup1_U.b2_data_last_valid_ms, &sup1_DW.Reception_mean);
  if (age > 120U) {
    sup1_Y.rx_status = Level_CRITICAL;
  } else if (slow) {
    sup1_Y.rx_status = Level_DEGRADED;
  } else {
    sup1_Y.rx_status = Level_OK;
  }
}

/* MATLAB Function: '<S3>/Fault_masks' */
static void sup1_Fault_masks(void)
{
  Level status[8];
  int32_T bit;
  status[0] = sup1_Y.temp_status;
  status[1] = sup1_Y.batt_status;
  status[2] = sup1_Y.rx_status;
  status[3] = sup1_Y.wheel_status[0];
  status[4] = sup1_Y.wheel_status[1];
  status[5] = sup1_Y.wheel_status[2];
  status[6] = sup1_Y.wheel_status[3];
  status[7] = sup1_Y.b2_sup_status;
  sup1_Y.critical_mask = 0U;
  sup1_Y.degraded_mask = 0U;
  for (bit = 0; bit < 8; bit++) {
    if (status[bit] == Level_CRITICAL) {
      sup1_Y.critical_mask |= (uint8_T)(1U << bit);
    } else if (status[bit] == Level_DEGRADED) {
      sup1_Y.degraded_mask |= (uint8_T)(1U << bit);
    }
  }
}

/* Chart: '<S4>/Relay' */
static void sup1_Relay(void)
{
  boolean_T sound = (boolean_T)((sup1_Y.rx_status != Level_CRITICAL) &&
    (sup1_Y.b2_sup_status != Level_CRITICAL));
  if (sup1_DW.is_active_c3_sup1 == 0U) {
    sup1_DW.is_active_c3_sup1 = 1U;
    sup1_DW.is_c3_sup1 = sup1_IN_B1_actuating;
    sup1_Y.give_b2_actuation = false;
  } else if (sup1_DW.is_c3_sup1 == sup1_IN_B1_actuating) {
    if (!sound) {
      sup1_DW.is_c3_sup1 = sup1_IN_B2_actuating;
      sup1_DW.durationCounter_1 = 0U;
      sup1_Y.give_b2_actuation = true;
    }

    /* case IN_B2_actuating: */
  } else if (sound && (sup1_DW.durationCounter_1 > 150U)) {
    sup1_DW.is_c3_sup1 = sup1_IN_B1_actuating;
    sup1_Y.give_b2_actuation = false;
  }

  if (!sound) {
    sup1_DW.durationCounter_1 = 0U;
  } else if (sup1_DW.durationCounter_1 < 1000000U) {
    sup1_DW.durationCounter_1++;
  }
}

/* Chart: '<S4>/Safety_state' */
static void sup1_Safety_state(void)
{
  boolean_T crit = (boolean_T)((sup1_Y.critical_mask != 0U) || sup1_Y.b2_critical);
  boolean_T degr = (boolean_T)((sup1_Y.degraded_mask != 0U) || sup1_Y.b2_degraded);
  if (sup1_DW.is_active_c5_sup1 == 0U) {
    sup1_DW.is_active_c5_sup1 = 1U;
    sup1_DW.is_c5_sup1 = sup1_IN_Rover_Safe_State;
    sup1_Y.rover_safety_state = SAFETY_OK;
  } else {
    switch (sup1_DW.is_c5_sup1) {
     case sup1_IN_Rover_Critical_State:
      if ((!crit) && degr) {
        sup1_DW.is_c5_sup1 = sup1_IN_Rover_Degraded_State;
        sup1_Y.rover_safety_state = SAFETY_DEGRADED;
      } else if (!crit) {
        sup1_DW.is_c5_sup1 = sup1_IN_Rover_Safe_State;
        sup1_Y.rover_safety_state = SAFETY_OK;
      }
      break;

     case sup1_IN_Rover_Degraded_State:
      if (!degr) {
        sup1_DW.is_c5_sup1 = sup1_IN_Rover_Safe_State;
        sup1_Y.rover_safety_state = SAFETY_OK;
      } else if (crit) {
        sup1_DW.is_c5_sup1 = sup1_IN_Rover_Critical_State;
        sup1_Y.rover_safety_state = SAFETY_CRITICAL;
      }
      break;

     default:
      /* case IN_Rover_Safe_State: */
      if (crit) {
        sup1_DW.is_c5_sup1 = sup1_IN_Rover_Critical_State;
        sup1_Y.rover_safety_state = SAFETY_CRITICAL;
      } else if (degr) {
        sup1_DW.is_c5_sup1 = sup1_IN_Rover_Degraded_State;
        sup1_Y.rover_safety_state = SAFETY_DEGRADED;
      }
      break;
    }
  }
}

/* MATLAB Function: '<S5>/updateSafetyLimits' */
static void sup1_updateSafetyLimits(void)
{
  switch (sup1_Y.rover_safety_state) {
   case SAFETY_OK:
    sup1_DW.v_max = 1.0;
    sup1_DW.omega_max = 1.0;
    sup1_DW.v_max_maneuver = 0.8;
    sup1_DW.omega_go_left = 0.4;
    sup1_DW.omega_go_right = -0.4;
    break;

   case SAFETY_DEGRADED:
    sup1_DW.v_max = 0.5;
    sup1_DW.omega_max = 0.5;
    sup1_DW.v_max_maneuver = 0.4;
    sup1_DW.omega_go_left = 0.2;
    sup1_DW.omega_go_right = -0.2;
    break;

   default:
    sup1_DW.v_max = 0.0;
    sup1_DW.omega_max = 0.0;
    sup1_DW.v_max_maneuver = 0.0;
    sup1_DW.omega_go_left = 0.0;
    sup1_DW.omega_go_right = 0.0;
    break;
  }
}

/* Chart: '<S5>/Backward_mode_toggle' */
static void sup1_Backward_mode_toggle(void)
{
  boolean_T rise1 = (boolean_T)(sup1_U.btn1 && (!sup1_DW.btn1_prev));
  boolean_T rise2 = (boolean_T)(sup1_U.btn2 && (!sup1_DW.btn2_prev));
  boolean_T centred = (boolean_T)((sup1_U.x_norm == 0.0) && (sup1_U.y_norm == 0.0));
  sup1_DW.btn1_prev = sup1_U.btn1;
  sup1_DW.btn2_prev = sup1_U.btn2;
  if (sup1_DW.temporalCounter_i1 < 65535U) {
    sup1_DW.temporalCounter_i1++;
  }

  switch (sup1_DW.is_c7_sup1) {
   case sup1_IN_StartingPoint:
    if (rise1 && centred) {
      sup1_DW.is_c7_sup1 = sup1_IN_Step2;
      sup1_DW.temporalCounter_i1 = 0U;
    }
    break;

   case sup1_IN_Step2:
    if (!centred) {
      sup1_DW.is_c7_sup1 = sup1_IN_StartingPoint;
    } else if (rise1) {
      sup1_DW.is_c7_sup1 = sup1_IN_Step3;
      sup1_DW.temporalCounter_i1 = 0U;
    } else if (sup1_DW.temporalCounter_i1 >= 50U) {
      sup1_DW.is_c7_sup1 = sup1_IN_StartingPoint;
    }
    break;

   case sup1_IN_Step3:
    if (!centred) {
      sup1_DW.is_c7_sup1 = sup1_IN_StartingPoint;
    } else if (rise2) {
      sup1_DW.is_c7_sup1 = sup1_IN_Step4;
      sup1_DW.temporalCounter_i1 = 0U;
    } else if (sup1_DW.temporalCounter_i1 >= 50U) {
      sup1_DW.is_c7_sup1 = sup1_IN_StartingPoint;
    }
    break;

   default:
    /* case IN_Step4: */
    if (!centred) {
      sup1_DW.is_c7_sup1 = sup1_IN_StartingPoint;
    } else if (rise2) {
      sup1_Y.backward_enabled = (boolean_T)!sup1_Y.backward_enabled;
      sup1_DW.is_c7_sup1 = sup1_IN_StartingPoint;
    } else if (sup1_DW.temporalCounter_i1 >= 50U) {
      sup1_DW.is_c7_sup1 = sup1_IN_StartingPoint;
    }
    break;
  }
}

/* Function for Chart: '<S5>/Motion_Supervision' */
static real_T sup1_sign(real_T u)
{
  return (u > 0.0) ? 1.0 : ((u < 0.0) ? -1.0 : 0.0);
}

/* Function for Chart: '<S5>/Motion_Supervision' */
static real_T sup1_angleError(real_T yaw, real_T target)
{
  real_T w = fmod(target - yaw + 180.0, 360.0);
  if (w < 0.0) {
    w += 360.0;
  }

  return w - 180.0;
}

/* Function for Chart: '<S5>/Motion_Supervision' */
static boolean_T sup1_checkStop(void)
{
  int32_T i;
  for (i = 0; i < 4; i++) {
    if (fabs(sup1_U.wheel_speed_rpm[i]) >= 2.5) {
      return false;
    }
  }

  return true;
}

/* Function for Chart: '<S5>/Motion_Supervision' */
static void sup1_updateUser(void)
{
  sup1_Y.v_user = sup1_U.y_norm * sup1_DW.v_max;
  sup1_Y.omega_user = sup1_U.x_norm * sup1_DW.omega_max;
  if (sup1_Y.invert_y) {
    if (sup1_Y.v_user >= 0.0) {
      sup1_Y.invert_y = false;
    } else {
      sup1_Y.v_user = -sup1_Y.v_user;
    }
  }
}

/* Function for Chart: '<S5>/Motion_Supervision' */
static void sup1_enter_marcia(uint8_T child, SupervisorCommand action)
{
  sup1_DW.is_c9_sup1 = sup1_IN_Stato_marcia_rover;
  sup1_DW.is_Stato_marcia_rover = child;
  sup1_Y.current_action = action;
}

/* Function for Chart: '<S5>/Motion_Supervision' */
static void sup1_enter_emergency(void)
{
  sup1_DW.is_Stato_marcia_rover = sup1_IN_NO_ACTIVE_CHILD;
  sup1_Y.is_rotating180 = false;
  sup1_Y.invert_y = false;
  sup1_DW.is_c9_sup1 = sup1_IN_Procedura_emergency_st;
  sup1_Y.estop_recover_enabled = false;
  sup1_DW.is_Procedura_emergency_stop = sup1_IN_In_frenata_di_emergenz;
  sup1_DW.durationCounter_1_h = 0U;
  sup1_Y.current_action = CMD_ESTOP;
  sup1_Y.v_ref = 0.0;
  sup1_Y.omega_ref = 0.0;
  sup1_Y.actuate_emergency_stop = true;
}

/* Function for Chart: '<S5>/Motion_Supervision' */
static void sup1_Normale_marcia(void)
{
  boolean_T forward = (boolean_T)(sup1_Y.v_user > 0.0);
  if (forward && (sup1_U.cmd == CMD_GO_LEFT)) {
    sup1_enter_marcia(sup1_IN_Schivata_a_sinistra, CMD_GO_LEFT);
  } else if (forward && (sup1_U.cmd == CMD_AVOID_LEFT)) {
    sup1_enter_marcia(sup1_IN_Evita_sinistra, CMD_AVOID_LEFT);
  } else if (forward && (sup1_U.cmd == CMD_AVOID_RIGHT)) {
    sup1_enter_marcia(sup1_IN_Evita_destra, CMD_AVOID_RIGHT);
  } else if (forward && (sup1_U.cmd == CMD_GO_RIGHT)) {
    sup1_enter_marcia(sup1_IN_Schivata_a_destra, CMD_GO_RIGHT);
  } else if ((sup1_U.y_norm < -0.5) && (!sup1_Y.backward_enabled)) {
    sup1_enter_marcia(sup1_IN_Retromarcia_180, CMD_ROTATE_180);
    sup1_Y.is_rotating180 = true;
    sup1_Y.targetAngle180 = sup1_U.current_yaw + 180.0;
    if (sup1_Y.targetAngle180 > 360.0) {
      sup1_Y.targetAngle180 -= 360.0;
    }

    sup1_Y.angle_err = sup1_angleError(sup1_U.current_yaw, sup1_Y.targetAngle180);
  } else {
    if (sup1_Y.backward_enabled || (sup1_U.y_norm > 0.0)) {
      sup1_Y.v_ref = sup1_Y.v_user;
    } else {
      sup1_Y.v_ref = 0.0;
    }

    sup1_Y.omega_ref = sup1_Y.omega_user;
  }
}

/* Function for Chart: '<S5>/Motion_Supervision' */
static void sup1_Retromarcia_180(void)
{
  real_T err = fabs(sup1_Y.angle_err);
  if (err < 7.5) {
    if (sup1_Y.v_user < 0.0) {
      sup1_Y.invert_y = true;
    }

    sup1_Y.is_rotating180 = false;
    sup1_enter_marcia(sup1_IN_Normale_marcia, CMD_NORMAL);
  } else {
    sup1_Y.angle_err = sup1_angleError(sup1_U.current_yaw, sup1_Y.targetAngle180);
    err = fabs(sup1_Y.angle_err);
    if (err > 45.0) {
      sup1_Y.omega_ref = sup1_sign(-sup1_Y.angle_err) * sup1_DW.omega_max;
    } else if (sup1_Y.rover_safety_state == SAFETY_OK) {
      sup1_Y.omega_ref = sup1_sign(-sup1_Y.angle_err) * fmin(sup1_DW.omega_max, 0.005 * fmax(err, 15.0));
    }
  }
}

/* Function for Chart: '<S5>/Motion_Supervision' */
static void sup1_Stato_marcia_rover(void)
{
  boolean_T collision = (boolean_T)((sup1_U.cmd == CMD_ESTOP) && (sup1_Y.v_user > 0.0));
  if ((collision && (!sup1_Y.is_rotating180)) || (sup1_Y.rover_safety_state == SAFETY_CRITICAL)) {
    sup1_enter_emergency();
  } else {
    sup1_updateUser();
    switch (sup1_DW.is_Stato_marcia_rover) {
     case sup1_IN_Normale_marcia:
      sup1_Normale_marcia();
      break;

     case sup1_IN_Retromarcia_180:
      sup1_Retromarcia_180();
      break;

     case sup1_IN_Evita_destra:
      if (sup1_U.cmd == CMD_NORMAL) {
        sup1_enter_marcia(sup1_IN_Normale_marcia, CMD_NORMAL);
      } else {
        sup1_Y.v_ref = sup1_Y.v_user;
        sup1_Y.omega_ref = fmax(sup1_Y.omega_user, 0.0);
      }
      break;

     case sup1_IN_Evita_sinistra:
      if (sup1_U.cmd == CMD_NORMAL) {
        sup1_enter_marcia(sup1_IN_Normale_marcia, CMD_NORMAL);
      } else {
        sup1_Y.v_ref = sup1_Y.v_user;
        sup1_Y.omega_ref = fmin(sup1_Y.omega_user, 0.0);
      }
      break;

     case sup1_IN_Schivata_a_destra:
      if (sup1_U.cmd == CMD_NORMAL) {
        sup1_enter_marcia(sup1_IN_Normale_marcia, CMD_NORMAL);
      } else {
        sup1_Y.v_ref = fmin(sup1_Y.v_user, sup1_DW.v_max_maneuver);
        sup1_Y.omega_ref = fmin(sup1_Y.omega_user, sup1_DW.omega_go_right);
      }
      break;

     default:
      /* case IN_Schivata_a_sinistra: */
      if (sup1_U.cmd == CMD_NORMAL) {
        sup1_enter_marcia(sup1_IN_Normale_marcia, CMD_NORMAL);
      } else {
        sup1_Y.v_ref = fmin(sup1_Y.v_user, sup1_DW.v_max_maneuver);
        sup1_Y.omega_ref = fmax(sup1_Y.omega_user, sup1_DW.omega_go_left);
      }
      break;
    }
  }
}

/* Function for Chart: '<S5>/Motion_Supervision' */
static void sup1_Procedura_emergency_stop(void)
{
  if ((sup1_Y.rover_safety_state != SAFETY_CRITICAL) && sup1_Y.estop_recover_enabled) {
    sup1_Y.actuate_emergency_stop = false;
    sup1_DW.is_Procedura_emergency_stop = sup1_IN_NO_ACTIVE_CHILD;
    sup1_updateUser();
    sup1_enter_marcia(sup1_IN_Normale_marcia, CMD_NORMAL);
  } else if (sup1_DW.is_Procedura_emergency_stop == sup1_IN_In_frenata_di_emergenz) {
    if (!sup1_Y.roverIsStopped) {
      sup1_DW.durationCounter_1_h = 0U;
    }

    if (sup1_DW.durationCounter_1_h > 50U) {
      sup1_DW.is_Procedura_emergency_stop = sup1_IN_Motori_fermi;
      sup1_Y.current_action = CMD_STOP;
      sup1_Y.estop_recover_enabled = true;
    } else {
      sup1_Y.roverIsStopped = sup1_checkStop();
    }
  }
}

/* Chart: '<S5>/Motion_Supervision' */
static void sup1_Motion_Supervision(void)
{
  if (sup1_DW.is_active_c9_sup1 == 0U) {
    sup1_DW.is_active_c9_sup1 = 1U;
    sup1_updateUser();
    sup1_enter_marcia(sup1_IN_Normale_marcia, CMD_NORMAL);
  } else if (sup1_DW.is_c9_sup1 == sup1_IN_Procedura_emergency_st) {
    sup1_Procedura_emergency_stop();
  } else {
    sup1_Stato_marcia_rover();
  }

  if (!sup1_Y.roverIsStopped) {
    sup1_DW.durationCounter_1_h = 0U;
  } else if (sup1_DW.durationCounter_1_h < 1000000U) {
    sup1_DW.durationCounter_1_h++;
  }
}

/* Model step function */
void sup1_step(void)
{
  int32_T i;

  /* Outputs for Atomic SubSystem: '<Root>/Monitors' */
  sup1_Monitor_temperature();
  sup1_Monitor_battery();
  for (i = 0; i < 4; i++) {
    sup1_Y.wheel_status[i] = sup1_Monitor_wheel(sup1_U.hasNoFeedback[i], sup1_U.isMotionConsistent);
  }

  sup1_Monitor_heartbeat();
  sup1_Monitor_reception();

  /* End of Outputs for SubSystem: '<Root>/Monitors' */
  sup1_Fault_masks();

  /* MATLAB Function: '<S3>/Process_B2_masks' */
  sup1_Y.b2_critical = (boolean_T)((sup1_U.crit_mask_b2 & 3U) != 0U);
  sup1_Y.b2_degraded = (boolean_T)(((sup1_U.crit_mask_b2 & 12U) != 0U) || (sup1_U.degr_mask_b2 != 0U));
  sup1_Relay();

  /* Outputs for Enabled SubSystem: '<Root>/References' */
  if (!sup1_Y.give_b2_actuation) {
    sup1_Safety_state();
    sup1_updateSafetyLimits();
    sup1_Backward_mode_toggle();
    sup1_Motion_Supervision();
  }
}

/* Model initialize function */
void sup1_initialize(void)
{
  (void)memset(&sup1_DW, 0, sizeof(DW_sup1_T));
  (void)memset(&sup1_U, 0, sizeof(ExtU_sup1_T));
  (void)memset(&sup1_Y, 0, sizeof(ExtY_sup1_T));
  sup1_DW.btn1_prev = true;
  sup1_DW.btn2_prev = true;
}
