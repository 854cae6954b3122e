/* hapflow: lets a hand feel a fluid. The C interface of libhapflow, C11 and C++17. These headers are the contract.
 *
 * Life of a session
 * -----------------
 *     uint32_t version;
 *     hapflow_negotiate(HAPFLOW_ABI_VERSION, HAPFLOW_ABI_VERSION, &version);   before anything else
 *     hapflow_session_config config;
 *     hapflow_session_config_init(&config, sizeof config);
 *     config.scene = "tap";                                                    or config.toml = "..."
 *     hapflow_session session;
 *     hapflow_session_create(&config, &session);
 *     for (each tick at about 1 kHz) {                                         the host's loop
 *         hapflow_fluid_advance(session, state.time_s);                        here, or in a thread of its own
 *         hapflow_servo_tick(session, &state, &wrench);                        wrench.force goes to the device
 *     }
 *     hapflow_session_destroy(session);
 *
 * With config.fluid_drive = HAPFLOW_DRIVE_OWNED the session steps the fluid in a thread of its own, which keeps the
 * time of the ticks: the loop is then hapflow_servo_tick alone. With config.servo_drive = HAPFLOW_DRIVE_OWNED it ticks
 * the servo as well, in a real-time thread for each device.
 *
 * Each noun has a header of its own, and may be included by itself; base.h has what holds for all of them: thread
 * classes, results, pointers, structs.
 *
 * What is optional is asked for by name and revision, as "hapflow.device/1": extension.h. What a plugin of hapflow has to
 * bring is in fluid_backend.h and coupling.h.
 */
#ifndef HAPFLOW_HAPFLOW_H
#define HAPFLOW_HAPFLOW_H

#include <hapflow/base.h>
#include <hapflow/result.h>
#include <hapflow/version.h>
#include <hapflow/build.h>
#include <hapflow/scene.h>
#include <hapflow/device.h>
#include <hapflow/session.h>
#include <hapflow/setting.h>
#include <hapflow/tool_state.h>
#include <hapflow/wrench.h>
#include <hapflow/servo.h>
#include <hapflow/fluid.h>
#include <hapflow/obstacle.h>
#include <hapflow/body.h>
#include <hapflow/report.h>
#include <hapflow/log.h>
#include <hapflow/extension.h>
#include <hapflow/fluid_backend.h>
#include <hapflow/coupling.h>
#include <hapflow/contact.h>
#include <hapflow/recording.h>

#endif
