// SPDX-License-Identifier: Apache-2.0
#include <particles/blackbody.hpp>

#include <cmath>

namespace brume::particles {
namespace {

/// A Gaussian with different widths on its two sides, the lobes of Wyman et al.
double lobe(double nm, double mean, double below, double above) {
    const double t = (nm - mean) / (nm < mean ? below : above);
    return std::exp(-0.5 * t * t);
}

/// CIE 1931 colour matching functions, 2 degrees.
dvec3 matchingFunctions(double nm) {
    return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                0.065 * lobe(nm, 501.1, 20.4, 26.2),
            0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
            1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

/// XYZ up to a constant factor.
dvec3 blackbodyXyz(double kelvin) {
    constexpr double kSecondRadiationConstant = 1.438776877e7;  // nm K, CODATA 2018
    dvec3 sum(0);
    for (double nm = 360; nm <= 830; nm += 5)
        sum += matchingFunctions(nm) *
               (std::pow(nm / 560, -5) / std::expm1(kSecondRadiationConstant / (nm * kelvin)));
    return sum;
}

}  // namespace

dvec3 blackbodyColor(double kelvin) {
    static const double reference = blackbodyXyz(1500).y;
    const dvec3 xyz = blackbodyXyz(kelvin) / reference;
    // IEC 61966-2-1.
    const dvec3 rgb(3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z,
                    -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
                    0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z);
    return glm::max(rgb, dvec3(0));
}

}  // namespace brume::particles
