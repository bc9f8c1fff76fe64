// A C++ library that was left out at link time.
namespace fits {
double curve(double, int);
}
extern "C" {
__attribute__((visibility("default"))) double (*wanted)(double, int) = fits::curve;
__attribute__((visibility("default"))) extern const char gault_module_v1[512] = {};
}
