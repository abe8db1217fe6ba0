/* What the hosts of both versions of FMI have in common: the library of one platform, numbers as bits,
 * and how they stop. */
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
typedef HMODULE Library;
static Library open_library(const char *path) { return LoadLibraryA(path); }
static void *function_of(Library library, const char *name) {
    return (void *)GetProcAddress(library, name);
}
#else
#include <dlfcn.h>
typedef void *Library;
static Library open_library(const char *path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }
static void *function_of(Library library, const char *name) { return dlsym(library, name); }
#endif

/* The references 0 to 6 are the signals; a sample of a load is its time, the input, and the input's
 * derivatives of orders 1 to 3. */
enum { SIGNALS = 7, ORDERS = 3, SAMPLE = 2 + ORDERS, OK = 0 };

static void stop(const char *what, const char *which) {
    fprintf(stderr, "host: %s %s\n", what, which);
    exit(1);
}

static Library library;

static void *find(const char *name) {
    void *found = function_of(library, name);
    if (!found) stop("the library lacks", name);
    return found;
}

static void expect(int status, const char *call) {
    if (status != OK) stop("refused:", call);
}

/* The next sample; 0 at the end of the load. */
static int sample(FILE *load, double numbers[SAMPLE]) {
    char digits[32];
    for (int place = 0; place < SAMPLE; place++) {
        if (fscanf(load, "%16s", digits) != 1) return 0;
        uint64_t bits = strtoull(digits, NULL, 16);
        memcpy(&numbers[place], &bits, sizeof bits);
    }
    return 1;
}

static void print(const double answers[SIGNALS]) {
    for (int signal = 0; signal < SIGNALS; signal++) {
        uint64_t bits;
        memcpy(&bits, &answers[signal], sizeof bits);
        printf("%016" PRIx64 "%c", bits, signal + 1 < SIGNALS ? ' ' : '\n');
    }
}
