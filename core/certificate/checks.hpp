// The checks of a certificate, by what they look at.
#pragma once
#include "core/certificate/certificate.hpp"

namespace gault::core::checks {

// declaration.cpp: what a model says of itself
Finding declaration(const Subject& subject);
Finding effect(const Subject& subject);
Finding bounds(const Subject& subject);
// contract.cpp: what it owes every caller
Finding batches(const Subject& subject);
Finding threads(const Subject& subject);
Finding increments(const Subject& subject);
Finding retry(const Subject& subject);
Finding rate(const Subject& subject);
// mechanics.cpp, objectivity.cpp, waves.cpp: what every soil obeys
Finding tangent(const Subject& subject);
Finding step_size(const Subject& subject);
Finding objectivity(const Subject& subject);
Finding elastic_cycles(const Subject& subject);
Finding random_walk(const Subject& subject);
Finding modulus(const Subject& subject);
// in_the_host.cpp: the soil in a scene, and what it costs
Finding cavity(const Subject& subject);
Finding speed(const Subject& subject);

inline Finding passed(std::string figure) {
    return {Finding::Verdict::passed, std::move(figure)};
}
inline Finding failed(std::string figure) {
    return {Finding::Verdict::failed, std::move(figure)};
}
inline Finding left_out(std::string why) {
    return {Finding::Verdict::left_out, std::move(why)};
}
inline Finding judge(bool good, std::string figure) {
    return good ? passed(std::move(figure)) : failed(std::move(figure));
}

} // namespace gault::core::checks
