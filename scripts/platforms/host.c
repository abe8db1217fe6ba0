/* A host in miniature: runs the FMU's library of one platform and prints every answer bit by bit.
 *
 *   host LIBRARY RESOURCES GUID INPUT LOAD ROWS values|slopes
 *
 * LIBRARY is binaries/PLATFORM/IwanJoint.*, RESOURCES the folder with joint.json as a path, INPUT the
 * value reference of the input, LOAD a text file with one sample per line: time, input and the
 * input's derivatives of orders 1 to 3 from there on, as 16 hexadecimal digits each, the bits of a
 * double. Texts of numbers and the sine of a C library differ between systems; bits do not. With
 * `values` each step ends at the next sample, with `slopes` it follows the derivatives. Half-way the
 * state is saved, serialized and continued in a second instance.
 *
 * Output: per sample the bits of references 0 to 6. Exit status 0, or 1 with a message.
 */
#include "host.h"

enum { CO_SIMULATION = 1 };

typedef struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*step_finished)(void *, int);
    void *environment;
} Callbacks;

static void logger(void *environment, const char *instance, int status, const char *category,
                   const char *message, ...) {
    (void)environment;
    fprintf(stderr, "%s: %s (%d): %s\n", instance, category, status, message);
}

static void *instance(const char *name, const char *guid, const char *uri, Callbacks *callbacks) {
    void *(*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int);
    *(void **)&instantiate = find("fmi2Instantiate");
    void *made = instantiate(name, CO_SIMULATION, guid, uri, callbacks, 0, 0);
    if (!made) stop("refused:", "fmi2Instantiate");
    return made;
}

int main(int count, char **arguments) {
    if (count != 8) stop("usage:", "host LIBRARY RESOURCES GUID INPUT LOAD ROWS values|slopes");
    library = open_library(arguments[1]);
    if (!library) stop("cannot load", arguments[1]);
    const unsigned input = (unsigned)strtoul(arguments[4], NULL, 10);
    FILE *load = fopen(arguments[5], "r");
    if (!load) stop("cannot open", arguments[5]);
    long half = strtol(arguments[6], NULL, 10) / 2;
    int slopes = strcmp(arguments[7], "slopes") == 0;

    int (*setup)(void *, int, double, double, int, double);
    int (*enter)(void *), (*leave)(void *), (*terminate)(void *);
    int (*set)(void *, const unsigned *, size_t, const double *);
    int (*derive)(void *, const unsigned *, size_t, const int *, const double *);
    int (*get)(void *, const unsigned *, size_t, double *);
    int (*step)(void *, double, double, int);
    int (*get_state)(void *, void **), (*set_state)(void *, void *), (*free_state)(void *, void **);
    int (*size_of_state)(void *, void *, size_t *);
    int (*serialize)(void *, void *, char *, size_t);
    int (*deserialize)(void *, const char *, size_t, void **);
    void (*release)(void *);
    *(void **)&setup = find("fmi2SetupExperiment");
    *(void **)&enter = find("fmi2EnterInitializationMode");
    *(void **)&leave = find("fmi2ExitInitializationMode");
    *(void **)&terminate = find("fmi2Terminate");
    *(void **)&set = find("fmi2SetReal");
    *(void **)&derive = find("fmi2SetRealInputDerivatives");
    *(void **)&get = find("fmi2GetReal");
    *(void **)&step = find("fmi2DoStep");
    *(void **)&get_state = find("fmi2GetFMUstate");
    *(void **)&set_state = find("fmi2SetFMUstate");
    *(void **)&free_state = find("fmi2FreeFMUstate");
    *(void **)&size_of_state = find("fmi2SerializedFMUstateSize");
    *(void **)&serialize = find("fmi2SerializeFMUstate");
    *(void **)&deserialize = find("fmi2DeSerializeFMUstate");
    *(void **)&release = find("fmi2FreeInstance");

    char uri[4096];
    int windows_drive = arguments[2][0] != '/';
    snprintf(uri, sizeof uri, windows_drive ? "file:///%s" : "file://%s", arguments[2]);
    Callbacks callbacks = {logger, calloc, free, NULL, NULL};
    void *unit = instance("host", arguments[3], uri, &callbacks);

    const unsigned all[SIGNALS] = {0, 1, 2, 3, 4, 5, 6}, inputs[ORDERS] = {input, input, input};
    const int orders[ORDERS] = {1, 2, 3};
    double before[SAMPLE], now[SAMPLE], answers[SIGNALS];
    for (long row = 0; sample(load, now); row++) {
        if (row == 0) {
            expect(setup(unit, 0, 0.0, now[0], 0, 0.0), "fmi2SetupExperiment");
            expect(enter(unit), "fmi2EnterInitializationMode");
            expect(set(unit, &input, 1, &now[1]), "fmi2SetReal");
            expect(leave(unit), "fmi2ExitInitializationMode");
        } else {
            expect(set(unit, &input, 1, slopes ? &before[1] : &now[1]), "fmi2SetReal");
            if (slopes)
                expect(derive(unit, inputs, ORDERS, orders, &before[2]),
                       "fmi2SetRealInputDerivatives");
            expect(step(unit, before[0], now[0] - before[0], 1), "fmi2DoStep");
        }
        memcpy(before, now, sizeof before);
        expect(get(unit, all, SIGNALS, answers), "fmi2GetReal");
        print(answers);
        if (row == half) {
            void *state = NULL;
            size_t size = 0;
            expect(get_state(unit, &state), "fmi2GetFMUstate");
            expect(size_of_state(unit, state, &size), "fmi2SerializedFMUstateSize");
            char *bytes = malloc(size);
            if (!bytes) stop("no memory for", "the state");
            expect(serialize(unit, state, bytes, size), "fmi2SerializeFMUstate");
            expect(free_state(unit, &state), "fmi2FreeFMUstate");
            release(unit);
            unit = instance("second", arguments[3], uri, &callbacks);
            expect(deserialize(unit, bytes, size, &state), "fmi2DeSerializeFMUstate");
            expect(set_state(unit, state), "fmi2SetFMUstate");
            expect(free_state(unit, &state), "fmi2FreeFMUstate");
            free(bytes);
        }
    }
    expect(terminate(unit), "fmi2Terminate");
    release(unit);
    return 0;
}
