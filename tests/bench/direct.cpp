// A plugin's source in the executable itself, compiled with the plugin's options; its batch kernel is called directly.
#include PLUGIN_SOURCE

gault_status PLUGIN_KERNEL(const void* self, gault_points* points, gault_error* error) noexcept;
gault_status PLUGIN_KERNEL(const void* self, gault_points* points, gault_error* error) noexcept {
    return gault::detail::update<PLUGIN_MODEL>(self, points, error);
}
