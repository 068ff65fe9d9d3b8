// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Random numbers that are functions of a counter:
// equal everywhere, in any order, on any number of threads.
#pragma once

#include "base/angles.h"

#include <cmath>
#include <cstdint>

namespace curvix {

// A well-mixed 64-bit value (the finaliser of SplitMix64).
inline std::uint64_t Mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

inline std::uint64_t Mix(std::uint64_t seed, std::uint64_t counter) {
  return Mix(Mix(seed) ^ counter);
}

// In [0, 1), from the upper bits of `mixed`.
inline double Uniform(std::uint64_t mixed) {
  return static_cast<double>(mixed >> 11) * 0x1.0p-53;
}

// Standard normal (Box and Muller).
inline double Gaussian(std::uint64_t seed, std::uint64_t counter) {
  const std::uint64_t mixed = Mix(seed, counter);
  const double radius = std::sqrt(-2 * std::log(1 - Uniform(mixed)));
  return radius * std::cos(2 * kPi * Uniform(Mix(mixed)));
}

}  // namespace curvix
