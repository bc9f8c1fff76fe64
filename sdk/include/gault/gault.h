/* clang-format off */
/* gault.h - the whole binary contract between the Gault host and a plugin.
 *
 * C11 / C++17. Nothing here allocates, throws, or owns C++ types. C++ authors include <gault/material.hpp>,
 * <gault/boundary.hpp>, <gault/program.hpp> or <gault/observer.hpp> instead, which wrap this header.
 *
 * Rules of the contract
 *   1. A plugin exports exactly one symbol, GAULT_ENTRY_SYMBOL: a const struct gault_module.
 *   2. A struct marked [frozen] never changes within an ABI major.
 *      A struct marked [grows] starts with `size`; fields are only ever appended, without padding; whoever reads a
 *      field added after 1.0 does so through GAULT_HAS. Lists of growing structs are lists of pointers.
 *      What is `reserved` is 0. A host refuses flags, kinds and types that it does not know. See sdk/ABI.md.
 *   3. Every function carries a thread tag:
 *        [main]    the host's main thread, never concurrent with any other call into the module
 *        [worker]  any worker thread; concurrent on the same instance, with disjoint points
 *        [any]     any thread, at any time between load and exit
 *   4. No exception, longjmp or signal leaves a function. GAULT_NOEXCEPT makes that a C++ compile error.
 *   5. Strings are UTF-8, NUL-terminated, and live as long as the module: until exit. A module is never unloaded.
 *   6. SI units. Tension positive. Symmetric tensors are xx yy zz xy yz zx with TENSOR shear (not gamma).
 *      All six components are always present. Axisymmetric scenes: x = r, y = axial, z = hoop. Plane strain:
 *      z is out of plane. A model never asks which it is.
 *   7. A plugin is logic over arrays that the host owns. What must survive a checkpoint was declared: material
 *      state, program memory. `self` holds parameters and what follows from them, and is read-only after create.
 *   8. What a function is passed, structs, arrays and texts, is borrowed for the call; gault_host alone stays.
 */
#ifndef GAULT_H
#define GAULT_H

#include <stddef.h>
#include <stdint.h>

#define GAULT_ABI_MAJOR 1u
#define GAULT_ABI_MINOR 0u
#define GAULT_MAGIC 0x31544C47u /* "GLT1" */
#define GAULT_ENTRY gault_module_v1
#define GAULT_ENTRY_SYMBOL "gault_module_v1" /* the ABI major is in the name */

#if defined(__cplusplus)
#define GAULT_NOEXCEPT noexcept
#define GAULT_EXTERN_C extern "C"
extern "C" {
#else
#define GAULT_NOEXCEPT
#define GAULT_EXTERN_C extern
#endif

#define GAULT_EXPORT __attribute__((visibility("default")))

/* True when `field` lies inside the size that the struct's writer declared. */
#define GAULT_HAS(ptr, type, field) ((ptr)->size >= offsetof(type, field) + sizeof((ptr)->field))

/* Lengths of arrays of points, nodes and facets are multiples of GAULT_LANES. */
enum { GAULT_LANES = 8, GAULT_TEXT = 512 }; /* for the whole ABI major */

typedef uint32_t gault_status;
enum {
    GAULT_OK = 0,
    GAULT_RETRY = 1,   /* of update() and advance(): admissible, but the increment was too large: see `suggest` */
    GAULT_INVALID = 2, /* bad parameter or configuration: see gault_error.parameter */
    GAULT_FAILED = 3   /* no result can be produced: see gault_error.point. Any other status counts as this one */
};

typedef struct gault_error { /* [frozen] caller-owned, one per call, never shared between threads */
    int32_t parameter;       /* index into the component's parameters, or -1 */
    int32_t reserved;
    int64_t point; /* index into the batch, or -1 */
    char text[GAULT_TEXT];
} gault_error;

/* ---- parameters ---------------------------------------------------------------------------------------
 * Declared as data. The host reads the scene, converts units, checks bounds, and passes values in order. */

typedef uint32_t gault_type;
enum {
    GAULT_REAL = 1,
    GAULT_INTEGER = 2,
    GAULT_BOOLEAN = 3,
    GAULT_CHOICE = 4,     /* one word out of `choices` */
    GAULT_TEXT_VALUE = 5, /* free text */
    GAULT_LIST = 6,       /* numbers, all in `unit`: a UMAT's properties */
    GAULT_TABLE = 7,      /* [x, y] pairs with x strictly increasing; x in `x_unit`, y in `unit` */
    GAULT_RECORDS = 8     /* ordered items, each of one of `kinds` with its own parameters: a protocol's phases.
                             In a scene: a list of {kind: {key: value, ...}}; a single item needs no list, and a
                             kind with a single parameter may be written {kind: value}. */
};

enum {
    GAULT_REQUIRED = 1u << 0, /* absence is an error */
    GAULT_OPTIONAL = 1u << 1, /* may be absent, has no default: gault_value.count is then 0 */
    GAULT_MIN_OPEN = 1u << 2, /* value > min rather than >= */
    GAULT_MAX_OPEN = 1u << 3  /* value < max rather than <= */
};

struct gault_record_kind;

typedef struct gault_parameter { /* [grows] */
    uint32_t size;
    gault_type type;
    uint32_t flags; /* neither REQUIRED nor OPTIONAL: `fallback` is the default */
    uint32_t reserved;
    const char *name;   /* the key in the scene, [a-z][a-z0-9_]* */
    const char *symbol; /* as printed in papers, e.g. "phi"; may be "" */
    const char *unit;   /* SI unit that the plugin receives: "Pa", "rad", "m/s", "1" */
    const char *x_unit; /* GAULT_TABLE: of the abscissa; otherwise NULL */
    const char *doc;    /* one sentence */
    double fallback, min, max;   /* REAL, INTEGER, BOOLEAN (0, 1), CHOICE (index); min, max also for list and table
                                    entries; -HUGE_VAL, HUGE_VAL: unbounded */
    const char *const *choices;  /* GAULT_CHOICE: NULL-terminated */
    const struct gault_record_kind *const *kinds; /* GAULT_RECORDS: NULL-terminated */
    int64_t min_count, max_count; /* LIST, TABLE, RECORDS: number of entries; max_count 0: no limit */
} gault_parameter;

typedef struct gault_record_kind { /* [grows] */
    uint32_t size, reserved;
    const char *name, *doc;
    const gault_parameter *const *parameters; /* NULL-terminated */
} gault_record_kind;

struct gault_item;

typedef struct gault_value { /* [frozen] one per parameter, in declared order, already validated */
    double real;                    /* REAL; INTEGER, BOOLEAN and CHOICE repeat their value here */
    int64_t integer;                /* INTEGER, BOOLEAN, CHOICE (index) */
    const char *text;               /* TEXT_VALUE, CHOICE (the word); otherwise "" */
    const double *x, *y;            /* TABLE; LIST uses y */
    const struct gault_item *items; /* RECORDS */
    int64_t count;                  /* entries; 1 for a single value that is present or defaulted; 0: absent */
} gault_value;                      /* everything it points to is valid during create() only */

typedef struct gault_item { /* [frozen] one record: its kind, and its values in that kind's order */
    int64_t kind;
    const gault_value *values;
} gault_item;

/* ---- host --------------------------------------------------------------------------------------------- */

typedef uint32_t gault_level;
enum { GAULT_DEBUG = 0, GAULT_INFO = 1, GAULT_WARN = 2, GAULT_ERROR = 3 };

typedef struct gault_host { /* [grows] valid from create() until exit */
    uint32_t size;
    uint32_t abi_minor;
    void *self;
    const char *name, *version;
    void (*log)(void *self, gault_level level, const char *text) GAULT_NOEXCEPT; /* [any] */
    const void *(*extension)(void *self, const char *id) GAULT_NOEXCEPT; /* [any] NULL if unknown; until exit */
} gault_host;

/* ---- module and components ---------------------------------------------------------------------------- */

typedef uint32_t gault_kind;
enum { GAULT_MATERIAL = 1, GAULT_BOUNDARY = 2, GAULT_PROGRAM = 3, GAULT_OBSERVER = 4 };

typedef struct gault_component { /* [grows] */
    uint32_t size;
    gault_kind kind;
    const char *name;      /* unique per kind; what `type:` (or a material's `model:`) says in a scene */
    const char *version;   /* of the model, not of the SDK: written to every result */
    const char *doc;       /* one sentence */
    const char *reference; /* citation or DOI; may be "" */
    const gault_parameter *const *parameters; /* NULL-terminated */
    const void *api; /* gault_material_api, gault_boundary_api, ... according to kind */
    /* Unless it answers OK, nothing is left to destroy. A self that is NULL is right, and is never destroyed. */
    gault_status (*create)(const gault_host *, const gault_value *, void **self, gault_error *) GAULT_NOEXCEPT; /* [main] */
    void (*destroy)(void *self) GAULT_NOEXCEPT;              /* [main] */
    const void *(*extension)(const char *id) GAULT_NOEXCEPT; /* [any] may be NULL; ids are "name/revision"; until exit */
} gault_component;

typedef struct gault_module {      /* the first 24 bytes are [frozen] for ever; the rest [grows] */
    uint32_t magic;                /* GAULT_MAGIC */
    uint16_t abi_major, abi_minor; /* the SDK it was compiled against */
    uint32_t size;
    uint16_t needs_minor; /* the oldest host minor it can run on: the lowest that is true */
    uint8_t pointer_bytes, real_bytes;
    uint64_t reserved;
    const char *name, *version, *author, *license, *built_with;
    const gault_component *const *components; /* NULL-terminated */
} gault_module;

GAULT_EXTERN_C GAULT_EXPORT const gault_module GAULT_ENTRY; /* what a plugin defines */

enum { GAULT_SIGNAL_OPTIONAL = 1u << 0 }; /* a program's control: where nobody listens, it commands nobody */

typedef struct gault_signal { /* [frozen] a named scalar: measured, commanded, remembered or recorded */
    const char *name, *unit, *doc;
    double initial;
    uint32_t flags, reserved; /* flags: 0, as far as nothing here says otherwise */
} gault_signal;

/* ---- kind: material ----------------------------------------------------------------------------------- */

typedef uint32_t gault_shape;
enum { GAULT_SCALAR = 1, GAULT_VECTOR = 3, GAULT_SYMMETRIC = 6 }; /* the value is the component count */

typedef struct gault_state { /* [frozen] the host allocates, rotates, advects, checkpoints and plots it */
    const char *name, *unit, *doc;
    gault_shape shape; /* SYMMETRIC and VECTOR states are rotated with the material */
    uint32_t reserved;
    double initial, min, max; /* certified: the model keeps every component within */
} gault_state;

/* A batch of material points: struct of arrays, borrowed for the call, every array 64-byte aligned. `count` points
 * matter; arrays are readable and writable up to `padded`, and lanes beyond `count` repeat admissible values. Old
 * and new arrays never overlap, so a host repeats a step from what it still has. */
typedef struct gault_points { /* [grows] */
    uint32_t size;
    uint32_t reserved;
    int64_t count, padded;
    double time, dt;                          /* at the end of the step; its length; s */
    const double *strain[6];                  /* increment: log strain of the step, in the rotated frame */
    const double *stress_old[6];              /* Cauchy stress at the start, rotated; Pa */
    double *stress[6];                        /* out: Cauchy stress at the end; Pa */
    const double *const *state_old;           /* one array a component: declared states one after another; rotated */
    double *const *state;                     /* out: every component is written, changed or not */
    const double *const *input;               /* host fields that the material asked for, in its order */
    double *modulus;       /* out, if not NULL: an upper bound of the P-wave modulus, Pa: sets the time step. Of waves in
                              soil that yields too: flow far from associated makes some that are faster than elastic ones */
    double *shear_modulus; /* out, NULL where modulus is: the elastic G, Pa (far fields, dashpots) */
    double *tangent[36];   /* out, if tangent[0]: d stress / d strain of this update, row-major over xx yy zz xy yz zx.
                              Column xy: the change for a unit TENSOR strain xy (xy and yx together). Unsymmetric in
                              general. GAULT_FINITE_STRAIN: d stress / d e of the Cauchy stress returned where F_new
                              becomes exp(e) F_new, e symmetric, at e = 0; F_old and the old stress stay */
    double suggest;        /* out with GAULT_RETRY: fraction of dt worth trying, 0 < suggest < 1. Without tangent[0] the
                              host may divide the increment of this batch; with it the whole step becomes shorter */
    const double *F_old[9], *F_new[9]; /* deformation gradient, row-major; NULL unless GAULT_FINITE_STRAIN */
} gault_points;

enum {
    GAULT_HAS_TANGENT = 1u << 0,   /* fills `tangent`; otherwise an implicit solver differentiates numerically */
    GAULT_ONE_AT_A_TIME = 1u << 1, /* legacy code with global state: the host never calls two such models at once */
    GAULT_RATE_DEPENDENT = 1u << 3, /* answers differently at another rate: without inertia the host keeps steps short
                                       enough to follow how strain goes on in time */
    GAULT_FINITE_STRAIN = 1u << 2  /* wants F; stress_old and states come unrotated, and it returns Cauchy stress */
};

/* Host fields that `inputs` may name (scalars): "density" kg/m^3, current; "volume_ratio" 1, current over initial;
 * "characteristic_length" m, of the grid cell that holds the point (the root of its area; in radial symmetry its length along
 * the radius), for regularised softening. */
typedef struct gault_material_api { /* [grows] */
    uint32_t size;
    uint32_t flags;
    const gault_state *states; /* state_count of them */
    const char *const *inputs; /* NULL-terminated; may be NULL */
    uint32_t state_count;
    uint32_t reserved;
    gault_status (*update)(const void *self, gault_points *, gault_error *) GAULT_NOEXCEPT; /* [worker] */
    /* Once, before the first step: `stress` holds the initial stress (in: also stress_old). May set `state`, and answers
     * FAILED when the initial stress is not admissible. NULL: states keep their `initial`. */
    gault_status (*start)(const void *self, gault_points *, gault_error *) GAULT_NOEXCEPT; /* [worker] */
    /* States that depend on the parameters (a UMAT's nstatv). NULL: `states` holds. The list lives as long as self. */
    const gault_state *(*instance_states)(const void *self, uint32_t *count) GAULT_NOEXCEPT; /* [main] */
} gault_material_api;

/* ---- kind: boundary -----------------------------------------------------------------------------------
 * A boundary condition says what it wants; the host imposes it. The same plugin therefore serves the explicit and
 * an implicit solver, either frame, and a grid that it never sees. Asked anew at every step, so a program may
 * switch a wall between pressure and displacement. Either function is called once for every surface that the
 * condition is on, and any number of times a step, also at trial states that the host gives up: the answer depends on
 * the arguments alone. Normals point out of the soil. */

typedef struct gault_nodes { /* [grows] grid nodes on the selected surfaces, struct of arrays */
    uint32_t size;
    uint32_t reserved;
    int64_t count, padded;
    double time, dt; /* at the end of the step; its length: 0 where the host asks only which components are fixed, and a
                        velocity that is not finite is ignored */
    const double *position[3], *normal[3], *displacement[3];
    const double *control; /* set points that a program commands, in the order of `controls` */
    double *fixed[3];      /* out, zero on entry: 1 where the component is prescribed */
    double *velocity[3];   /* out: its value, m/s, constant over the step: the host moves the node by velocity * dt */
} gault_nodes;

typedef struct gault_facets { /* [grows] quadrature points on the selected surfaces, struct of arrays */
    uint32_t size;
    uint32_t reserved;
    int64_t count, padded;
    double time, dt; /* at the end of the step, which loads act at; its length */
    const double *position[3], *normal[3], *displacement[3];
    const double *velocity[3];         /* zero in a solver without inertia: no waves */
    const double *impedance[2];        /* rho c_p, rho c_s of the soil behind at the start of the run, Pa s/m: absorbing
                                          conditions */
    const double *shear_modulus;       /* of the soil behind at the start of the run, Pa: an elastic far field */
    const double *initial_traction[3]; /* in balance with the initial stress, Pa */
    const double *control;
    double *pressure;    /* out, zero on entry: follower load along -normal, Pa; the host knows its stiffness */
    double *traction[3]; /* out, zero on entry: Pa per current area, in fixed directions */
    double *slope[9];    /* out, zero on entry, if slope[0]: -d traction_i / d displacement_j at fixed time, Pa/m,
                            row-major, for an implicit solver */
} gault_facets;

enum { /* flags of a boundary: what the host may rely on, whatever the parameters */
    GAULT_BOUNDARY_UNIFORM = 1u << 0,        /* the answer does not depend on where along the axis of a cylinder it is */
    GAULT_BOUNDARY_HOLDS_NORMAL = 1u << 1,   /* holds what crosses the surface still and does nothing else */
    GAULT_BOUNDARY_ELASTIC_BEHIND = 1u << 2  /* stands for soil beyond a cylinder that has no bound and is elastic; needs no
                                                parameter. The host watches whether the soil at the surface is. */
};

typedef struct gault_boundary_api { /* [grows] at least one of the two functions */
    uint32_t size;
    uint32_t flags;
    const gault_signal *controls; /* what it listens to; `initial` holds where no program commands it */
    uint32_t control_count;
    uint32_t reserved;
    gault_status (*constrain)(const void *self, gault_nodes *, gault_error *) GAULT_NOEXCEPT; /* [main] */
    gault_status (*load)(const void *self, gault_facets *, gault_error *) GAULT_NOEXCEPT;     /* [main] */
} gault_boundary_api;

/* ---- kind: program ------------------------------------------------------------------------------------
 * Reads measures, writes controls, remembers through host-owned memory, emits rows, names its next event. advance() is
 * called once before the first step (index 0, dt 0) and at the end of every step, with that time's measures. Whenever
 * a step is taken back, the call that began it is made again: the same index, time, dt and measures, memory and
 * controls as before that call, and a new next_dt; `emit` is then ignored. */

typedef struct gault_step { /* [grows] */
    uint32_t size;
    uint32_t done; /* out: the protocol is complete */
    int64_t index;
    double time, dt;       /* now; the length of the step that ended, s */
    double next_dt;        /* the longest that the coming step will be, s; it ends earlier at `next`, or when the host
                              shortens it */
    const double *measure; /* in the declared order */
    double *control;       /* in/out: set points for the step that begins now */
    double *memory;        /* in/out */
    double *record;        /* out: one row of the result table */
    uint32_t emit;         /* out: write the row */
    uint32_t final;        /* in: 1 when the step cannot be repeated (explicit dynamics, whose steps are far shorter
                              than any event is wide): RETRY is then an error */
    double next;    /* out: time of the next event, HUGE_VAL if none; a step ends exactly there */
    double suggest; /* out with GAULT_RETRY: an event was overshot; repeat at this fraction of the step */
} gault_step;

/* Measures of the surface that the program or observer is `on`: "radius" m, mean current; "initial_radius" m; "area"
 * m^2, current; "initial_area" m^2; "normal_force" N, that pushes into the soil, total; "displacement" m, mean, into
 * the soil; "enclosed_volume" m^3, of the cavity inside an axisymmetric surface; "excess_pore_pressure" Pa, of
 * undrained soil beside it. Where the scene gives a program a
 * gauge, a place on the surface, radii and displacement are those of the place. Of the whole model: "kinetic_energy",
 * "internal_energy", "external_work", "damping_work" J; "energy_error", "kinetic_ratio" 1; "largest_velocity" m/s. */
typedef struct gault_program_signals { /* [grows] */
    uint32_t size;
    uint32_t reserved;
    const gault_signal *measures, *controls, *memories, *records;
    uint32_t measure_count, control_count, memory_count, record_count;
} gault_program_signals;

typedef struct gault_history { /* [grows] what a finished run emitted */
    uint32_t size;
    uint32_t columns;            /* 1 + the number of records */
    int64_t rows;
    const double *const *column; /* time, s, then the records in declared order; each `rows` long */
} gault_history;

/* Takes results one by one, [main]. Names are [a-z][a-z0-9_]*, each at most once. */
typedef struct gault_report { /* [grows] */
    uint32_t size;
    uint32_t reserved;
    void *host; /* the first argument of both functions */
    /* `source`: how it follows, a citation; `note`: what to know before using it. Both may be "". */
    void (*result)(void *host, const char *name, const char *unit, double value, const char *source,
                   const char *note) GAULT_NOEXCEPT;
    /* `reason`: why this history has no such result. */
    void (*absent)(void *host, const char *name, const char *reason, const char *source) GAULT_NOEXCEPT;
} gault_report;

typedef struct gault_program_api { /* [grows] */
    uint32_t size;
    uint32_t flags;
    const gault_program_signals *signals;
    gault_status (*advance)(const void *self, gault_step *, gault_error *) GAULT_NOEXCEPT; /* [main] */
    /* Signals that depend on the parameters (which control a ramp moves). NULL: `signals` holds. Lives as long as self. */
    const gault_program_signals *(*instance_signals)(const void *self) GAULT_NOEXCEPT; /* [main] */
    /* Results that follow from the history, once, when the protocol is complete. May be NULL. */
    gault_status (*evaluate)(const void *self, const gault_history *, gault_report *, gault_error *) GAULT_NOEXCEPT; /* [main] */
} gault_program_api;

/* ---- kind: observer -----------------------------------------------------------------------------------
 * Looks at all points when a result is due and answers with scalars for the summary: the error against a closed form,
 * a fitted parameter. */

typedef struct gault_sample { /* [grows] all points of the model, struct of arrays */
    uint32_t size;
    uint32_t reserved;
    int64_t count;
    double time;
    const double *position[3], *reference_position[3];
    const double *stress[6];
    const double *volume;            /* current, m^3 */
    const double *const *field;      /* declared `fields`: NaN at points whose material lacks the state, NULL where no
                                        material of the scene has it */
    const int32_t *material;         /* of every point: an index into material_name */
    const char *const *material_name; /* as the scene names them; NULL-terminated */
    double cell_size[2];             /* largest grid cell along x and y, m */
    const double *measure;
    double *result; /* out: one per declared result; NaN: not applicable, left out of the summary */
} gault_sample;

typedef struct gault_observer_api { /* [grows] */
    uint32_t size;
    uint32_t flags;
    const gault_signal *measures, *results;
    const char *const *fields; /* NULL-terminated names of scalar material states; may be NULL */
    uint32_t measure_count, result_count;
    gault_status (*evaluate)(const void *self, gault_sample *, gault_error *) GAULT_NOEXCEPT; /* [main] */
} gault_observer_api;

#if defined(__cplusplus)
}
#endif
#endif
