// Strain of a step without inertia, which may be long: f = R U is the deformation of the step in the plane,
// the strain ln V = R ln U R^T, exact for any length; and how both change with a further small deformation.
#pragma once
#include <cmath>

namespace gault::core {

struct LogStrain {
    double xx, yy, xy;             // ln V
    double cosine, sine;           // of the rotation R
    double shear[2] = {1.0, 0.0};  // cosine and sine of twice the angle of V's first principal axis
    double kappa = 1.0, tau = 0.0; // see below

    LogStrain(double fxx, double fxy, double fyx, double fyy) {
        const double c = fxx + fyy, s = fyx - fxy, size = std::hypot(c, s);
        cosine = c / size;
        sine = s / size;
        // V = f R^T = mean 1 + (d, o; o, -d)
        const double vxx = fxx * cosine - fxy * sine, vyy = fyx * sine + fyy * cosine;
        const double mean = 0.5 * (vxx + vyy), d = 0.5 * (vxx - vyy), o = fxx * sine + fxy * cosine;
        const double radius = std::hypot(d, o), t = radius / mean;
        const double slope = t > 1e-8 ? std::atanh(t) / radius : 1.0 / mean;
        const double average = 0.5 * std::log(fxx * fyy - fxy * fyx);
        xx = average + slope * d;
        yy = average - slope * d;
        xy = slope * o;
        if (t <= 1e-8) return;
        shear[0] = d / radius;
        shear[1] = o / radius;
        kappa = std::atanh(t) * (1.0 - t * t) / t;
        tau = t;
    }

    // With principal stretches a, b of V and x = ln(a/b): for a further velocity gradient l with symmetric
    // part d and spin w, in the frame that R turns, d(ln V) = d with its shear d12 between the principal axes
    // multiplied by kappa = x / sinh x, and R turns by w + tau d12, tau = tanh(x/2).
    struct Rate {
        double xx, yy, xy, spin;
    };
    Rate rate(double lxx, double lxy, double lyx, double lyy) const {
        const double shear_rate = 0.5 * (lxy + lyx);
        const double d12 = shear[0] * shear_rate - 0.5 * shear[1] * (lxx - lyy), change = (kappa - 1.0) * d12;
        return {lxx - change * shear[1], lyy + change * shear[1], shear_rate + change * shear[0],
                0.5 * (lyx - lxy) + tau * d12};
    }
};

} // namespace gault::core
