/* What FMI 2.0 asks of a small co-simulation unit without states to save. The including file says
 * what the unit is: `COUNT` values, `guid`, the type `Unit`, and the functions declared here.
 */
#include "fmi2Functions.h"
#include <stdlib.h>
#include <string.h>

static double *values_of(Unit *unit);
/* Values before anything happened; parameters are kept. */
static void begin(Unit *unit);
/* As after instantiation, parameters included. */
static void restore_defaults(Unit *unit);
static int may_be_set(fmi2ValueReference reference, double value);
/* One communication step; of size zero it is not called. */
static void advance(Unit *unit, double step);

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String came, fmi2String location,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible,
                              fmi2Boolean logging) {
    (void)name, (void)location, (void)callbacks, (void)visible, (void)logging;
    if (type != fmi2CoSimulation || !came || strcmp(came, guid) != 0) return NULL;
    Unit *unit = calloc(1, sizeof(Unit));
    if (!unit) return NULL;
    restore_defaults(unit);
    begin(unit);
    return unit;
}
void fmi2FreeInstance(fmi2Component c) { free(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_given, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean end_given, fmi2Real end) {
    (void)c, (void)tolerance_given, (void)tolerance, (void)start, (void)end_given, (void)end;
    return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { (void)c; return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { begin(c); return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component c) { (void)c; return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) {
    restore_defaults(c);
    begin(c);
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Real v[]) {
    for (size_t i = 0; i < n; i++) {
        if (r[i] >= COUNT) return fmi2Error;
        v[i] = values_of(c)[r[i]];
    }
    return fmi2OK;
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Real v[]) {
    for (size_t i = 0; i < n; i++) {
        if (r[i] >= COUNT || !may_be_set(r[i], v[i])) return fmi2Error;
        values_of(c)[r[i]] = v[i];
    }
    return fmi2OK;
}
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean no_return) {
    (void)time, (void)no_return;
    if (!(step >= 0.0)) return fmi2Error;
    if (step > 0.0) advance(c, step);
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
