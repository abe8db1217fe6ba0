/* Two bodies that a joint holds together, as one FMI 2.0 co-simulation unit: mu x'' = -force, where
 * x is the distance by which the joint is strained and mu the reduced mass. Leapfrog: no energy
 * comes or goes but by the joint.
 *
 * A master that lets all units step at once hands each output on one step late. The joint would then
 * lag behind the bodies and feed energy into them (a damping ratio of -pi per steps in a period). So
 * there is a second output, displacement_ahead: where the bodies will be one step later, with the
 * force carried on in a straight line. The joint is driven by that one.
 */
#include "fmi2Functions.h"
#include <stdlib.h>
#include <string.h>

enum { FORCE, DISPLACEMENT, AHEAD, VELOCITY, REDUCED_MASS, START_VELOCITY, COUNT };

static const char *const guid = "b1d7c0f4-6f0e-4d5e-9a39-2f6d6b1a7c01";

typedef struct {
    double values[COUNT];
    double half_velocity; /* in the middle of the last step */
    double force_before;  /* at the last communication point */
    double step_before;
    int running;
} Bodies;

static void predict(Bodies *b, double step) {
    double mass = b->values[REDUCED_MASS], force = b->values[FORCE];
    /* The force at the end of the step just taken is not known yet. */
    double carried = b->running ? 2.0 * force - b->force_before : force;
    double ahead = b->half_velocity - step * carried / mass;
    b->values[VELOCITY] = b->half_velocity - 0.5 * step * carried / mass;
    b->values[AHEAD] = b->values[DISPLACEMENT] + step * ahead;
}

static void start(Bodies *b) {
    b->values[DISPLACEMENT] = b->values[AHEAD] = b->values[FORCE] = 0.0;
    b->values[VELOCITY] = b->half_velocity = b->values[START_VELOCITY];
    b->force_before = b->step_before = 0.0;
    b->running = 0;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String came, fmi2String location,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible,
                              fmi2Boolean logging) {
    (void)name, (void)location, (void)callbacks, (void)visible, (void)logging;
    if (type != fmi2CoSimulation || !came || strcmp(came, guid) != 0) return NULL;
    Bodies *b = calloc(1, sizeof *b);
    if (!b) return NULL;
    b->values[REDUCED_MASS] = 7.0;
    b->values[START_VELOCITY] = 0.023;
    start(b);
    return b;
}
void fmi2FreeInstance(fmi2Component c) { free(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_given, fmi2Real tolerance,
                               fmi2Real begin, fmi2Boolean end_given, fmi2Real end) {
    (void)c, (void)tolerance_given, (void)tolerance, (void)begin, (void)end_given, (void)end;
    return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { (void)c; return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { start(c); return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component c) { (void)c; return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) { start(c); return fmi2OK; }

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Real v[]) {
    for (size_t i = 0; i < n; i++) {
        if (r[i] >= COUNT) return fmi2Error;
        v[i] = ((Bodies *)c)->values[r[i]];
    }
    return fmi2OK;
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Real v[]) {
    for (size_t i = 0; i < n; i++) {
        int settable = r[i] == FORCE || r[i] == REDUCED_MASS || r[i] == START_VELOCITY;
        if (!settable || (r[i] == REDUCED_MASS && !(v[i] > 0.0))) return fmi2Error;
        ((Bodies *)c)->values[r[i]] = v[i];
    }
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean no_return) {
    Bodies *b = c;
    (void)time, (void)no_return;
    if (!(step >= 0.0)) return fmi2Error;
    if (step == 0.0) return fmi2OK;
    double between = 0.5 * (b->step_before + step);
    b->half_velocity -= between * b->values[FORCE] / b->values[REDUCED_MASS];
    b->values[DISPLACEMENT] += step * b->half_velocity;
    predict(b, step);
    b->force_before = b->values[FORCE];
    b->step_before = step;
    b->running = 1;
    return fmi2OK;
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String k[]) {
    (void)c, (void)on, (void)n, (void)k;
    return fmi2OK;
}
fmi2Status fmi2CancelStep(fmi2Component c) { (void)c; return fmi2Error; }

/* What this unit does not have; some importers want every function to be there. */
#define NO_VARIABLES(kind, type)                                                                    \
    fmi2Status fmi2Get##kind(fmi2Component c, const fmi2ValueReference r[], size_t n, type v[]) {   \
        (void)c, (void)r, (void)v;                                                                  \
        return n ? fmi2Error : fmi2OK;                                                              \
    }                                                                                               \
    fmi2Status fmi2Set##kind(fmi2Component c, const fmi2ValueReference r[], size_t n,               \
                             const type v[]) {                                                      \
        (void)c, (void)r, (void)v;                                                                  \
        return n ? fmi2Error : fmi2OK;                                                              \
    }                                                                                               \
    fmi2Status fmi2Get##kind##Status(fmi2Component c, const fmi2StatusKind s, type *v) {            \
        (void)c, (void)s, (void)v;                                                                  \
        return fmi2Error;                                                                           \
    }
NO_VARIABLES(Integer, fmi2Integer)
NO_VARIABLES(Boolean, fmi2Boolean)
NO_VARIABLES(String, fmi2String)
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *v) {
    (void)c, (void)s, (void)v;
    return fmi2Error;
}
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *v) {
    (void)c, (void)s, (void)v;
    return fmi2Error;
}
fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *s) { (void)c, (void)s; return fmi2Error; }
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate s) { (void)c, (void)s; return fmi2Error; }
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *s) { (void)c, (void)s; return fmi2Error; }
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate s, size_t *n) {
    (void)c, (void)s, (void)n;
    return fmi2Error;
}
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate s, fmi2Byte b[], size_t n) {
    (void)c, (void)s, (void)b, (void)n;
    return fmi2Error;
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte b[], size_t n, fmi2FMUstate *s) {
    (void)c, (void)b, (void)n, (void)s;
    return fmi2Error;
}
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference u[], size_t nu,
                                        const fmi2ValueReference k[], size_t nk,
                                        const fmi2Real dk[], fmi2Real du[]) {
    (void)c, (void)u, (void)nu, (void)k, (void)nk, (void)dk, (void)du;
    return fmi2Error;
}
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n,
                                       const fmi2Integer o[], const fmi2Real v[]) {
    (void)c, (void)r, (void)n, (void)o, (void)v;
    return fmi2Error;
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n,
                                        const fmi2Integer o[], fmi2Real v[]) {
    (void)c, (void)r, (void)n, (void)o, (void)v;
    return fmi2Error;
}
