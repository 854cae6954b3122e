// A host in real time: a servo loop at 1 kHz in the main thread, and the fluid in a thread of its own. Prints the force
// a few times a second.
//
//     c++ -std=c++17 -pthread -Iinclude -Icpp/include examples/host_loop.cpp -Ltarget/release -lhapflow -o host_loop
//     LD_LIBRARY_PATH=target/release ./host_loop 5
//     ./host_loop 5 "fluid.spacing = 0.01"        seconds, and settings on top of the scene, one a line
#include <hapflow/hapflow.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>

using Clock = std::chrono::steady_clock; // never goes back
using Seconds = std::chrono::duration<double>;

// Where the hand is at `time_s`: it bobs a centimetre down and up once a second. A real host asks its device instead.
static hapflow::ToolState hand(double time_s, double dt_s) {
    const double s = time_s - std::floor(time_s);
    hapflow::ToolState state;
    state.time_s = time_s;
    state.dt_s = dt_s;
    state.position[1] = -0.16 * (s * s) * ((1 - s) * (1 - s));
    state.velocity[1] = -0.32 * s * (1 - s) * (1 - 2 * s);
    return state;
}

static void print(const hapflow::Report& r) {
    std::printf("%7.3f s  force %7.3f %7.3f %7.3f N  ticks %llu  frames %llu  faults %#x\n", r.time_s, r.force[0],
                r.force[1], r.force[2], 0ULL + r.tick, 0ULL + r.fluid_frame, r.faults);
}

// The fluid's thread: one frame each period, and whatever may block, such as printing.
static void run_fluid(hapflow::Session& session, Clock::time_point start, const std::atomic<bool>& running) {
    const Seconds period(1 / session.get("run.fluid_hz"));
    Clock::time_point next = start;
    for (int frame = 1; running; frame++) {
        next += std::chrono::duration_cast<Clock::duration>(period);
        std::this_thread::sleep_until(next);
        const Clock::time_point now = Clock::now();
        if (now - next > period) next = now; // too slow: what was missed is left out, not made up for
        session.fluid_step(Seconds(now - start).count());
        if (frame % 25 == 0) print(session.report());
    }
}

static void run(double seconds, const char* settings) {
    hapflow::Config config;
    config.scene = "tap";
    config.settings = settings;
    hapflow::Session session(config);

    const Clock::time_point start = Clock::now();
    std::atomic<bool> running{true};
    std::exception_ptr failure; // of the fluid; read after the join
    std::thread fluid([&] {
        try {
            run_fluid(session, start, running);
        } catch (...) {
            session.emergency_stop(); // no force from a fluid that stands still
            failure = std::current_exception();
            running = false;
        }
    });

    // The servo. Nothing in here waits, allocates or throws; a real host also raises this thread's priority.
    double last_s = 0;
    for (Clock::time_point next = start; running && last_s < seconds; next += std::chrono::milliseconds(1)) {
        std::this_thread::sleep_until(next);
        const double now_s = Seconds(Clock::now() - start).count();
        const hapflow::Tick tick = session.tick(hand(now_s, now_s - last_s));
        last_s = now_s;
        if (!tick.ok()) session.emergency_stop(); // and tick.wrench, which goes to the device here, is zero
    }
    running = false;
    fluid.join();
    if (failure) std::rethrow_exception(failure);
    print(session.report());
}

int main(int argc, char** argv) try {
    run(argc > 1 ? std::atof(argv[1]) : 5, argc > 2 ? argv[2] : "");
} catch (const std::exception& error) {
    std::fprintf(stderr, "host_loop: %s\n", error.what());
    return 1;
}
