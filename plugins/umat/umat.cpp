// Calls an Abaqus/Standard UMAT out of a shared library. README.md: what it is told, and what it is not.
#include "call.hpp"
#include "stiffness.hpp"

#include <gault/material.hpp>

#include <deque>

struct Umat {
    static constexpr const char *name = "umat", *version = "1.0.0";
    static constexpr const char* doc = "Calls an Abaqus/Standard UMAT out of a shared library.";
    static constexpr const char* reference =
        "Dassault Systemes, Abaqus User Subroutines Reference Guide, UMAT";

    std::string library, symbol = "umat_", cmname;
    std::vector<double> properties, initial_statev, stress_statev, strain_statev;
    int statev;
    bool thread_safe;

    using Self = Umat;
    static constexpr int most_statev = 4000; // the host keeps 4096 components a point
    static constexpr std::array parameters{
        gault::parameter<&Self::library>(
            "library", "", "1",
            "Shared library; a relative name is looked for in the current directory, the folders of "
            "GAULT_UMAT_PATH and lib/gault/umat."),
        gault::parameter<&Self::symbol>("symbol", "", "1", "Its name in the library; absent: umat_.")
            .optional(),
        gault::parameter<&Self::properties>("properties", "PROPS", "1", "Material constants, in SI units.")
            .optional(),
        gault::parameter<&Self::statev>("statev", "NSTATV", "1", "Number of state variables.")
            .at_least(0)
            .at_most(most_statev)
            .fallback(0),
        gault::parameter<&Self::initial_statev>("initial_statev", "STATEV", "1",
                                                "Their values at the start, all of them; absent: 0.")
            .optional(),
        gault::parameter<&Self::stress_statev>(
            "stress_statev", "", "1", "Which STATEV begin six components of a tensor, to be rotated.")
            .at_least(1)
            .optional(),
        gault::parameter<&Self::strain_statev>("strain_statev", "", "1",
                                               "The same, of tensors with engineering shear.")
            .at_least(1)
            .optional(),
        gault::parameter<&Self::cmname>(
            "cmname", "CMNAME", "1", "Name of the material that the UMAT is told; absent: from the symbol.")
            .optional(),
        gault::parameter<&Self::thread_safe>("thread_safe", "", "1",
                                             "Whether it may be called by several threads at a time.")
            .fallback(0)};
    static constexpr std::array inputs{"characteristic_length"};

    void prepare() {
        declare_states();
        library_ = &umat::open(library);
        routine_ = {reinterpret_cast<umat::Function*>(umat::find_symbol(*library_, symbol)),
                    {},
                    properties,
                    static_cast<int>(properties.size()),
                    statev};
        set_cmname();
    }
    const std::vector<gault_state>& instance_states() const { return states_; }

    gault_status start(gault_points& p, gault_error* error) const;
    gault_status update(gault_points& p, gault_error* error) const;

  private:
    struct Variable { // a STATEV: where the host keeps it, and how much larger it is
        int component;
        double scale;
    };

    // ---- what prepare() makes
    void declare_states() {
        if (initial_statev.empty()) initial_statev.assign(static_cast<std::size_t>(statev), 0.0);
        if (initial_statev.size() != static_cast<std::size_t>(statev))
            throw gault::Invalid("initial_statev", "has " + std::to_string(initial_statev.size()) +
                                                       (initial_statev.size() == 1 ? " number" : " numbers") +
                                                       "; 'statev' says " + std::to_string(statev));
        std::vector<const char*> tensor(static_cast<std::size_t>(statev)); // which list claims an entry
        claim("stress_statev", stress_statev, tensor);
        claim("strain_statev", strain_statev, tensor);

        states_.push_back(gault::symmetric_state("total_strain", "1", "STRAN, tensor shear."));
        for (int first = 0; first < statev;) {
            const char* list = tensor[static_cast<std::size_t>(first)];
            const bool is_strain = list && std::strcmp(list, "strain_statev") == 0;
            for (int k = 0; list && k < 6; ++k)
                variables_.push_back({6 + first + umat::place[k], is_strain ? umat::engineering[k] : 1.0});
            if (!list) variables_.push_back({6 + first, 1.0});
            add_state(first, list);
            first += list ? 6 : 1;
        }
    }
    void claim(const char* list, const std::vector<double>& firsts, std::vector<const char*>& tensor) const {
        for (const double number : firsts) {
            char text[32];
            std::snprintf(text, sizeof text, "%g", number);
            if (number != std::floor(number) || number > statev - 5)
                throw gault::Invalid(list, std::string(text) +
                                               " is not the index of the first of six among " +
                                               std::to_string(statev) + " state variables");
            for (int k = 0; k < 6; ++k) {
                const char*& taken =
                    tensor[static_cast<std::size_t>(number) - 1 + static_cast<std::size_t>(k)];
                if (taken)
                    throw gault::Invalid(list,
                                         std::string("the six from ") + text + " on share one with another");
                taken = list;
            }
        }
    }
    void add_state(int first, const char* list) {
        const std::string number = std::to_string(first + 1), last = std::to_string(first + 6);
        const char* label = text("statev_" + number + (list ? "_to_" + last : ""));
        if (list)
            states_.push_back(gault::symmetric_state(
                label, "1", text("STATEV(" + number + ") to (" + last + "), tensor shear.")));
        else
            states_.push_back(gault::scalar_state(label, "1", text("STATEV(" + number + ")."),
                                                  initial_statev[static_cast<std::size_t>(first)]));
    }
    const char* text(const std::string& t) { return texts_.emplace_back(t).c_str(); }

    void set_cmname() {
        if (cmname.size() > routine_.cmname.size())
            throw gault::Invalid("cmname", "is longer than the 80 characters of CMNAME");
        if (cmname.empty()) {
            cmname = symbol.substr(0, std::min(symbol.find_last_not_of('_') + 1, routine_.cmname.size()));
            for (char& c : cmname)
                if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
        }
        routine_.cmname.fill(' ');
        std::copy(cmname.begin(), cmname.end(), routine_.cmname.begin());
    }

    // ---- one point
    void load(umat::Call& call, const gault_points& p, int64_t point) const {
        for (int k = 0; k < 6; ++k) {
            const int c = umat::place[k];
            call.stress[k] = p.stress_old[c][point];
            call.stran[k] = p.state_old[c][point] * umat::engineering[k];
            call.dstran[k] = p.strain[c][point] * umat::engineering[k];
        }
        for (std::size_t j = 0; j < variables_.size(); ++j)
            call.statev[j] = p.state_old[variables_[j].component][point] * variables_[j].scale;
        call.time = p.time - p.dt;
        call.dtime = p.dt;
        call.celent = p.input[0][point];
    }
    void store(const umat::Call& call, gault_points& p, int64_t point) const {
        for (int k = 0; k < 6; ++k) {
            const int c = umat::place[k];
            p.stress[c][point] = call.stress[k];
            p.state[c][point] = p.state_old[c][point] + p.strain[c][point];
        }
        for (std::size_t j = 0; j < variables_.size(); ++j)
            p.state[variables_[j].component][point] = call.statev[j] / variables_[j].scale;
        for (int row = 0; row < 6 && p.tangent[0]; ++row)
            for (int column = 0; column < 6; ++column)
                p.tangent[6 * umat::place[row] + umat::place[column]][point] =
                    call.ddsdde[row + 6 * column] * umat::engineering[column];
    }

    // The stiffest of this answer and those to a tiny strain forth and back: where the soil yields, one of
    // them unloads.
    umat::Moduli moduli_after(const umat::Call& done, std::string& trouble) const {
        constexpr double way[6] = {1e-9, -0.6e-9, 0.3e-9, 0.7e-9, -0.4e-9, 0.5e-9};
        umat::Moduli most{0.0, 0.0};
        umat::Call call = done;
        for (const double sign : {0.0, 1.0, -1.0}) {
            if (sign != 0.0) {
                call = done;
                call.advance();
                for (int k = 0; k < 6; ++k)
                    call.dstran[k] = sign * way[k];
                trouble = call.run();
                if (!trouble.empty()) return most;
            }
            if (call.wants_a_shorter_step() || !call.has_finite_tangent()) continue;
            const umat::Moduli m = umat::moduli(call.ddsdde);
            most = {std::max(most.p_wave, m.p_wave), std::max(most.shear, m.shear)};
        }
        if (!(most.p_wave > 0.0))
            trouble = "returned a DDSDDE without stiffness; the speed of waves follows from it";
        return most;
    }

    gault_status refuse(gault_error* error, int64_t point, const std::string& what) const {
        const std::string where = library_->file.substr(library_->file.rfind('/') + 1);
        gault::detail::report(error, -1, point, (symbol + " of " + where + " " + what).c_str());
        return GAULT_FAILED;
    }
    std::unique_lock<std::mutex> alone() const {
        return thread_safe ? std::unique_lock<std::mutex>() : std::unique_lock<std::mutex>(library_->alone);
    }

    umat::Library* library_ = nullptr;
    umat::Routine routine_{};
    std::vector<Variable> variables_;
    std::vector<gault_state> states_;
    std::deque<std::string> texts_;
};

// A UMAT that keeps to its contract does nothing at a zero increment. One that starts outside of its yield
// surface does, and one that computes stress from total strain.
gault_status Umat::start(gault_points& p, gault_error* error) const {
    const auto lock = alone();
    umat::Call call(routine_);
    for (int64_t point = 0; point < p.count; ++point) {
        for (int c = 0; c < 6; ++c)
            p.state[c][point] = 0.0;
        for (std::size_t j = 0; j < variables_.size(); ++j)
            p.state[variables_[j].component][point] = initial_statev[j] / variables_[j].scale;
        load(call, p, point);
        std::fill_n(call.stran, 6, 0.0);
        std::copy(initial_statev.begin(), initial_statev.end(), call.statev.begin());
        std::string trouble = call.run();
        if (!trouble.empty()) return refuse(error, point, trouble);
        if (call.wants_a_shorter_step())
            return refuse(error, point, "wants a shorter step (PNEWDT) where there is none");
        double moved = 0.0, size = 0.0;
        for (int k = 0; k < 6; ++k) {
            moved = std::max(moved, std::abs(call.stress[k] - p.stress_old[umat::place[k]][point]));
            size = std::max(size, std::abs(p.stress_old[umat::place[k]][point]));
        }
        const double stiffness = moduli_after(call, trouble).p_wave;
        if (!trouble.empty()) return refuse(error, point, trouble);
        if (moved > 1e-6 * size + 1e-9 * stiffness)
            return refuse(
                error, point,
                "changes the initial stress without any strain: that is beyond its yield surface, or it "
                "computes stress from total strain, which is 0 at the start");
    }
    return GAULT_OK;
}

gault_status Umat::update(gault_points& p, gault_error* error) const {
    const auto lock = alone();
    umat::Call call(routine_);
    umat::Known known;
    double fraction = 1.0;
    for (int64_t point = 0; point < p.count; ++point) {
        load(call, p, point);
        if (!std::all_of(call.dstran, call.dstran + 6, [](double e) { return std::isfinite(e); }))
            return refuse(error, point, "is not called: the strain is not finite");
        std::string trouble = call.run();
        if (!trouble.empty()) return refuse(error, point, trouble);
        if (call.wants_a_shorter_step()) {
            if (!(p.dt > 0.0))
                return refuse(error, point, "wants a shorter step (PNEWDT) where there is none");
            fraction = std::min(fraction, call.pnewdt > 0.0 ? call.pnewdt : 0.5);
            continue;
        }
        if (p.tangent[0] && !call.has_finite_tangent())
            return refuse(error, point, "returned a DDSDDE that is not finite");
        store(call, p, point);
        if (!p.modulus && !p.shear_modulus) continue;
        const umat::Moduli m = p.dt > 0.0 ? known.moduli_of(call) : moduli_after(call, trouble);
        if (!trouble.empty()) return refuse(error, point, trouble);
        if (p.modulus) p.modulus[point] = m.p_wave;
        if (p.shear_modulus) p.shear_modulus[point] = m.shear;
    }
    if (fraction < 1.0) {
        p.suggest = fraction;
        return GAULT_RETRY;
    }
    return GAULT_OK;
}

// A flag is the component's, not the instance's: what creeps needs a component of its own.
struct RateDependentUmat : Umat {
    static constexpr const char* name = "umat_rate_dependent";
    static constexpr const char* doc =
        "The same for a UMAT that answers differently at another rate: the host then follows time.";
};

// Point by point, so without the packs of gault::Material.
template <class T>
struct ByPoint {
    static gault_status update(const void* self, gault_points* batch, gault_error* error) noexcept {
        return gault::detail::guarded(error,
                                      [&] { return static_cast<const T*>(self)->update(*batch, error); });
    }
    static gault_status start(const void* self, gault_points* batch, gault_error* error) noexcept {
        return gault::detail::guarded(error,
                                      [&] { return static_cast<const T*>(self)->start(*batch, error); });
    }
    static constexpr gault_material_api make_api() {
        gault_material_api a{};
        a.size = sizeof a;
        a.flags = GAULT_HAS_TANGENT;
        if (std::is_same<T, RateDependentUmat>::value) a.flags |= GAULT_RATE_DEPENDENT;
        a.inputs = gault::detail::InputList<T>::names.data();
        a.update = &update;
        a.start = &start;
        a.instance_states = &gault::detail::instance_states<T>;
        return a;
    }
    static constexpr gault_material_api api = make_api();
    static constexpr gault_component declaration = gault::detail::component<T>(GAULT_MATERIAL, &api);
};

GAULT_MODULE("umat", "1.0.0", "The Gault authors", "MIT", ByPoint<Umat>, ByPoint<RateDependentUmat>)
