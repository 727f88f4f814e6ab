// SPDX-License-Identifier: Apache-2.0
// Phase functions, in 1/sr: twins of those in shaders/common. Each integrates to 1 over the sphere.
// cosTheta: between the direction in which the light travels and the direction in which it leaves,
// so 1 is straight on.
#pragma once

#include <cmath>
#include <numbers>

namespace brume {

template <class Real>
Real phaseIsotropic() {
    return Real(1) / (Real(4) * std::numbers::pi_v<Real>);
}

/// Barta and Kovács 2011, section 2.1.
template <class Real>
Real phaseRayleigh(Real cosTheta) {
    return Real(3) / (Real(16) * std::numbers::pi_v<Real>)*(Real(1) + cosTheta * cosTheta);
}

/// Henyey and Greenstein 1941; g: mean cosine, |g| <= 0.999.
template <class Real>
Real phaseHenyeyGreenstein(Real cosTheta, Real g) {
    // (1 - g)^2 + 2 g (1 - cosTheta) without the cancellation of 1 + g^2 - 2 g cosTheta.
    const Real d = (Real(1) - g) * (Real(1) - g) + Real(2) * g * (Real(1) - cosTheta);
    return (Real(1) - g * g) / (Real(4) * std::numbers::pi_v<Real> * d * std::sqrt(d));
}

}  // namespace brume
