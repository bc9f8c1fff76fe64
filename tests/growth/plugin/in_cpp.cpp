// The same components through the C++ wrappers of SDK 1.0.
#include <gault/boundary.hpp>
#include <gault/material.hpp>
#include <gault/observer.hpp>
#include <gault/program.hpp>
#include <gault/tensor.hpp>

#include <algorithm>

namespace {

struct Elastic {
    static constexpr const char *name = "in_cpp_elastic", *version = "1.0.0";
    static constexpr const char *doc = "Hooke's law.", *reference = "Hooke (1678)";

    double stiffness, poisson_ratio;
    std::optional<double> largest_increment;
    double lame, shear;

    static constexpr std::array parameters{
        gault::parameter<&Elastic::stiffness>("stiffness", "E", "Pa", "Young's modulus.").above(0),
        gault::parameter<&Elastic::poisson_ratio>("poisson_ratio", "nu", "1", "Poisson's ratio.")
            .above(-1)
            .below(0.5)
            .fallback(0.25),
        gault::parameter<&Elastic::largest_increment>("largest_increment", "", "1",
                                                      "Strain of a step beyond which it asks for less.")
            .at_least(0)};
    static constexpr std::array states{gault::scalar_state("age", "s", "Time so far.", 0, 0),
                                       gault::vector_state("marker", "1", "Turns with the soil.", 1, -2, 2),
                                       gault::symmetric_state("strain", "1", "Sum of increments."),
                                       gault::scalar_state("density", "kg/m^3", "As told.", 0, 0),
                                       gault::scalar_state("volume_ratio", "1", "As told.", 0, 0),
                                       gault::scalar_state("length", "m", "As told.", 0, 0)};
    static constexpr int age = gault::state_index(states, "age"),
                         strain = gault::state_index(states, "strain"),
                         density = gault::state_index(states, "density");
    static constexpr std::array inputs{"density", "volume_ratio", "characteristic_length"};
    static constexpr bool has_tangent = true;

    void prepare() {
        if (stiffness > 1e12) throw gault::Invalid("stiffness", "is that of no soil");
        shear = stiffness / (2.0 * (1.0 + poisson_ratio));
        lame = 2.0 * shear * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
    }
    void update(gault::Point& p) const {
        p.stress = gault::add_elastic(p.stress_old, p.strain, lame, 2.0 * shear);
        p.set_state(age, p.state_old(age) + p.dt());
        gault::Components sum = p.symmetric_state_old(strain);
        gault::Pack largest = 0.0;
        for (int i = 0; i < 6; ++i) {
            sum[i] += p.strain[i];
            largest = gault::max(largest, gault::abs(p.strain[i]));
        }
        p.set_symmetric_state(strain, sum);
        for (int i = 0; i < 3; ++i)
            p.set_state(density + i, p.input(i));
        p.modulus = lame + 2.0 * shear;
        p.shear_modulus = shear;
        if (p.wants_tangent()) p.set_elastic_tangent(lame, shear);
        p.fail(gault::abs(p.state_old(age) + p.dt() - p.time()) > 1e-9 * p.time(),
               "the steps do not add up to the time");
        if (largest_increment)
            p.retry(largest > *largest_increment, 0.9 * *largest_increment / widest(largest));
    }
    static double widest(gault::Pack pack) {
        double most = 0.0;
        for (int i = 0; i < gault::pack_lanes; ++i)
            most = std::max(most, pack[i]);
        return most;
    }
};

struct NeoHookean {
    static constexpr const char *name = "in_cpp_neo_hookean", *version = "1.0.0",
                                *doc = "Rubber that creeps.";

    double shear, lame, viscosity;
    static constexpr std::array parameters{
        gault::parameter<&NeoHookean::shear>("shear_modulus", "G", "Pa", "At rest.").above(0),
        gault::parameter<&NeoHookean::lame>("lame", "", "Pa", "At rest.").at_least(0),
        gault::parameter<&NeoHookean::viscosity>("viscosity", "", "Pa s", "Of the rate of strain.")
            .at_least(0)
            .fallback(0)};
    static constexpr bool finite_strain = true, rate_dependent = true, one_at_a_time = true;
    std::vector<gault_state> states_of;

    void prepare() {
        states_of = {gault::symmetric_state("rest_stress", "Pa", "Initial stress.")};
        if (viscosity > 0.0) states_of.push_back(gault::scalar_state("rate", "1/s", "Of volumetric strain."));
    }
    const std::vector<gault_state>& instance_states() const { return states_of; }

    void start(gault::Point& p) const {
        p.fail(p.stress[0] + p.stress[1] + p.stress[2] > 0.0, "the initial stress is tensile");
        p.set_symmetric_state(0, p.stress);
    }
    void update(gault::Point& p) const {
        constexpr int row[] = {0, 1, 2, 0, 1, 2}, column[] = {0, 1, 2, 1, 2, 0};
        const gault::Components rest = p.symmetric_state_old(0);
        const auto F = [&](int i, int j) { return p.F_new(i, j); };
        const gault::Pack volume = F(0, 0) * (F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1)) -
                                   F(0, 1) * (F(1, 0) * F(2, 2) - F(1, 2) * F(2, 0)) +
                                   F(0, 2) * (F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0));
        const double rate = p.dt() > 0.0 ? viscosity / p.dt() : 0.0;
        for (int c = 0; c < 6; ++c) {
            gault::Pack b = 0.0; // of F F^T
            for (int k = 0; k < 3; ++k)
                b += F(row[c], k) * F(column[c], k);
            const double unit = c < 3 ? 1.0 : 0.0;
            p.stress[c] = rest[c] + rate * p.strain[c] +
                          (shear * (b - unit) + lame * gault::log(volume) * unit) / volume;
        }
        p.fail((volume <= 0.0) | (p.F_old(0, 0) <= 0.0), "turned inside out");
        if (viscosity > 0.0) p.set_state(6, rate / viscosity * (p.strain[0] + p.strain[1] + p.strain[2]));
        p.modulus = lame + 2.0 * shear;
        p.shear_modulus = shear;
    }
};

struct Slide {
    static constexpr const char *name = "in_cpp_slide", *version = "1.0.0",
                                *doc = "Holds the normal component.";
    static constexpr uint32_t flags = gault::uniform | gault::holds_normal;
    void constrain(gault::Node& node) const {
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(node.normal(axis)) > 0.7 && std::isfinite(node.position(axis)))
                node.prescribe(axis, node.dt() > 0.0 ? -node.displacement(axis) / node.dt() : 0.0);
    }
};

struct Plate {
    static constexpr const char *name = "in_cpp_plate", *version = "1.0.0",
                                *doc = "Pressure, spring and dashpot.";
    static constexpr std::array controls{gault::signal("pressure", "Pa", "Beside the initial stress.")};

    double spring;
    bool absorbs;
    static constexpr std::array parameters{
        gault::parameter<&Plate::spring>("spring", "", "1/m", "Over the shear modulus of the soil behind.")
            .at_least(0)
            .fallback(0),
        gault::parameter<&Plate::absorbs>("absorbs", "", "1", "Whether it absorbs waves.").fallback(1)};

    void load(gault::Facet& f) const {
        const double stiffness = spring * f.shear_modulus();
        f.set_pressure(f.control(0));
        for (int axis = 0; axis < 3; ++axis) {
            const double impedance = std::abs(f.normal(axis)) > 0.7 ? f.p_impedance() : f.s_impedance();
            f.set_traction(axis, f.initial_traction(axis) - stiffness * f.displacement(axis) -
                                     (absorbs ? impedance * f.velocity(axis) : 0.0));
            if (f.wants_slope()) f.set_slope(axis, axis, stiffness);
        }
    }
};

struct Raise {
    static constexpr const char *name = "raise", *doc = "Raises it.";
    double to, over;
    static constexpr std::array parameters{
        gault::parameter<&Raise::to>("to", "", "Pa", "Pressure in the end."),
        gault::parameter<&Raise::over>("over", "", "s", "How long.").above(0).fallback(1)};
};
struct Hold {
    static constexpr const char *name = "hold", *doc = "Holds it.";
    double over;
    static constexpr std::array parameters{
        gault::parameter<&Hold::over>("over", "", "s", "How long.").above(0).fallback(1)};
};

struct Protocol {
    static constexpr const char *name = "in_cpp_protocol", *version = "1.0.0",
                                *doc = "Raises a pressure in phases.";
    enum class Level { debug, info, warn, error };
    static constexpr const char* levels[] = {"debug", "info", "warn", "error", nullptr};

    gault::Records<Raise, Hold> phases;
    gault::Table shape;
    std::vector<double> marks;
    int repeats;
    bool drives;
    Level says;
    std::string label;
    std::optional<double> until;
    static constexpr std::array parameters{
        gault::parameter<&Protocol::phases>("phases", "", "1", "In order.").count(1, 4),
        gault::table<&Protocol::shape>("shape", "1", "1", "Share of a rise over share of its time.")
            .optional()
            .at_least(0)
            .at_most(1)
            .count(2, 4),
        gault::parameter<&Protocol::marks>("marks", "", "Pa", "Rising pressures, each with a row.")
            .optional()
            .at_least(0)
            .count(1, 4),
        gault::parameter<&Protocol::repeats>("repeats", "", "1", "How often the phases are run.")
            .at_least(1)
            .at_most(3)
            .fallback(1),
        gault::parameter<&Protocol::drives>("drives", "", "1", "Whether it commands a drive.").fallback(0),
        gault::parameter<&Protocol::says>("says", "", "1", "How loud it says its label.")
            .choices(levels)
            .fallback(0),
        gault::parameter<&Protocol::label>("label", "", "", "Of the results.").optional(),
        gault::parameter<&Protocol::until>("until", "", "m", "Displacement that ends it.").above(0)};

    enum { displacement, normal_force, area };
    enum { passed, before };
    enum { set_pressure, travel, true_pressure };
    gault::Signals signals;
    gault::Table path; // pressure over time
    const gault::Signals& instance_signals() const { return signals; }

    void prepare() {
        path = {{0.0}, {0.0}};
        for (int n = 0; n < repeats; ++n)
            for (const auto& phase : phases)
                if (const Raise* raise = std::get_if<Raise>(&phase))
                    add(raise->to, raise->over);
                else
                    add(path.y.back(), std::get<Hold>(phase).over);
        signals.measures = {gault::signal("displacement", "m", "Of the surface."),
                            gault::signal("normal_force", "N", "On the surface."),
                            gault::signal("area", "m^2", "Of the surface.")};
        signals.controls = {gault::signal("pressure", "Pa", "On the surface.")};
        if (drives)
            signals.controls.push_back(gault::optional(gault::signal("drive", "1", "For a wall.", 1.0)));
        signals.memories = {gault::signal("passed", "1", "Marks so far."),
                            gault::signal("before", "m", "Displacement a step ago.")};
        signals.records = {gault::signal("set_pressure", "Pa", "Commanded."),
                           gault::signal("travel", "m", "Of the surface."),
                           gault::signal("true_pressure", "Pa", "Force over area.")};
        signals.declare();
    }
    void add(double to, double over) {
        const double start = path.last(), from = path.y.back();
        for (std::size_t i = 0; i < shape.x.size(); ++i)
            if (shape.x[i] > 0.0 && shape.x[i] < 1.0) {
                path.x.push_back(start + shape.x[i] * over);
                path.y.push_back(from + shape.y[i] * (to - from));
            }
        path.x.push_back(start + over);
        path.y.push_back(to);
    }

    void advance(gault::Step& step) const {
        const double now = step.measure(displacement), end = until.value_or(gault::infinity);
        if (now > (1.0 + 1e-6) * end && step.repeatable() && step.dt() > 0.0)
            return step.retry((end - step.memory(before)) / (now - step.memory(before)));
        const bool done = now >= (1.0 - 1e-6) * end || step.time() >= path.last() * (1.0 - 1e-12);
        if (done) step.finish();
        step.record(set_pressure) = path.linear(step.time());
        step.record(travel) = now;
        step.record(true_pressure) = step.measure(normal_force) / step.measure(area);
        const auto reached = std::upper_bound(marks.begin(), marks.end(), step.record(set_pressure));
        const double count = static_cast<double>(reached - marks.begin());
        if (step.first() || done || count > step.memory(passed)) step.emit();
        step.memory(passed) = std::max(step.memory(passed), count);
        step.memory(before) = now;
        const auto knot = std::upper_bound(path.x.begin(), path.x.end() - 1, step.time() * (1.0 + 1e-12));
        step.stop_at(*knot);
        step.control(0) = path.linear(std::min(step.time() + step.next_dt(), *knot));
    }
    void evaluate(const gault::History& history, gault::Report& report) const {
        const int64_t last = history.rows() - 1;
        const auto change = [&](int record) {
            return history.record(record, last) - history.record(record, 0);
        };
        report.result("stiffness", "Pa/m", change(true_pressure) / change(travel), "Hooke (1678)", label);
        report.absent("unloading_stiffness", "it was never unloaded", "Hooke (1678)");
    }
};

struct Witness {
    static constexpr const char *name = "in_cpp_witness", *version = "1.0.0", *doc = "Looks at everything.";
    double width;
    static constexpr std::array parameters{
        gault::parameter<&Witness::width>("width", "", "m", "Of the body.").at_least(0).fallback(1)};
    static constexpr std::array measures{gault::signal("normal_force", "N", "On the surface."),
                                         gault::signal("area", "m^2", "Of the surface.")};
    static constexpr std::array fields{"density", "volume_ratio", "length", "nobodys"};
    static constexpr std::array results{gault::signal("stress_error", "1", "Of the vertical stress."),
                                        gault::signal("initial_density", "kg/m^3", "Of the lower soil."),
                                        gault::signal("cell_length", "m", "That the lower soil was told."),
                                        gault::signal("height", "m", "Volume over width."),
                                        gault::signal("settlement", "m", "Largest of a point."),
                                        gault::signal("upper_share", "1", "Share of the upper soil."),
                                        gault::signal("end", "s", "Time."),
                                        gault::signal("size", "m", "Height of a cell."),
                                        gault::signal("never", "1", "Not applicable.")};

    void evaluate(gault::Sample& s) const {
        if (s.has_field(3)) throw std::runtime_error("a field that nobody has");
        const double pressure = s.measure(0) / s.measure(1);
        double error = 0.0, volume = 0.0, settlement = 0.0, upper = 0.0;
        for (int64_t i = 0; i < s.count(); ++i) {
            error = std::max(error, std::abs(s.stress(1, i) + pressure) / pressure);
            volume += s.volume(i);
            settlement = std::max(settlement, s.reference_position(1, i) - s.position(1, i));
            if (std::string("upper") == s.material_name(s.material(i))) {
                upper += 1.0 / static_cast<double>(s.count());
            } else {
                s.result(1) = s.field(0, i) * s.field(1, i);
                s.result(2) = s.field(2, i);
            }
        }
        s.result(0) = error;
        s.result(3) = volume / width;
        s.result(4) = settlement;
        s.result(5) = upper;
        s.result(6) = s.time();
        s.result(7) = s.cell_size(1);
    }
};

} // namespace

GAULT_MODULE("in_cpp", "1.0.0", "The Gault authors", "MIT", gault::Material<Elastic>,
             gault::Material<NeoHookean>, gault::Boundary<Slide>, gault::Boundary<Plate>,
             gault::Program<Protocol>, gault::Observer<Witness>)
