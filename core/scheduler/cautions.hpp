// What a user should know about a run although nothing is wrong with its scene: a sentence each.
#pragma once
#include "core/scheduler/elasticity.hpp"
#include "core/scheduler/simulation.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gault::core {

// Choices of the scene that are allowed and known to give wrong results.
std::vector<std::string> cautions(const Scene& scene);

// What is no caution.
std::vector<std::string> notes(Simulation& simulation);

// What only the run shows.
class RunCautions {
  public:
    explicit RunCautions(Simulation& simulation); // to be made before its first step
    void look();                                  // at the present state, once a row
    std::vector<std::string> now(const std::vector<std::vector<double>>& rows, bool ended) const;

  private:
    std::string kinetic(const std::vector<std::vector<double>>& rows) const; // empty: nothing to say
    std::string yield() const;
    std::string frames() const;

    Simulation& simulation_;
    std::optional<Elasticity> elasticity_; // where a boundary stands for elastic soil
    double yielding_ = 0.0;                // m; 0: the soil at that boundary is elastic
};

} // namespace gault::core
