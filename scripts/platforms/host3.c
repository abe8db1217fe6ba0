/* The host of host.c under the functions of FMI 3.0: the same arguments, the same rows.
 *
 *   host3 LIBRARY RESOURCES TOKEN INPUT LOAD ROWS
 *
 * Each step ends at the next sample: FMI 3.0 hands no derivatives of an input over. RESOURCES goes to
 * the library as it is, a path that ends with a separator. Half-way the state is saved, serialized
 * and continued in a second instance. Early return is allowed, and none may come.
 */
#include "host.h"
#include <stdbool.h>

static void logger(void *environment, int status, const char *category, const char *message) {
    (void)environment;
    fprintf(stderr, "%s (%d): %s\n", category, status, message);
}

static void *instance(const char *name, const char *token, const char *resources) {
    void *(*instantiate)(const char *, const char *, const char *, bool, bool, bool, bool,
                         const uint32_t *, size_t, void *,
                         void (*)(void *, int, const char *, const char *), void *);
    *(void **)&instantiate = find("fmi3InstantiateCoSimulation");
    void *made = instantiate(name, token, resources, false, false, false, true, NULL, 0, NULL,
                             logger, NULL);
    if (!made) stop("refused:", "fmi3InstantiateCoSimulation");
    return made;
}

int main(int count, char **arguments) {
    if (count != 7) stop("usage:", "host3 LIBRARY RESOURCES TOKEN INPUT LOAD ROWS");
    library = open_library(arguments[1]);
    if (!library) stop("cannot load", arguments[1]);
    const uint32_t input = (uint32_t)strtoul(arguments[4], NULL, 10);
    FILE *load = fopen(arguments[5], "r");
    if (!load) stop("cannot open", arguments[5]);
    long half = strtol(arguments[6], NULL, 10) / 2;

    int (*enter)(void *, bool, double, double, bool, double);
    int (*leave)(void *), (*terminate)(void *);
    int (*set)(void *, const uint32_t *, size_t, const double *, size_t);
    int (*get)(void *, const uint32_t *, size_t, double *, size_t);
    int (*step)(void *, double, double, bool, bool *, bool *, bool *, double *);
    int (*get_state)(void *, void **), (*set_state)(void *, void *), (*free_state)(void *, void **);
    int (*size_of_state)(void *, void *, size_t *);
    int (*serialize)(void *, void *, uint8_t *, size_t);
    int (*deserialize)(void *, const uint8_t *, size_t, void **);
    void (*release)(void *);
    *(void **)&enter = find("fmi3EnterInitializationMode");
    *(void **)&leave = find("fmi3ExitInitializationMode");
    *(void **)&terminate = find("fmi3Terminate");
    *(void **)&set = find("fmi3SetFloat64");
    *(void **)&get = find("fmi3GetFloat64");
    *(void **)&step = find("fmi3DoStep");
    *(void **)&get_state = find("fmi3GetFMUState");
    *(void **)&set_state = find("fmi3SetFMUState");
    *(void **)&free_state = find("fmi3FreeFMUState");
    *(void **)&size_of_state = find("fmi3SerializedFMUStateSize");
    *(void **)&serialize = find("fmi3SerializeFMUState");
    *(void **)&deserialize = find("fmi3DeserializeFMUState");
    *(void **)&release = find("fmi3FreeInstance");

    char resources[4096];
    snprintf(resources, sizeof resources, "%s/", arguments[2]);
    void *unit = instance("host", arguments[3], resources);
    const uint32_t all[SIGNALS] = {0, 1, 2, 3, 4, 5, 6};
    double before[SAMPLE], now[SAMPLE], answers[SIGNALS];
    for (long row = 0; sample(load, now); row++) {
        if (row == 0) {
            expect(enter(unit, false, 0.0, now[0], false, 0.0), "fmi3EnterInitializationMode");
            expect(set(unit, &input, 1, &now[1], 1), "fmi3SetFloat64");
            expect(leave(unit), "fmi3ExitInitializationMode");
        } else {
            bool event = true, end = true, early = true;
            double reached = -1.0, size = now[0] - before[0];
            expect(set(unit, &input, 1, &now[1], 1), "fmi3SetFloat64");
            expect(step(unit, before[0], size, true, &event, &end, &early, &reached), "fmi3DoStep");
            if (event || end || early || reached != before[0] + size)
                stop("fmi3DoStep", "did not go all the way");
        }
        memcpy(before, now, sizeof before);
        expect(get(unit, all, SIGNALS, answers, SIGNALS), "fmi3GetFloat64");
        print(answers);
        if (row == half) {
            void *state = NULL;
            size_t size = 0;
            expect(get_state(unit, &state), "fmi3GetFMUState");
            expect(size_of_state(unit, state, &size), "fmi3SerializedFMUStateSize");
            uint8_t *bytes = malloc(size);
            if (!bytes) stop("no memory for", "the state");
            expect(serialize(unit, state, bytes, size), "fmi3SerializeFMUState");
            expect(free_state(unit, &state), "fmi3FreeFMUState");
            release(unit);
            unit = instance("second", arguments[3], resources);
            expect(deserialize(unit, bytes, size, &state), "fmi3DeserializeFMUState");
            expect(set_state(unit, state), "fmi3SetFMUState");
            expect(free_state(unit, &state), "fmi3FreeFMUState");
            free(bytes);
        }
    }
    expect(terminate(unit), "fmi3Terminate");
    release(unit);
    return 0;
}
