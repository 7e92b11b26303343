/* The vehicle's Model Exchange functions under SUNDIALS: one second with an elevator doublet.
 *
 * Usage: sundials LIBRARY GUID RESOURCES DELTA_E REPEATS TOLERANCE...
 *   DELTA_E  value reference of the elevator; its deviation, rad, is that of `doublet` below
 * Prints for each method and tolerance a line
 *   method;tolerance;median s;least s;largest s;right-hand sides;state...
 * The integrators start anew only where the input jumps. Compiled with -DSTATES=<number of continuous
 * states>. */
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <dlfcn.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <time.h>

enum { QUARTERS = 4, ORDER_8 = 8 };
static const double doublet[QUARTERS] = {0.0, 0.01, -0.01, 0.0};

/* fmi2FunctionTypes.h, as far as needed. */
typedef void *Component;
typedef struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*step_finished)(void *, int);
    void *environment;
} Callbacks;
typedef struct {
    int new_discrete_states_needed, terminate, nominals_changed, values_changed, next_event_defined;
    double next_event;
} EventInfo;
static Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int);
static int (*setup)(Component, int, double, double, int, double);
static int (*enter_init)(Component), (*exit_init)(Component);
static int (*event_mode)(Component), (*continuous_mode)(Component);
static int (*discrete_states)(Component, EventInfo *);
static int (*set_real)(Component, const unsigned *, size_t, const double *);
static int (*set_time)(Component, double);
static int (*set_states)(Component, const double *, size_t), (*get_states)(Component, double *, size_t);
static int (*derivatives)(Component, double *, size_t), (*nominals)(Component, double *, size_t);

static void need(int bad, const char *what) {
    if (bad) {
        fprintf(stderr, "%s failed\n", what);
        exit(1);
    }
}

static void *symbol(void *library, const char *name) {
    void *found = dlsym(library, name);
    need(!found, name);
    return found;
}

static void quiet(void *environment, const char *name, int status, const char *category,
                  const char *message, ...) {
    (void)environment, (void)name, (void)status, (void)category;
    fprintf(stderr, "%s\n", message);
}

static int rhs(double t, N_Vector y, N_Vector rate, void *component) {
    return set_time(component, t) || set_states(component, NV_DATA_S(y), STATES) ||
           derivatives(component, NV_DATA_S(rate), STATES);
}

enum Method { ADAMS, BDF, ORDER_5_PAIR, ORDER_8_PAIR, METHODS };
static const char *names[METHODS] = {"CVODE Adams", "CVODE BDF", "ARKODE order 5", "ARKODE order 8"};

static long fly(enum Method method, double tolerance, Component fmu, unsigned elevator,
                const double *start, const double *nominal, N_Vector y) {
    SUNContext context;
    need(SUNContext_Create(NULL, &context), "SUNContext_Create");
    N_Vector absolute = N_VNew_Serial(STATES, context);
    for (int i = 0; i < STATES; i++) {
        NV_Ith_S(y, i) = start[i];
        NV_Ith_S(absolute, i) = tolerance * nominal[i];
    }
    SUNMatrix matrix = NULL;
    SUNLinearSolver linear = NULL;
    SUNNonlinearSolver fixed_point = NULL;
    void *memory = NULL;
    long calls = 0, extra = 0;
    for (int quarter = 0; quarter < QUARTERS; quarter++) {
        double t = quarter / (double)QUARTERS, end = (quarter + 1) / (double)QUARTERS;
        EventInfo info;
        need(event_mode(fmu) || set_real(fmu, &elevator, 1, &doublet[quarter]) ||
                 discrete_states(fmu, &info) || continuous_mode(fmu), "event");
        if (method >= ORDER_5_PAIR) {
            if (quarter == 0) {
                memory = ERKStepCreate(rhs, t, y, context);
                ERKStepSetUserData(memory, fmu);
                ERKStepSVtolerances(memory, tolerance, absolute);
                ERKStepSetMaxNumSteps(memory, 1000000);
                if (method == ORDER_8_PAIR) need(ERKStepSetOrder(memory, ORDER_8), "order");
            } else {
                ERKStepReset(memory, t, y);
            }
            ERKStepSetStopTime(memory, end);
            need(ERKStepEvolve(memory, end, y, &t, ARK_NORMAL) < 0, "ERKStepEvolve");
        } else {
            if (quarter == 0) {
                memory = CVodeCreate(method == BDF ? CV_BDF : CV_ADAMS, context);
                CVodeInit(memory, rhs, t, y);
                CVodeSetUserData(memory, fmu);
                CVodeSVtolerances(memory, tolerance, absolute);
                CVodeSetMaxNumSteps(memory, 1000000);
                if (method == BDF) {
                    matrix = SUNDenseMatrix(STATES, STATES, context);
                    linear = SUNLinSol_Dense(y, matrix, context);
                    need(CVodeSetLinearSolver(memory, linear, matrix), "CVodeSetLinearSolver");
                } else {
                    fixed_point = SUNNonlinSol_FixedPoint(y, 0, context);
                    need(CVodeSetNonlinearSolver(memory, fixed_point), "CVodeSetNonlinearSolver");
                }
            } else {
                long part;
                CVodeGetNumRhsEvals(memory, &part), calls += part;
                if (linear) CVodeGetNumLinRhsEvals(memory, &part), extra += part;
                CVodeReInit(memory, t, y);
            }
            CVodeSetStopTime(memory, end);
            need(CVode(memory, end, y, &t, CV_NORMAL) < 0, "CVode");
        }
    }
    long part = 0;
    if (method >= ORDER_5_PAIR) {
        ERKStepGetNumRhsEvals(memory, &part);
        ERKStepFree(&memory);
    } else {
        CVodeGetNumRhsEvals(memory, &part);
        long jacobian = 0;
        if (linear) CVodeGetNumLinRhsEvals(memory, &jacobian);
        part += jacobian;
        CVodeFree(&memory);
    }
    if (linear) SUNLinSolFree(linear);
    if (matrix) SUNMatDestroy(matrix);
    if (fixed_point) SUNNonlinSolFree(fixed_point);
    N_VDestroy(absolute);
    SUNContext_Free(&context);
    return calls + extra + part;
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv) {
    need(argc < 7, "reading the arguments");
    void *library = dlopen(argv[1], RTLD_NOW);
    need(!library, argv[1]);
    *(void **)&instantiate = symbol(library, "fmi2Instantiate");
    *(void **)&setup = symbol(library, "fmi2SetupExperiment");
    *(void **)&enter_init = symbol(library, "fmi2EnterInitializationMode");
    *(void **)&exit_init = symbol(library, "fmi2ExitInitializationMode");
    *(void **)&event_mode = symbol(library, "fmi2EnterEventMode");
    *(void **)&continuous_mode = symbol(library, "fmi2EnterContinuousTimeMode");
    *(void **)&discrete_states = symbol(library, "fmi2NewDiscreteStates");
    *(void **)&set_real = symbol(library, "fmi2SetReal");
    *(void **)&set_time = symbol(library, "fmi2SetTime");
    *(void **)&set_states = symbol(library, "fmi2SetContinuousStates");
    *(void **)&get_states = symbol(library, "fmi2GetContinuousStates");
    *(void **)&derivatives = symbol(library, "fmi2GetDerivatives");
    *(void **)&nominals = symbol(library, "fmi2GetNominalsOfContinuousStates");

    Callbacks callbacks = {quiet, calloc, free, NULL, NULL};
    Component fmu = instantiate("bench", 0, argv[2], argv[3], &callbacks, 0, 0);
    need(!fmu, "fmi2Instantiate");
    double start[STATES], nominal[STATES];
    EventInfo info;
    need(setup(fmu, 0, 0.0, 0.0, 0, 0.0) || enter_init(fmu) || exit_init(fmu) ||
             discrete_states(fmu, &info) || continuous_mode(fmu) ||
             get_states(fmu, start, STATES) || nominals(fmu, nominal, STATES), "initialisation");

    unsigned elevator = (unsigned)atoi(argv[4]);
    int repeats = atoi(argv[5]);
    double *seconds = malloc((size_t)repeats * sizeof *seconds);
    SUNContext context;
    need(SUNContext_Create(NULL, &context), "SUNContext_Create");
    N_Vector y = N_VNew_Serial(STATES, context);
    for (int method = 0; method < METHODS; method++) {
        for (int i = 6; i < argc; i++) {
            double tolerance = atof(argv[i]);
            long calls = 0;
            for (int repeat = 0; repeat < repeats; repeat++) {
                double begin = now();
                calls = fly((enum Method)method, tolerance, fmu, elevator, start, nominal, y);
                seconds[repeat] = now() - begin;
            }
            qsort(seconds, (size_t)repeats, sizeof *seconds, ascending);
            printf("%s;%s;%.9g;%.9g;%.9g;%ld", names[method], argv[i], seconds[repeats / 2],
                   seconds[0], seconds[repeats - 1], calls);
            for (int k = 0; k < STATES; k++) printf(";%.17g", NV_Ith_S(y, k));
            printf("\n");
        }
    }
    return 0;
}
