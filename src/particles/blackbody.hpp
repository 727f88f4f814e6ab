// SPDX-License-Identifier: Apache-2.0
// The colour of what glows with heat.
#pragma once

#include <core/math.hpp>

namespace brume::particles {

/// Radiance of a black body at `kelvin` (> 0) as linear sRGB, relative to its luminance at 1500 K;
/// negative components (reds outside sRGB) are 0. Source: Planck's law; colour matching functions
/// by Wyman, Sloan, Shirley, "Simple analytic approximations to the CIE XYZ color matching
/// functions", JCGT 2(2), 2013.
dvec3 blackbodyColor(double kelvin);

}  // namespace brume::particles
