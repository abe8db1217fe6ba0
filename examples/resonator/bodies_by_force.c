/* The same two bodies for a joint that is driven in force: they say by which force they pull, and
 * the joint answers with its displacement u. mu x'' = -force by leapfrog as in bodies.c; the force
 * is the one for which u = x.
 *
 * That equation cannot be solved inside a master that never repeats a step. What such a master hands
 * over is one step old, and the force is wanted one step ahead: from u(t_n) under F(t_n) a secant
 * leads to F(t_n+2) = F(t_n) + k (x(t_n+2) - u(t_n)), k being the joint's stiffness over its last
 * step. An error of one step is known two steps later and taken back. A stiffness beyond the bounds
 * (just after a reversal, or while nothing moves) is the joint's initial one, a parameter.
 */
enum { JOINT, DISPLACEMENT, AHEAD, VELOCITY, REDUCED_MASS, START_VELOCITY, STIFFNESS, COUNT };
static const char *const guid = "6a5c0d1e-3a77-4c1b-8b0e-5d0b7f3a9c02";

typedef struct {
    double values[COUNT];
    double half_velocity;   /* in the middle of the last step */
    double force;           /* at the last communication point */
    double force_before;    /* one point earlier, */
    double joint_before;    /* and where the joint was under it */
    double step_before;
} Unit;

#include "unit.h"

static double *values_of(Unit *b) { return b->values; }

static void restore_defaults(Unit *b) {
    b->values[REDUCED_MASS] = 7.0;
    b->values[START_VELOCITY] = 0.023;
    b->values[STIFFNESS] = 15e6 * 40e6 / (15e6 + 40e6);
}

static void begin(Unit *b) {
    b->values[DISPLACEMENT] = b->values[AHEAD] = b->values[JOINT] = 0.0;
    b->values[VELOCITY] = b->half_velocity = b->values[START_VELOCITY];
    b->force = b->force_before = b->joint_before = b->step_before = 0.0;
}

static int may_be_set(fmi2ValueReference r, double value) {
    int positive = r == REDUCED_MASS || r == STIFFNESS;
    return r == JOINT || r == START_VELOCITY || (positive && value > 0.0);
}

static double stiffness(const Unit *b) {
    double initial = b->values[STIFFNESS], moved = b->values[JOINT] - b->joint_before;
    double secant = moved != 0.0 ? (b->force - b->force_before) / moved : initial;
    return secant > 0.3 * initial && secant < initial ? secant : initial;
}

static void advance(Unit *b, double step) {
    double mass = b->values[REDUCED_MASS], joint = b->values[JOINT];
    double between = 0.5 * (b->step_before + step);
    b->half_velocity -= between * b->force / mass;
    b->values[DISPLACEMENT] += step * b->half_velocity;
    /* What was said for the end of this step is the force there. */
    double now = b->values[AHEAD];
    double next = b->values[DISPLACEMENT] + step * (b->half_velocity - step * now / mass);
    b->values[VELOCITY] = b->half_velocity - 0.5 * step * now / mass;
    b->values[AHEAD] = b->force + stiffness(b) * (next - joint);
    b->force_before = b->force;
    b->joint_before = joint;
    b->force = now;
    b->step_before = step;
}
