/* What holds for all of the C interface of libhapflow. Part of <hapflow/hapflow.h>.
 *
 * Every function says how it may be called, with one of these classes:
 *
 *     [main]      may block and allocate. One thread at a time a session or scene; it need not always be the same.
 *     [servo]     wait-free: no lock, no allocation, no system call, no log. One thread at a time a tool or device.
 *     [fluid]     computes, for milliseconds. One thread at a time a session.
 *     [obstacle]  wait-free, as [servo]. One thread at a time a session.
 *     [any]       lock-free, by any number of threads at once.
 *
 * Functions of different classes may run at the same time on the same session, and so may ticks of different tools.
 * Two threads in functions of one class and session ([any] apart), in ticks of one tool, or with one device, are an
 * error of the host that is found: the second gets HAPFLOW_ERROR_BUSY, and zero force. Different sessions know nothing
 * of each other.
 *
 * Rules for all functions
 * -----------------------
 * - Results: negative, it failed; zero, it is done; positive, it is done and there is a remark.
 * - On failure outputs are untouched. But a hapflow_wrench is always written, and is then zero.
 * - Everything is SI and double, right-handed, y up. Quaternions are x, y, z, w.
 * - A pointer must not be null unless its function says so (HAPFLOW_ERROR_NULL). It need not be aligned. What a
 *   pointer points to is the caller's, and is not looked at after the call (hapflow_session_config.log_user never is). Texts are UTF-8 and end with a NUL.
 * - Texts that the library shows are its own, never change, and last as long as is said where they stand.
 * - A number that is NaN or infinite is refused, everywhere (HAPFLOW_ERROR_NOT_FINITE).
 * - Handles are values. A stale one is refused (HAPFLOW_ERROR_HANDLE), as is zero, which is null.
 * - Structs that begin with a size are made by their init function, with their sizeof; configurations begin with
 *   kind, size and next. A published struct only grows at its end: a program that was compiled with an older header
 *   keeps working, and what it does not know has its default.
 * - No panic of the library's Rust code leaves it: HAPFLOW_ERROR_PANIC, zero force, and the session is faulted.
 *   (Out of memory, as in all Rust, the process ends.)
 * - Numbers of results, kinds and faults are never used again for something else.
 * - The library stays in memory once it is loaded; dlclose does not unload it.
 */
#ifndef HAPFLOW_BASE_H
#define HAPFLOW_BASE_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define HAPFLOW_API __declspec(dllimport)
#else
#define HAPFLOW_API
#endif

/* For these headers alone: what they declare is C, and their structs are as large as the library's. */
#ifdef __cplusplus
#define HAPFLOW_BEGIN_DECLS extern "C" {
#define HAPFLOW_END_DECLS }
#define HAPFLOW_ASSERT_SIZE(type, bytes) static_assert(sizeof(type) == (bytes), #type)
#else
#define HAPFLOW_BEGIN_DECLS
#define HAPFLOW_END_DECLS
#define HAPFLOW_ASSERT_SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), #type)
#endif

#endif
