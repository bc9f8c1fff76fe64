// clang-format off
// A loading program as one C++ struct: reads measures, sets controls, remembers through memory that the host owns,
// emits rows. advance() is called once before the first step and at the end of every step, on the [main] thread; when
// the host takes a step back, the call that began it is made again, with memory and controls as they were.
//
//   struct Protocol { // name, version, doc, parameters, prepare(): see component.hpp
//       static constexpr std::array measures{gault::signal("radius", "m", "Of the cavity.")}; // names: see gault.h
//       static constexpr std::array controls{gault::signal("velocity", "m/s", "Of the wall.")};
//       static constexpr std::array memories{gault::signal("next_row", "1", "Cavity strain of the next row.")};
//       static constexpr std::array records{gault::signal("cavity_strain", "1", "(a - a0) / a0.")};
//
//       void advance(gault::Step& step) const; // signals by index, in the order of these lists
//
//       const gault::Signals& instance_signals() const; // in place of the lists: they depend on parameters
//       void evaluate(const gault::History& history, gault::Report& report) const; // results, once, at the end
//   };
//   GAULT_MODULE("protocol", "1.0.0", "A. Author", "MIT", gault::Program<Protocol>)
// clang-format on
#pragma once
#include <gault/component.hpp>

namespace gault {
inline namespace GAULT_ISA {

class Step {
  public:
    explicit Step(gault_step* step) : step_(step) {}

    bool first() const { return step_->index == 0; } // the call before the first step
    double time() const { return step_->time; }      // s, now
    double dt() const { return step_->dt; }          // s, of the step that ended
    double next_dt() const { return step_->next_dt; } // s, the longest that the coming step will be
    double measure(int i) const { return step_->measure[i]; }
    double& control(int i) { return step_->control[i]; } // for the step that begins now
    double& memory(int i) { return step_->memory[i]; }
    double& record(int i) { return step_->record[i]; }

    void emit() { step_->emit = 1; }                  // writes the record as a row
    void finish() { step_->done = 1; }                // the protocol is complete
    void stop_at(double time) { step_->next = time; } // a step ends exactly there, s

    // An event was overshot: repeat the step at this fraction of its length. An error unless it is
    // repeatable().
    bool repeatable() const { return step_->final == 0; }
    void retry(double fraction) { step_->suggest = fraction, retried_ = true; }
    bool retried() const { return retried_; }

  private:
    gault_step* step_;
    bool retried_ = false;
};

// A control that is commanded where somebody listens to it, and left alone where nobody does.
constexpr gault_signal optional(gault_signal control) {
    control.flags |= GAULT_SIGNAL_OPTIONAL;
    return control;
}

// The rows that the run emitted.
class History {
  public:
    explicit History(const gault_history* history) : history_(history) {}

    int64_t rows() const { return history_->rows; }
    double time(int64_t row) const { return history_->column[0][row]; } // s
    double record(int index, int64_t row) const { return history_->column[1 + index][row]; }

  private:
    const gault_history* history_;
};

// Takes what follows from a history. Each name once, [a-z][a-z0-9_]*; `source` is a citation. A value that is not
// finite counts as absent.
class Report {
  public:
    explicit Report(gault_report* report) : report_(report) {}

    void result(const std::string& result_name, const std::string& unit, double value,
                const std::string& source = "", const std::string& note = "") {
        report_->result(report_->host, result_name.c_str(), unit.c_str(), value, source.c_str(),
                        note.c_str());
    }
    void absent(const std::string& result_name, const std::string& reason, const std::string& source = "") {
        report_->absent(report_->host, result_name.c_str(), reason.c_str(), source.c_str());
    }

  private:
    gault_report* report_;
};

// Signals that depend on parameters: fill the lists in prepare(), then declare(). Texts live as long as the
// program.
struct Signals {
    std::vector<gault_signal> measures, controls, memories, records;
    gault_program_signals declaration;

    void declare() {
        const auto size = [](const std::vector<gault_signal>& list) {
            return static_cast<uint32_t>(list.size());
        };
        declaration = {sizeof declaration, 0,
                       measures.data(),    controls.data(),
                       memories.data(),    records.data(),
                       size(measures),     size(controls),
                       size(memories),     size(records)};
    }
};

namespace detail {

template <class T, class = void>
struct measure_list {
    static constexpr std::array<gault_signal, 0> list{};
};
template <class T>
struct measure_list<T, std::void_t<decltype(T::measures)>> {
    static constexpr auto& list = T::measures;
};
template <class T, class = void>
struct control_list {
    static constexpr std::array<gault_signal, 0> list{};
};
template <class T>
struct control_list<T, std::void_t<decltype(T::controls)>> {
    static constexpr auto& list = T::controls;
};
template <class T, class = void>
struct memory_list {
    static constexpr std::array<gault_signal, 0> list{};
};
template <class T>
struct memory_list<T, std::void_t<decltype(T::memories)>> {
    static constexpr auto& list = T::memories;
};
template <class T, class = void>
struct record_list {
    static constexpr std::array<gault_signal, 0> list{};
};
template <class T>
struct record_list<T, std::void_t<decltype(T::records)>> {
    static constexpr auto& list = T::records;
};
template <class T, class = void>
struct has_instance_signals : std::false_type {};
template <class T>
struct has_instance_signals<T, std::void_t<decltype(std::declval<const T&>().instance_signals())>>
    : std::true_type {};

template <class T, class = void>
struct has_evaluate : std::false_type {};
template <class T>
struct has_evaluate<T, std::void_t<decltype(std::declval<const T&>().evaluate(
                           std::declval<const History&>(), std::declval<Report&>()))>> : std::true_type {};

template <class T>
gault_status evaluate_history(const void* self, const gault_history* raw, gault_report* to,
                              gault_error* error) noexcept {
    return guarded(error, [&]() -> gault_status {
        const History history(raw);
        Report results(to);
        static_cast<const T*>(self)->evaluate(history, results);
        return GAULT_OK;
    });
}

template <class T>
gault_status advance(const void* self, gault_step* raw, gault_error* error) noexcept {
    return guarded(error, [&]() -> gault_status {
        raw->emit = 0;
        raw->done = 0;
        raw->next = infinity;
        Step step(raw);
        static_cast<const T*>(self)->advance(step);
        return step.retried() ? GAULT_RETRY : GAULT_OK;
    });
}

template <class T>
const gault_program_signals* instance_signals(const void* self) noexcept {
    return &static_cast<const T*>(self)->instance_signals().declaration;
}

template <class T>
constexpr gault_program_signals program_signals() {
    constexpr auto& measures = measure_list<T>::list;
    constexpr auto& controls = control_list<T>::list;
    constexpr auto& memories = memory_list<T>::list;
    constexpr auto& records = record_list<T>::list;
    return {sizeof(gault_program_signals),
            0,
            measures.data(),
            controls.data(),
            memories.data(),
            records.data(),
            static_cast<uint32_t>(measures.size()),
            static_cast<uint32_t>(controls.size()),
            static_cast<uint32_t>(memories.size()),
            static_cast<uint32_t>(records.size())};
}

template <class T>
constexpr gault_program_api program_api(const gault_program_signals* signals) {
    gault_program_api a{};
    a.size = sizeof a;
    a.signals = signals;
    a.advance = &advance<T>;
    if constexpr (has_instance_signals<T>::value) a.instance_signals = &instance_signals<T>;
    if constexpr (has_evaluate<T>::value) a.evaluate = &evaluate_history<T>;
    return a;
}

} // namespace detail

template <class T>
struct Program {
    static constexpr gault_program_signals signals = detail::program_signals<T>();
    static constexpr gault_program_api api = detail::program_api<T>(&signals);
    static constexpr gault_component declaration = detail::component<T>(GAULT_PROGRAM, &api);
};

} // namespace GAULT_ISA
} // namespace gault
