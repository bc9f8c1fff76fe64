// The loops over material points: from the grid to strains, from stresses to grid forces. Plain data in and
// out, because kernels.cpp is compiled once for every instruction set and the best one is chosen when the
// program starts.
//
// A batch is a run of pages of eight slots; the points of a page share one grid cell, and the cells of a
// batch lie in one row of cells. Every kernel adds into the batch's own patch of nodes, (columns + degree_x)
// x (degree_y + 1) of them, which the caller sums in a fixed order: the same bits for every number of
// threads.
#pragma once
#include <cstddef>
#include <cstdint>

namespace gault::core {

constexpr int page_slots = 8;

struct AxisView { // per-cell arrays of an Axis
    const double *origin, *length, *inverse_length, *left, *right;
};

struct GridView {
    AxisView x, y;
    std::ptrdiff_t row; // distance between rows of a nodal field
    bool radial;        // cells along y stand for a metre of what does not vary
};

struct BatchView {
    int pages;
    const int32_t* column; // cell column of each page
    int cell_row;          // cell row of the batch
    int first_column;      // of the patch
    std::ptrdiff_t node;   // index of the node (0, cell_row) in a nodal field
    int patch_row;         // nodes in a patch row
    double* patch;         // component by component, row by row

    // Columns of the points, from the batch's first slot.
    double* place[2];    // total frame: cell coordinates in [0, 1]; updated frame: position, m
    double* measure;     // total frame: initial volume / r (axisymmetric), or initial volume; updated frame:
                         // volume, m^3. Zero marks an empty slot.
    double* mass;        // updated frame, kg
    double* velocity[2]; // updated frame, m/s
    const double* stress[6];
    double* deformation[5]; // updated frame: F_xx F_xy F_yx F_yy F_zz where a material wants it, else null

    // Workspace of the batch, one value a slot.
    double* strain[4];     // out: xx yy zz xy (updated frame with viscosity: a column of the points)
    double* stress_old[6]; // out: rotated
    double* rotation[2];   // out: cosine and sine of the step's rotation, or null
    double* flux[5];       // total frame: area vectors of the deformed point, xx xy yx yy and hoop
    double *gradient_old[5], *gradient_new[5]; // out: xx xy yx yy zz of F, or null
    double* volume_ratio;                      // out, total frame: J, or null

    double viscous_lame,
        viscous_shear; // Pa: added to the stress in forces, lame tr(strain) 1 + 2 shear strain
};

struct StrainReport {
    double largest; // strain component of the step
    int64_t bad;    // a slot whose strain is not a number, too large, or whose volume is not positive; or -1
};

struct StrainInput {
    const double* velocity[2];         // nodal, m/s
    const double* displacement_old[2]; // nodal, total frame, m
    double dt;
    double limit; // on strain components of one step
    bool rotate;  // stress_old (false: material wants F and rotates nothing)
};

struct Kernels {
    const char* isa;
    // Total frame: strain of the step, rotated old stress, area vectors at its end.
    StrainReport (*total_strain)(const GridView&, const BatchView&, const StrainInput&);
    // Total frame: internal forces (2 components) into the patch, from stress and flux.
    void (*total_force)(const GridView&, const BatchView&);
    // Updated frame: strain of the step and rotated old stress; with `commit`, the volume; with `move`, the
    // positions.
    StrainReport (*updated_strain)(const GridView&, const BatchView&, const StrainInput&, bool commit,
                                   bool move);
    // Updated frame: internal forces and mass (3 components).
    void (*updated_force)(const GridView&, const BatchView&);
    // Updated frame: v_p += dt N a; with `velocity`, x_p += dt N v; with `scatter`, mass and momentum (3
    // components).
    void (*updated_velocity)(const GridView&, const BatchView&, double dt,
                             const double* const acceleration[2], const double* const velocity[2],
                             bool scatter);
    // Slots that left their cell: writes at most `capacity` indices, returns how many there are.
    int64_t (*leavers)(const GridView&, const BatchView&, int64_t* slots, int64_t capacity);
    // One row of a field, margin included: out[n] = sum of coefficient * in over the (2 degree_x + 1) x
    // (2 degree_y + 1) neighbours.
    void (*stencil)(const double* const* coefficient, std::ptrdiff_t row, const double* in, double* out);
};

struct KernelChoice {
    int degree_x, degree_y; // of the bases: 1 or 2; along y 0 in radial symmetry
    bool axisymmetric;
};

// The kernels of a basis and a symmetry, for the best instruction set of this processor (best_isa).
const Kernels& select_kernels(const KernelChoice& choice);

} // namespace gault::core
