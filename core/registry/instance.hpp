// A created component: owns what create() returned.
#pragma once
#include "core/registry/parameters.hpp"
#include "core/registry/registry.hpp"

namespace gault::core {

const gault_host& plugin_host(); // what create() is told of this program

class Instance {
  public:
    // Throws InputError at the parameter's own location when the component answers INVALID.
    Instance(const Component& component, const Parameters& parameters);
    ~Instance();
    Instance(Instance&&) noexcept;
    Instance& operator=(Instance&&) = delete;

    const void* self() const { return self_; }
    const Component& component() const { return *component_; }
    const gault_component& declaration() const { return *component_->declaration; }
    template <class Api>
    const Api& api() const {
        return *static_cast<const Api*>(declaration().api);
    }

  private:
    const Component* component_;
    void* self_ = nullptr;
};

} // namespace gault::core
