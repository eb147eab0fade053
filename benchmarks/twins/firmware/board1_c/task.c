/*
 * File: task.c
 *
 * The task that calls sup1_step every 20 ms: it takes over what the drivers received since the step before.
 */
#include "sup1.h"

TaskInputs task_in;

/* The alive counter of the last heartbeat, and when one with another counter arrived */
static uint32_T task_counter;
static uint32_T task_heartbeat_ms;

void task_initialize(void)
{
  task_counter = 0U;
  task_heartbeat_ms = 0U;
  sup1_initialize();
}

static void task_heartbeat(void)
{
  if (task_in.heartbeat_counter != task_counter) {
    task_counter = task_in.heartbeat_counter;
    task_heartbeat_ms = task_in.heartbeat_arrival_ms;
  }
}

void task_20ms(void)
{
  task_heartbeat();
  sup1_U.now_ms = task_in.now_ms;
  sup1_U.last_valid_b2_ms = task_heartbeat_ms;
  sup1_U.b2_data_last_valid_ms = task_in.data_arrival_ms;
  sup1_U.temp_last_valid_ms = task_in.temp_read_ms;
  sup1_U.batt_last_valid_ms = task_in.batt_read_ms;
  sup1_step();
}
