/* A fluid engine as a plugin: jets in closed form, as hapflow's own backend analytic-jet has them.
 *
 *     cc -std=c11 -O2 -shared -fPIC -Iinclude examples/plugins/jet_fluid.c -o libjet_fluid.so -lm
 *     hapflow run tap --coupling direct --plugin ./libjet_fluid.so
 *
 * A jet of diameter D and speed v0 falls freely, v(s)^2 = v0^2 + 2 g s, and A v stays A0 v0. A body takes density A' (v - u)^2
 * along the axis: A' is what its shadow covers of the jet, u its velocity along the axis. */
#include <hapflow/hapflow.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 32 }; /* looks at the jets in a frame */
static const double pi = 3.14159265358979323846;
static const double jump = 20; /* m/s: faster is no motion of a hand */

typedef struct jet_fluid {
    hapflow_fluid_config config;
    hapflow_fluid_source* sources;
    hapflow_fluid_body* bodies;
    double (*places)[3]; /* where each body is */
    double time_s;
} jet_fluid;

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Area of a disc of radius a that one of radius b covers, d apart. */
static double covered(double a, double b, double d) {
    if (d >= a + b) {
        return 0;
    }
    if (d <= fabs(a - b)) {
        return pi * fmin(a, b) * fmin(a, b);
    }
    const double half_a = acos(fmax(-1, fmin(1, (d * d + a * a - b * b) / (2 * d * a))));
    const double half_b = acos(fmax(-1, fmin(1, (d * d + b * b - a * a) / (2 * d * b))));
    return a * a * (half_a - sin(half_a) * cos(half_a)) + b * b * (half_b - sin(half_b) * cos(half_b));
}

static int runs(const hapflow_fluid_source* source, double time_s) {
    const double phase = source->period > 0 ? fmod(time_s, source->period) : 0;
    return source->on && (source->period <= 0 || phase < source->duty * source->period);
}

/* Adds the force of a jet on a ball to `force`. */
static void strike(const jet_fluid* fluid, const hapflow_fluid_source* source, double radius, const double place[3],
                   const double velocity[3], double force[3]) {
    const double* axis = source->direction;
    double from_outlet[3], aside[3];
    for (int i = 0; i < 3; i++) {
        from_outlet[i] = place[i] - source->position[i];
    }
    const double along = dot(from_outlet, axis);
    const double flow = pi / 4 * source->diameter * source->diameter * source->speed;
    const double square = source->speed * source->speed + 2 * dot(fluid->config.gravity, axis) * along;
    if (along <= 0 || flow <= 0 || square <= 0) {
        return;
    }
    for (int i = 0; i < 3; i++) {
        aside[i] = from_outlet[i] - along * axis[i];
    }
    const double speed = sqrt(square), relative = fmax(0, speed - dot(velocity, axis));
    const double area = covered(sqrt(flow / speed / pi), radius, sqrt(dot(aside, aside)));
    for (int i = 0; i < 3; i++) {
        force[i] += axis[i] * fluid->config.density * area * relative * relative;
    }
}

/* The path at `share` (0 to 1) of its span, linear between samples. */
static void along_path(const hapflow_fluid_motion* motion, double share, double place[3]) {
    const hapflow_fluid_sample* path = motion->path;
    const uint32_t last = motion->sample_count - 1;
    const double time_s = path[0].time_s + share * (path[last].time_s - path[0].time_s);
    uint32_t next = 0;
    while (next < last && path[next].time_s < time_s) {
        next++;
    }
    const hapflow_fluid_sample *b = &path[next], *a = &path[next > 0 ? next - 1 : 0];
    const double span = b->time_s - a->time_s, weight = span > 0 ? (time_s - a->time_s) / span : 1;
    for (int i = 0; i < 3; i++) {
        place[i] = a->position[i] + (b->position[i] - a->position[i]) * weight;
    }
}

/* Moves a body on by a share of the frame, and adds what it feels there. */
static void step_body(jet_fluid* fluid, uint32_t b, const hapflow_fluid_motion* motion, double share, double dt,
                      hapflow_fluid_load* load) {
    double place[3], velocity[3], force[3] = {0, 0, 0};
    along_path(motion, share, place);
    for (int i = 0; i < 3; i++) {
        velocity[i] = (place[i] - fluid->places[b][i]) / dt;
    }
    if (sqrt(dot(velocity, velocity)) > jump) {
        memset(velocity, 0, sizeof velocity);
    }
    memcpy(fluid->places[b], place, sizeof place);
    for (uint32_t s = 0; s < fluid->config.source_count; s++) {
        if (runs(&fluid->sources[s], fluid->time_s)) {
            strike(fluid, &fluid->sources[s], fluid->bodies[b].bounding_radius, place, velocity, force);
        }
    }
    for (int i = 0; i < 3; i++) {
        load->pressure_force[i] += fluid->config.two_way ? force[i] / SAMPLES : 0;
    }
}

static hapflow_result step(void* data, const hapflow_fluid_frame* frame, hapflow_fluid_result* result) {
    jet_fluid* fluid = data;
    const double dt = frame->duration_s / SAMPLES;
    for (uint32_t b = 0; b < frame->body_count; b++) {
        if (frame->motions[b].drive != HAPFLOW_MOTION_LED) {
            return HAPFLOW_ERROR_UNSUPPORTED;
        }
    }
    for (int k = 1; k <= SAMPLES; k++) {
        fluid->time_s += dt;
        for (uint32_t b = 0; b < frame->body_count; b++) {
            step_body(fluid, b, &frame->motions[b], (double)k / SAMPLES, dt, &result->loads[b]);
        }
    }
    result->substeps = SAMPLES;
    return HAPFLOW_OK;
}

/* Copies the lists, as long as ever. */
static void take(jet_fluid* fluid, const hapflow_fluid_config* config) {
    fluid->config = *config;
    if (config->source_count > 0) {
        memcpy(fluid->sources, config->sources, config->source_count * sizeof *config->sources);
    }
    if (config->body_count > 0) {
        memcpy(fluid->bodies, config->bodies, config->body_count * sizeof *config->bodies);
    }
}

static hapflow_result refuse(const hapflow_fluid_config* config, char* reason, size_t capacity) {
    if (config->size < sizeof *config) {
        return HAPFLOW_ERROR_STRUCT;
    }
    if (config->pool_count > 0) {
        snprintf(reason, capacity, "no pools of fluid (only sources)");
        return HAPFLOW_ERROR_UNSUPPORTED;
    }
    return HAPFLOW_OK;
}

static hapflow_result configure(void* data, const hapflow_fluid_config* config, char* reason, size_t capacity) {
    const hapflow_result result = refuse(config, reason, capacity);
    if (result >= 0) {
        take(data, config);
    }
    return result;
}

static void destroy(void* data) {
    jet_fluid* fluid = data;
    free(fluid->sources);
    free(fluid->bodies);
    free(fluid->places);
    free(fluid);
}

static hapflow_result create(const hapflow_fluid_config* config, void** made, char* reason, size_t capacity) {
    const hapflow_result result = refuse(config, reason, capacity);
    if (result < 0) {
        return result;
    }
    jet_fluid* fluid = calloc(1, sizeof *fluid);
    if (fluid == NULL) {
        return HAPFLOW_ERROR_FULL;
    }
    /* One more than there are: none is no room. */
    fluid->sources = calloc(config->source_count + 1u, sizeof *fluid->sources);
    fluid->bodies = calloc(config->body_count + 1u, sizeof *fluid->bodies);
    fluid->places = calloc(config->body_count + 1u, sizeof *fluid->places);
    if (fluid->sources == NULL || fluid->bodies == NULL || fluid->places == NULL) {
        destroy(fluid);
        return HAPFLOW_ERROR_FULL;
    }
    take(fluid, config);
    for (uint32_t b = 0; b < config->body_count; b++) {
        memcpy(fluid->places[b], config->bodies[b].position, sizeof fluid->places[b]);
    }
    *made = fluid;
    return HAPFLOW_OK;
}

static const hapflow_fluid_backend_extension table = {
    .size = sizeof table,
    .name = "jet-fluid",
    .create = create,
    .configure = configure,
    .step = step,
    .destroy = destroy,
};

const void* hapflow_extension(const char* name) {
    return strcmp(name, HAPFLOW_EXTENSION_FLUID_BACKEND) == 0 ? &table : NULL;
}
