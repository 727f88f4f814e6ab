// SPDX-License-Identifier: Apache-2.0
// Roots of quadratics without cancellation.
#pragma once

#include <cmath>
#include <vector>

namespace brume::reference {

/// Appends the real roots of a t^2 + 2 b t + c.
inline void appendRoots(double a, double b, double c, std::vector<double>& roots) {
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return;
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    if (a != 0) roots.push_back(q / a);
    if (q != 0) roots.push_back(c / q);
}

}  // namespace brume::reference
