/* Flies the library of an FMU on any platform; doubles go in and out as their 64 bits in hex.
 *
 * driver LIBRARY GUID RESTORE SAVE SETTINGS INPUTS REFERENCE...
 *
 * Standard input: one line per step, with time, length and INPUTS values for the first INPUTS
 * references. Standard output: one line per step, with the values of the other references.
 * RESTORE and SAVE are files with a serialised FMU state, or `-`. SETTINGS are integer parameters,
 * `REFERENCE=VALUE,...`, or empty. */
#define __USE_MINGW_ANSI_STDIO 1
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <windows.h>
#define symbol(library, name) ((void *)GetProcAddress(library, name))
#else
#include <dlfcn.h>
#define symbol(library, name) dlsym(library, name)
#endif
#include "fmi2FunctionTypes.h"

#define MOST 200

static void fail(const char *what)
{
    fprintf(stderr, "%s failed\n", what);
    exit(1);
}

static void log_message(fmi2ComponentEnvironment environment, fmi2String instance,
                        fmi2Status status, fmi2String category, fmi2String message, ...)
{
    va_list arguments;
    (void)environment, (void)instance, (void)category;
    va_start(arguments, message);
    fprintf(stderr, "[%d] ", status);
    vfprintf(stderr, message, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}

static double from_bits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint64_t to_bits(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static double next_value(int *end)
{
    uint64_t bits = 0;
    if (scanf("%" SCNx64, &bits) != 1)
        *end = 1;
    return from_bits(bits);
}

#define LOAD(type, name)                                   \
    name##TYPE *type = (name##TYPE *)symbol(library, #name); \
    if (!type)                                             \
    fail(#name)
#define CALL(call)           \
    if ((call) != fmi2OK)    \
    fail(#call)

int main(int count, char **arguments)
{
    if (count < 8)
        fail("reading the arguments");
#ifdef _WIN32
    _setmode(_fileno(stdout), _O_BINARY);
    HMODULE library = LoadLibraryA(arguments[1]);
#else
    void *library = dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL);
#endif
    if (!library)
        fail("loading the library");
    LOAD(instantiate, fmi2Instantiate);
    LOAD(set_up, fmi2SetupExperiment);
    LOAD(enter, fmi2EnterInitializationMode);
    LOAD(leave, fmi2ExitInitializationMode);
    LOAD(set_integer, fmi2SetInteger);
    LOAD(set_real, fmi2SetReal);
    LOAD(get_real, fmi2GetReal);
    LOAD(do_step, fmi2DoStep);
    LOAD(get_state, fmi2GetFMUstate);
    LOAD(set_state, fmi2SetFMUstate);
    LOAD(free_state, fmi2FreeFMUstate);
    LOAD(state_size, fmi2SerializedFMUstateSize);
    LOAD(serialize, fmi2SerializeFMUstate);
    LOAD(deserialize, fmi2DeSerializeFMUstate);
    LOAD(terminate, fmi2Terminate);
    LOAD(free_instance, fmi2FreeInstance);

    const char *restore = arguments[3], *save = arguments[4];
    size_t inputs = (size_t)atoi(arguments[6]), all = (size_t)count - 7;
    fmi2ValueReference references[MOST];
    fmi2Real values[MOST];
    if (all > MOST || inputs > all)
        fail("reading the references");
    for (size_t i = 0; i < all; i++)
        references[i] = (fmi2ValueReference)atoi(arguments[7 + i]);

    fmi2CallbackFunctions callbacks = {log_message, calloc, free, NULL, NULL};
    fmi2Component fmu =
        instantiate("ahv", fmi2CoSimulation, arguments[2], NULL, &callbacks, fmi2False, fmi2False);
    if (!fmu)
        fail("fmi2Instantiate");
    for (char *part = strtok(arguments[5], ","); part; part = strtok(NULL, ",")) {
        fmi2ValueReference reference;
        fmi2Integer value;
        if (sscanf(part, "%u=%d", &reference, &value) != 2)
            fail("reading the settings");
        CALL(set_integer(fmu, &reference, 1, &value));
    }
    CALL(set_up(fmu, fmi2False, 0.0, 0.0, fmi2False, 0.0));
    CALL(enter(fmu));
    CALL(leave(fmu));

    static fmi2Byte bytes[1 << 20];
    fmi2FMUstate state = NULL;
    size_t size = 0;
    if (strcmp(restore, "-") != 0) {
        FILE *file = fopen(restore, "rb");
        if (!file)
            fail("opening the state");
        size = fread(bytes, 1, sizeof bytes, file);
        fclose(file);
        CALL(deserialize(fmu, bytes, size, &state));
        CALL(set_state(fmu, state));
        CALL(free_state(fmu, &state));
    }
    for (;;) {
        int end = 0;
        double time = next_value(&end), length = next_value(&end);
        for (size_t i = 0; i < inputs; i++)
            values[i] = next_value(&end);
        if (end)
            break;
        CALL(set_real(fmu, references, inputs, values));
        CALL(do_step(fmu, time, length, fmi2True));
        CALL(get_real(fmu, references + inputs, all - inputs, values));
        for (size_t i = 0; i < all - inputs; i++)
            printf("%016" PRIx64 "%c", to_bits(values[i]), i + 1 < all - inputs ? ',' : '\n');
    }
    if (strcmp(save, "-") != 0) {
        CALL(get_state(fmu, &state));
        CALL(state_size(fmu, state, &size));
        if (size > sizeof bytes)
            fail("keeping the state");
        CALL(serialize(fmu, state, bytes, size));
        CALL(free_state(fmu, &state));
        FILE *file = fopen(save, "wb");
        if (!file || fwrite(bytes, 1, size, file) != size || fclose(file) != 0)
            fail("writing the state");
    }
    CALL(terminate(fmu));
    free_instance(fmu);
    return 0;
}
