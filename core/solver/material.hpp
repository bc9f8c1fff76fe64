// A created soil model and how the host calls it on a batch of points.
#pragma once
#include "core/base/aligned.hpp"
#include "core/config/element.hpp"
#include "core/config/scene.hpp"
#include "core/points/points.hpp"
#include "core/registry/instance.hpp"
#include "core/transfer/kernels.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gault::core {

enum class HostField { density, volume_ratio, characteristic_length };
constexpr int host_fields = 3;

struct StateInfo {
    gault_state declared;
    int first; // its first component
};

class Material {
  public:
    explicit Material(const MaterialUse& use); // InputError: a declaration that the host cannot serve

    const std::string& name() const { return name_; }
    double density() const { return density_; } // initial, kg/m^3
    const Instance& instance() const { return instance_; }
    const gault_material_api& api() const { return instance_.api<gault_material_api>(); }
    const std::vector<StateInfo>& states() const { return states_; }
    int state_components() const { return components_; }
    const std::vector<HostField>& inputs() const { return inputs_; }
    bool wants(HostField field) const;
    bool finite_strain() const { return api().flags & GAULT_FINITE_STRAIN; }
    bool has_tangent() const { return (api().flags & GAULT_HAS_TANGENT) && !finite_strain(); }
    bool rate_dependent() const { return api().flags & GAULT_RATE_DEPENDENT; }
    bool one_at_a_time() const { return api().flags & GAULT_ONE_AT_A_TIME; }
    bool rotates_states() const { return rotates_states_; }
    // Of undrained soil: the last of its states is the excess pore pressure, which the host keeps.
    const std::optional<PoreWater>& water() const { return water_; }

  private:
    std::string name_;
    Instance instance_;
    double density_;
    std::vector<StateInfo> states_;
    std::vector<HostField> inputs_;
    int components_ = 0; // of the model's states, and of the host's
    std::optional<PoreWater> water_;
    bool rotates_states_ = false;
};

// What one thread needs beside the points for one batch at a time.
class Workspace {
  public:
    explicit Workspace(std::size_t slots); // of the largest batch

    std::size_t slots() const { return slots_; }
    double* column(int k); // the k-th scratch column, made when first asked for
    enum Use {
        strain = 0,
        stress_old = 4,
        rotation = 10,
        flux = 12,
        gradient_old = 17,
        gradient_new = 22,
        volume_ratio = 27,
        input = 28,
        probe = input + host_fields,
        modulus = probe + 6,    // and shear modulus
        state_old = modulus + 2 // and on, a column a component
    };
    const double* zero() const { return zero_.data(); }

    std::vector<double*> old_states, states, inputs; // lists of columns for the call in hand

  private:
    std::size_t slots_;
    std::vector<Column> columns_;
    Column zero_;
};

struct Moment { // of a constitutive update
    double time, dt;
};

struct UpdateFailure {
    gault_status status = GAULT_OK;
    std::optional<std::size_t> slot; // nothing: the model named no point
    std::string text;
    double fraction = 0.5; // of the step that is worth trying, where the status is RETRY
    std::shared_ptr<const ElementReplay> call = nullptr; // of the point in `slot`, to ask it again
};

class PointError : public RunError { // a soil model gave no result
  public:
    PointError(const std::string& what, int material, std::shared_ptr<const ElementReplay> call)
        : RunError(what), material_(material), call_(std::move(call)) {}
    int material() const { return material_; }                // index into Scene::materials
    const ElementReplay* call() const { return call_.get(); } // null: the model named no point

  private:
    int material_;
    std::shared_ptr<const ElementReplay> call_;
};

// Points the kernel's workspace arrays of `view` at what this material needs.
void attach_workspace(const Material& material, Workspace& workspace, BatchView& view);

constexpr int tangent_columns = 4; // xx yy zz xy of the strain: the others stay zero in every symmetry so far

// What a caller wants of an update beside stress and states; null: not asked for.
struct Asked {
    double* const* tangent = nullptr; // 36 arrays, as in gault.h; only columns and rows xx yy zz xy are right
    double *modulus = nullptr, *shear_modulus = nullptr; // Pa
};

// Rotates tensor and vector states, fills the inputs, and calls the model. New stress and states are in the
// points' columns afterwards; `state_old` may be those very columns. Without a tangent the increment is
// divided on RETRY; with it RETRY is an answer, and a model without a tangent of its own is differentiated
// numerically.
UpdateFailure update_batch(const Material& material, Points& points, const std::vector<Column>& state_old,
                           const Batch& batch, const BatchView& view, Workspace& workspace,
                           const Moment& moment, const GridView& grid, const Asked& asked);

// Deformation gradient of the point in a slot, xx xy yx yy zz.
using Deformation = std::function<std::array<double, 5>(std::size_t)>;
inline std::array<double, 5> undeformed(std::size_t) {
    return {1.0, 0.0, 0.0, 1.0, 1.0};
}

// The elastic moduli of every point now (a zero increment); Pa. `shear` and `modulus` get points.slots()
// entries. RunError where they are not those of a soil or a fluid.
void evaluate_moduli(const Material& material, Points& points, const GridView& grid,
                     const Deformation& deformation, double time, Column& modulus, Column& shear);

// Lets the model set its states from the initial stress. RunError when it is not admissible.
void start_material(const Material& material, Points& points, const GridView& grid);

} // namespace gault::core
