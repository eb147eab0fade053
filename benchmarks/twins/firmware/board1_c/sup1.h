/*
 * File: sup1.h
 *
 * Code generated for Simulink model 'sup1'.
 *
 * Model version                  : 4.117
 * Target selection: ert.tlc
 */
#ifndef RTW_HEADER_sup1_h_
#define RTW_HEADER_sup1_h_

#include <stdint.h>

typedef double real_T;
typedef int32_t int32_T;
typedef uint8_t uint8_T;
typedef uint16_t uint16_T;
typedef uint32_t uint32_T;
typedef unsigned char boolean_T;

#ifndef false
#define false (0U)
#define true (1U)
#endif

typedef uint8_T Level;
#define Level_OK ((Level)0U)
#define Level_DEGRADED ((Level)1U)
#define Level_CRITICAL ((Level)2U)

typedef uint8_T SafetyState;
#define SAFETY_OK ((SafetyState)0U)
#define SAFETY_DEGRADED ((SafetyState)1U)
#define SAFETY_CRITICAL ((SafetyState)2U)

typedef uint8_T SupervisorCommand;
#define CMD_NORMAL ((SupervisorCommand)0U)
#define CMD_ROTATE_180 ((SupervisorCommand)1U)
#define CMD_GO_LEFT ((SupervisorCommand)2U)
#define CMD_GO_RIGHT ((SupervisorCommand)3U)
#define CMD_AVOID_RIGHT ((SupervisorCommand)4U)
#define CMD_AVOID_LEFT ((SupervisorCommand)5U)
#define CMD_STOP ((SupervisorCommand)6U)
#define CMD_ESTOP ((SupervisorCommand)7U)

/* Record of the intervals between updates */
typedef struct {
  uint32_T Interval[10];
  uint32_T Last;
  uint8_T Index;
  uint8_T Count;
  boolean_T Updated;
} DW_MeanInterval_T;

/* Time since an update */
typedef struct {
  uint32_T Stamp;
  uint32_T Elapsed;
} DW_Age_T;

/* Debounced condition */
typedef struct {
  uint32_T Since;
  boolean_T Running;
  boolean_T Over;
} DW_Debounce_T;

/* Block signals and states */
typedef struct {
  DW_MeanInterval_T Heartbeat_mean;
  DW_MeanInterval_T Reception_mean;
  DW_Age_T Temperature_age;
  DW_Age_T Battery_age;
  DW_Age_T Heartbeat_age;
  DW_Age_T Reception_age;
  DW_Debounce_T Temperature_debounce;
  DW_Debounce_T Battery_debounce;
  real_T v_max;
  real_T omega_max;
  real_T v_max_maneuver;
  real_T omega_go_left;
  real_T omega_go_right;
  uint32_T durationCounter_1;
  uint32_T durationCounter_1_h;
  uint16_T temporalCounter_i1;
  uint8_T is_active_c3_sup1;
  uint8_T is_c3_sup1;
  uint8_T is_active_c5_sup1;
  uint8_T is_c5_sup1;
  uint8_T is_c7_sup1;
  uint8_T is_active_c9_sup1;
  uint8_T is_c9_sup1;
  uint8_T is_Stato_marcia_rover;
  uint8_T is_Procedura_emergency_stop;
  boolean_T btn1_prev;
  boolean_T btn2_prev;
} DW_sup1_T;

/* External inputs */
typedef struct {
  uint32_T now_ms;
  uint32_T last_valid_b2_ms;
  uint32_T b2_data_last_valid_ms;
  uint32_T temp_last_valid_ms;
  uint32_T batt_last_valid_ms;
  real_T temperature_degC;
  real_T battery_pct;
  real_T wheel_speed_rpm[4];
  boolean_T hasNoFeedback[4];
  SupervisorCommand cmd;
  real_T x_norm;
  real_T y_norm;
  real_T current_yaw;
  boolean_T btn1;
  boolean_T btn2;
  boolean_T isMotionConsistent;
  uint8_T crit_mask_b2;
  uint8_T degr_mask_b2;
} ExtU_sup1_T;

/* External outputs */
typedef struct {
  real_T v_ref;
  real_T omega_ref;
  real_T v_user;
  real_T omega_user;
  real_T targetAngle180;
  real_T angle_err;
  uint8_T critical_mask;
  uint8_T degraded_mask;
  SupervisorCommand current_action;
  Level temp_status;
  Level batt_status;
  Level wheel_status[4];
  Level b2_sup_status;
  Level rx_status;
  SafetyState rover_safety_state;
  boolean_T give_b2_actuation;
  boolean_T actuate_emergency_stop;
  boolean_T b2_critical;
  boolean_T b2_degraded;
  boolean_T backward_enabled;
  boolean_T invert_y;
  boolean_T is_rotating180;
  boolean_T estop_recover_enabled;
  boolean_T roverIsStopped;
} ExtY_sup1_T;

/* What the task receives between two steps */
typedef struct {
  uint32_T now_ms;
  uint32_T heartbeat_arrival_ms;
  uint32_T heartbeat_counter;
  uint32_T data_arrival_ms;
  uint32_T temp_read_ms;
  uint32_T batt_read_ms;
} TaskInputs;

extern ExtU_sup1_T sup1_U;
extern ExtY_sup1_T sup1_Y;
extern TaskInputs task_in;

extern void sup1_initialize(void);
extern void sup1_step(void);
extern void task_initialize(void);
extern void task_20ms(void);

#endif                                 /* RTW_HEADER_sup1_h_ */
