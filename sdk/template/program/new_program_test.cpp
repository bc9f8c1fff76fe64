#include <gault/gault.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

constexpr double velocity = 1e-3, until = 2e-3; // m/s, m
constexpr int rows = 10;
constexpr double stiffness = 5e6, area = 0.5; // Pa/m, m^2: of the soil that is pushed

void expect(double found, double expected, double tolerance, const char* what) {
    if (std::fabs(found - expected) <= tolerance) return;
    std::printf("%s: found %.17g, expected %.17g +- %g\n", what, found, expected, tolerance);
    std::exit(1);
}

const gault_component& program() {
    return *GAULT_ENTRY.components[0];
}
const gault_program_api& api() {
    return *static_cast<const gault_program_api*>(program().api);
}

// A run without a host: the plugin is called through the contract as a host calls it, and the wall goes where it says.
struct Run {
    void* self = nullptr;
    std::vector<double> time, displacement, pressure; // of the rows
    double end = 0;                                   // s
    double secant = 0;                                // Pa/m

    explicit Run(double step_length) {
        gault_value values[3] = {};
        const double real[] = {velocity, until, rows};
        for (int i = 0; i < 3; ++i)
            values[i].real = real[i], values[i].integer = static_cast<int64_t>(real[i]), values[i].count = 1;
        gault_host host{};
        host.size = sizeof host;
        gault_error error{};
        expect(program().create(&host, values, &self, &error), GAULT_OK, 0, "status of create()");
        go(step_length);
        evaluate();
    }
    ~Run() { program().destroy(self); }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    void go(double step_length) {
        double control = 0, memory = 0, record[2] = {}, now = 0, moved = 0, dt = 0;
        for (int index = 0;; ++index) {
            const double measure[] = {moved, stiffness * moved * area, area};
            gault_step step{};
            step.size = sizeof step, step.index = index, step.time = now, step.dt = dt;
            step.next_dt = step_length;
            step.measure = measure, step.control = &control, step.memory = &memory, step.record = record;
            gault_error error{};
            expect(api().advance(self, &step, &error), GAULT_OK, 0, "status of advance()");
            if (step.emit) {
                time.push_back(now);
                displacement.push_back(record[0]);
                pressure.push_back(record[1]);
            }
            if (step.done) break;
            dt = std::min(step_length, step.next - now);
            now += dt;
            moved += control * dt;
        }
        end = now;
    }

    void evaluate() {
        const double* columns[] = {time.data(), displacement.data(), pressure.data()};
        gault_history history{};
        history.size = sizeof history, history.columns = 3, history.column = columns;
        history.rows = static_cast<int64_t>(time.size());
        gault_report report{};
        report.size = sizeof report, report.host = &secant;
        report.result = [](void* host, const char*, const char*, double value, const char*,
                           const char*) noexcept { *static_cast<double*>(host) = value; };
        gault_error error{};
        expect(api().evaluate(self, &history, &report, &error), GAULT_OK, 0, "status of evaluate()");
    }
};

void ends_where_it_is_told(const Run& run) {
    expect(run.end, until / velocity, 1e-9, "time of the end");
    expect(run.displacement.back(), until, 1e-12, "displacement at the end");
    expect(run.pressure.back(), stiffness * until, 1e-6, "pressure at the end");
}

void writes_the_rows_that_were_asked_for(const Run& run) {
    expect(static_cast<double>(run.time.size()), rows + 1, 0, "number of rows");
    for (std::size_t i = 0; i < run.time.size(); ++i)
        expect(run.time[i], static_cast<double>(i) * run.end / rows, 1e-6, "time of a row");
}

void finds_the_stiffness_of_the_soil(const Run& run) {
    expect(run.secant, stiffness, 1e-6 * stiffness, "secant stiffness");
}

} // namespace

int main() {
    const Run run(0.01); // 20 steps between two rows
    ends_where_it_is_told(run);
    writes_the_rows_that_were_asked_for(run);
    finds_the_stiffness_of_the_soil(run);
    ends_where_it_is_told(Run(0.03)); // which does not divide the time
    std::puts("new_program: all right");
}
