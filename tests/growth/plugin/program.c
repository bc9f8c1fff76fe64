/* Raises a pressure in phases, until they end or the surface has gone far enough. */
#include "parts.h"

#include <string.h>

enum { MOST_KNOTS = 64, MOST_MARKS = 4 };

typedef struct Protocol {
    double time[MOST_KNOTS], pressure[MOST_KNOTS]; /* linear between */
    int knots, marks, drives;
    double mark[MOST_MARKS], until;
    char label[64];
} Protocol;

/* ---- parameters: one of every type ---------------------------------------------------------------------- */

enum { RAISE, HOLD };
static const gault_parameter to =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_REQUIRED, .name = "to", .unit = "Pa",
              .doc = "Pressure in the end.", .min = -HUGE_VAL, .max = HUGE_VAL);
static const gault_parameter over =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_MIN_OPEN, .name = "over", .unit = "s", .doc = "How long.",
              .fallback = 1.0, .min = 0.0, .max = HUGE_VAL);
static const gault_parameter* const raise_parameters[] = {&to, &over, NULL};
static const gault_parameter* const hold_parameters[] = {&over, NULL};
static const gault_record_kind raise_kind = {.size = sizeof raise_kind,
                                             WITH_LATER.name = "raise",
                                             .doc = "Raises it.",
                                             .parameters = raise_parameters};
static const gault_record_kind hold_kind = {
    .size = sizeof hold_kind, WITH_LATER.name = "hold", .doc = "Holds it.", .parameters = hold_parameters};
static const gault_record_kind* const phase_kinds[] = {[RAISE] = &raise_kind, [HOLD] = &hold_kind, NULL};

enum { PHASES, SHAPE, MARKS, REPEATS, DRIVES, SAYS, LABEL, UNTIL };
static const gault_parameter phases =
    PARAMETER(.type = GAULT_RECORDS, .flags = GAULT_REQUIRED, .name = "phases", .doc = "In order.",
              .kinds = phase_kinds, .min_count = 1, .max_count = 4);
static const gault_parameter shape =
    PARAMETER(.type = GAULT_TABLE, .flags = GAULT_OPTIONAL, .name = "shape", .unit = "1", .x_unit = "1",
              .doc = "Share of a rise over share of its time.", .min = 0.0, .max = 1.0, .min_count = 2,
              .max_count = 4);
static const gault_parameter marks =
    PARAMETER(.type = GAULT_LIST, .flags = GAULT_OPTIONAL, .name = "marks", .unit = "Pa",
              .doc = "Rising pressures, each with a row.", .min = 0.0, .max = HUGE_VAL, .min_count = 1,
              .max_count = MOST_MARKS);
static const gault_parameter repeats =
    PARAMETER(.type = GAULT_INTEGER, .name = "repeats", .unit = "1", .doc = "How often the phases are run.",
              .fallback = 1.0, .min = 1.0, .max = 3.0);
static const gault_parameter drives = PARAMETER(.type = GAULT_BOOLEAN, .name = "drives", .unit = "1",
                                                .doc = "Whether it commands a drive.", .fallback = 0.0);
static const char* const levels[] = {"debug", "info", "warn", "error", NULL};
static const gault_parameter says =
    PARAMETER(.type = GAULT_CHOICE, .name = "says", .unit = "1", .doc = "How loud it says its label.",
              .choices = levels, .fallback = GAULT_DEBUG);
static const gault_parameter label = PARAMETER(.type = GAULT_TEXT_VALUE, .flags = GAULT_OPTIONAL,
                                               .name = "label", .unit = "", .doc = "Of the results.");
static const gault_parameter until =
    PARAMETER(.type = GAULT_REAL, .flags = GAULT_OPTIONAL | GAULT_MIN_OPEN, .name = "until", .unit = "m",
              .doc = "Displacement that ends it.", .min = 0.0, .max = HUGE_VAL);
static const gault_parameter* const parameters[] = {
    [PHASES] = &phases,   [SHAPE] = &shape,   [MARKS] = &marks,
    [REPEATS] = &repeats, [DRIVES] = &drives, [SAYS] = &says,
    [LABEL] = &label,     [UNTIL] = &until,   NULL};

static void add_knot(Protocol* p, double time, double pressure) {
    p->time[p->knots] = time;
    p->pressure[p->knots++] = pressure;
}

static void add_phase(Protocol* p, const gault_item* phase, const gault_value* table) {
    const double start = p->time[p->knots - 1], from = p->pressure[p->knots - 1];
    const double target = phase->kind == RAISE ? phase->values[0].real : from;
    const double length = phase->values[phase->kind == RAISE ? 1 : 0].real;
    for (int64_t i = 0; i < table->count; ++i)
        if (table->x[i] > 0.0 && table->x[i] < 1.0)
            add_knot(p, start + table->x[i] * length, from + table->y[i] * (target - from));
    add_knot(p, start + length, target);
}

static gault_status create(const gault_host* host, const gault_value* values, void** self,
                           gault_error* error) {
    if (strcmp(values[SAYS].text, levels[values[SAYS].integer]) != 0)
        return because(GAULT_INVALID, error, SAYS, -1, "the word and its number disagree");
    const gault_status status = make(host, sizeof(Protocol), self, error);
    if (status != GAULT_OK) return status;
    Protocol* p = *self;
    add_knot(p, 0.0, 0.0);
    for (int64_t n = 0; n < values[REPEATS].integer; ++n)
        for (int64_t i = 0; i < values[PHASES].count; ++i)
            add_phase(p, &values[PHASES].items[i], &values[SHAPE]);
    p->marks = (int)values[MARKS].count;
    for (int i = 0; i < p->marks; ++i)
        p->mark[i] = values[MARKS].y[i];
    p->drives = values[DRIVES].integer != 0;
    p->until = values[UNTIL].count ? values[UNTIL].real : HUGE_VAL;
    snprintf(p->label, sizeof p->label, "%s", values[LABEL].text);
    static const gault_level level[] = {GAULT_DEBUG, GAULT_INFO, GAULT_WARN, GAULT_ERROR};
    host->log(host->self, level[values[SAYS].integer], p->label);
    return GAULT_OK;
}

/* ---- signals -------------------------------------------------------------------------------------------- */

enum { DISPLACEMENT, NORMAL_FORCE, AREA };
static const gault_signal measures[] = {{.name = "displacement", .unit = "m", .doc = "Of the surface."},
                                        {.name = "normal_force", .unit = "N", .doc = "On the surface."},
                                        {.name = "area", .unit = "m^2", .doc = "Of the surface."}};
enum { PRESSURE, DRIVE };
static const gault_signal controls[] = {
    {.name = "pressure", .unit = "Pa", .doc = "On the surface.", .initial = 0.0},
    {.name = "drive", .unit = "1", .doc = "For a wall.", .initial = 1.0, .flags = GAULT_SIGNAL_OPTIONAL}};
enum { PASSED, BEFORE };
static const gault_signal memories[] = {{.name = "passed", .unit = "1", .doc = "Marks so far."},
                                        {.name = "before", .unit = "m", .doc = "Displacement a step ago."}};
enum { SET_PRESSURE, TRAVEL, TRUE_PRESSURE, RECORDS };
static const gault_signal records[] = {
    [SET_PRESSURE] = {.name = "set_pressure", .unit = "Pa", .doc = "Commanded."},
    [TRAVEL] = {.name = "travel", .unit = "m", .doc = "Of the surface."},
    [TRUE_PRESSURE] = {.name = "true_pressure", .unit = "Pa", .doc = "Force over area."}};
#define SIGNALS(commands)                                                                                    \
    {                                                                                                        \
        .size = sizeof(gault_program_signals), WITH_LATER.measures = measures, .controls = controls,         \
        .memories = memories, .records = records, .measure_count = 3, .control_count = commands,             \
        .memory_count = 2, .record_count = RECORDS                                                           \
    }
static const gault_program_signals driving = SIGNALS(2), pressing = SIGNALS(1);

static const gault_program_signals* signals_of(const void* self) {
    return ((const Protocol*)self)->drives ? &driving : &pressing;
}

/* ---- what it does --------------------------------------------------------------------------------------- */

static int knot_after(const Protocol* p, double time) {
    int k = 1;
    while (k < p->knots - 1 && p->time[k] <= time * (1.0 + 1e-12))
        ++k;
    return k;
}

static double pressure_at(const Protocol* p, double time) {
    const int k = knot_after(p, time);
    const double share = fmin((time - p->time[k - 1]) / (p->time[k] - p->time[k - 1]), 1.0);
    return p->pressure[k - 1] + share * (p->pressure[k] - p->pressure[k - 1]);
}

static void command(const Protocol* p, gault_step* step) {
    const int k = knot_after(p, step->time);
    step->next = p->time[k];
    step->control[PRESSURE] = pressure_at(p, fmin(step->time + step->next_dt, step->next));
    if (p->drives) step->control[DRIVE] = 1.0;
}

static void record(const Protocol* p, gault_step* step) {
    step->record[SET_PRESSURE] = pressure_at(p, step->time);
    step->record[TRAVEL] = step->measure[DISPLACEMENT];
    step->record[TRUE_PRESSURE] = step->measure[NORMAL_FORCE] / step->measure[AREA];
    int passed = 0;
    while (passed < p->marks && p->mark[passed] <= step->record[SET_PRESSURE])
        ++passed;
    step->emit = step->index == 0 || step->done || passed > step->memory[PASSED];
    step->memory[PASSED] = fmax(step->memory[PASSED], passed);
    step->memory[BEFORE] = step->measure[DISPLACEMENT];
}

static gault_status advance(const void* self, gault_step* step, gault_error* error) {
    const Protocol* p = self;
    if (HAS_LATER(step, gault_step))
        return because(GAULT_FAILED, error, -1, -1, "a step that is none of this host's");
    const double now = step->measure[DISPLACEMENT], before = step->memory[BEFORE];
    if (now > (1.0 + 1e-6) * p->until && !step->final && step->dt > 0.0) {
        step->suggest = (p->until - before) / (now - before);
        return GAULT_RETRY;
    }
    step->done = now >= (1.0 - 1e-6) * p->until || step->time >= p->time[p->knots - 1] * (1.0 - 1e-12);
    record(p, step);
    command(p, step);
    return GAULT_OK;
}

static gault_status evaluate(const void* self, const gault_history* history, gault_report* report,
                             gault_error* error) {
    const Protocol* p = self;
    if (HAS_LATER(history, gault_history) || HAS_LATER(report, gault_report) ||
        history->columns != 1 + RECORDS)
        return because(GAULT_FAILED, error, -1, -1, "a history that is none of this host's");
    const int64_t last = history->rows - 1;
    const double *pressure = history->column[1 + TRUE_PRESSURE], *travel = history->column[1 + TRAVEL];
    report->result(report->host, "stiffness", "Pa/m",
                   (pressure[last] - pressure[0]) / (travel[last] - travel[0]), "Hooke (1678)", p->label);
    report->absent(report->host, "unloading_stiffness", "it was never unloaded", "Hooke (1678)");
    return GAULT_OK;
}

static const gault_program_api api = {.size = sizeof api,
                                      WITH_LATER.signals = &pressing,
                                      .advance = advance,
                                      .instance_signals = signals_of,
                                      .evaluate = evaluate};
const gault_component protocol =
    COMPONENT(GAULT_PROGRAM, "in_c_protocol", "Raises a pressure in phases.", parameters, &api, create);
