// SPDX-License-Identifier: BSD-3-Clause
// What was meant by a name that there is not.
#pragma once

#include <string>
#include <vector>

namespace curvix {

// The candidate nearest to `name`; "": none is near. Case does not count, and
// the section only between names that are as near: "sigma" is near to
// "EdgeDetection.sigma_px".
std::string NearestName(const std::string& name,
                        const std::vector<std::string>& candidates);

// "; did you mean '<prefix><the nearest name>'?", or "; " and `otherwise` if
// none is near.
std::string Suggestion(const std::string& name,
                       const std::vector<std::string>& candidates,
                       const std::string& prefix,
                       const std::string& otherwise);

}  // namespace curvix
