/* Two bodies that a joint holds together, as one FMI 2.0 co-simulation unit: mu x'' = -force, where
 * x is the distance by which the joint is strained and mu the reduced mass. Leapfrog: no energy
 * comes or goes but by the joint, which is driven in displacement and answers with the force.
 *
 * A master that lets all units step at once hands each output on one step late. The joint would then
 * lag behind the bodies and feed energy into them (a damping ratio of -pi per steps in a period). So
 * there is a second output, displacement_ahead: where the bodies will be one step later, with the
 * force carried on in a straight line. The joint is driven by that one.
 */
enum { FORCE, DISPLACEMENT, AHEAD, VELOCITY, REDUCED_MASS, START_VELOCITY, COUNT };
static const char *const guid = "b1d7c0f4-6f0e-4d5e-9a39-2f6d6b1a7c01";

typedef struct {
    double values[COUNT];
    double half_velocity; /* in the middle of the last step */
    double force_before;  /* at the last communication point */
    double step_before;
    int running;
} Unit;

#include "unit.h"

static double *values_of(Unit *b) { return b->values; }

static void restore_defaults(Unit *b) {
    b->values[REDUCED_MASS] = 7.0;
    b->values[START_VELOCITY] = 0.023;
}

static void begin(Unit *b) {
    b->values[DISPLACEMENT] = b->values[AHEAD] = b->values[FORCE] = 0.0;
    b->values[VELOCITY] = b->half_velocity = b->values[START_VELOCITY];
    b->force_before = b->step_before = 0.0;
    b->running = 0;
}

static int may_be_set(fmi2ValueReference r, double value) {
    return r == FORCE || r == START_VELOCITY || (r == REDUCED_MASS && value > 0.0);
}

static void predict(Unit *b, double step) {
    double mass = b->values[REDUCED_MASS], force = b->values[FORCE];
    /* The force at the end of the step just taken is not known yet. */
    double carried = b->running ? 2.0 * force - b->force_before : force;
    double ahead = b->half_velocity - step * carried / mass;
    b->values[VELOCITY] = b->half_velocity - 0.5 * step * carried / mass;
    b->values[AHEAD] = b->values[DISPLACEMENT] + step * ahead;
}

static void advance(Unit *b, double step) {
    double between = 0.5 * (b->step_before + step);
    b->half_velocity -= between * b->values[FORCE] / b->values[REDUCED_MASS];
    b->values[DISPLACEMENT] += step * b->half_velocity;
    predict(b, step);
    b->force_before = b->values[FORCE];
    b->step_before = step;
    b->running = 1;
}
