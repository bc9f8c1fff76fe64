// What a run's history will hold: the program's records, and time.
#pragma once
#include "core/config/fields.hpp"
#include "core/config/scene.hpp"

namespace gault::core::config {

class Records {
  public:
    // Creates the program for a moment; InputError where that fails.
    explicit Records(const ComponentUse& program);

    // The unit of the record that `key` names; InputError with the nearest otherwise.
    std::string unit(const Key& key, const std::string& path) const;

  private:
    std::vector<std::string> names_, units_;
};

} // namespace gault::core::config
